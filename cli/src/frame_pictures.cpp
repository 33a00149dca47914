// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "frame_pictures.h"

#include <algorithm>
#include <glm/common.hpp>

namespace rhview::cli {
namespace {

constexpr double kMargin = 1.05;
constexpr glm::vec3 kPaper(0.96f, 0.96f, 0.94f);

/// Looks straight down on all of `bounds`, north (-z) up. What is higher than a viewer within the scene is
/// cut off: a ceiling would hide all that matters.
View view_from_above(const Aabb& bounds, const glm::dvec3& origin, double aspect, const View& viewer) {
    const glm::dvec3 extent = glm::max(glm::dvec3(bounds.extent()), glm::dvec3(1e-3));
    const glm::dvec3 centre = origin + glm::dvec3(bounds.centre());
    const double height = kMargin * std::max(extent.z, extent.x / aspect);
    const glm::dvec3 eye(centre.x, origin.y + static_cast<double>(bounds.max.y) + 0.1 * extent.y, centre.z);
    return {look_along(eye, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}),
            orthographic(height * aspect, height, std::clamp(eye.y - viewer.eye().y, 0.0, 1.1 * extent.y),
                         1.2 * extent.y, viewer.clip_depth),
            viewer.clip_depth};
}

}  // namespace

ViewFromAbove::ViewFromAbove(gl::RenderTarget target, PlanPicture picture)
    : target_(std::move(target)), picture_(std::move(picture)) {}

Result<ViewFromAbove> ViewFromAbove::create(int width, int height) {
    Result<gl::RenderTarget> target = gl::RenderTarget::create(width, height);
    if (!target) return target.error();
    Result<PlanPicture> picture = PlanPicture::create();
    if (!picture) return picture.error();
    return ViewFromAbove(std::move(target).value(), std::move(picture).value());
}

gl::Picture ViewFromAbove::draw(const PicturedPlan& pictured, gl::Executor& executor) {
    const double aspect = static_cast<double>(target_.width()) / target_.height();
    target_.begin(pictured.culling.clip_depth, kPaper);
    picture_.draw(pictured,
                  view_from_above(pictured.bounds, pictured.buffers.origin(), aspect, pictured.culling), {},
                  executor);
    return target_.read_colour();
}

}  // namespace rhview::cli
