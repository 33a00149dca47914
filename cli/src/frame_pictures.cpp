// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "frame_pictures.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace rhview::cli {
namespace {

constexpr double kMargin = 1.05;
constexpr glm::vec3 kPaper(0.96f, 0.96f, 0.94f);
constexpr glm::vec3 kNotDrawn(0.30f, 0.31f, 0.33f);
constexpr glm::vec3 kDrawn(1.0f, 0.45f, 0.08f);
constexpr glm::vec3 kBoxes(0.10f, 0.25f, 0.75f);
constexpr glm::vec3 kFrustum(0.85f, 0.0f, 0.25f);

/// Looks straight down on all of `bounds`, north (-z) up.
View view_from_above(const Aabb& bounds, const glm::dvec3& origin, double aspect, ClipDepth clip_depth) {
    const glm::dvec3 extent = glm::max(glm::dvec3(bounds.extent()), glm::dvec3(1e-3));
    const glm::dvec3 centre = origin + glm::dvec3(bounds.centre());
    const double height = kMargin * std::max(extent.z, extent.x / aspect);
    const glm::dvec3 eye(centre.x, origin.y + static_cast<double>(bounds.max.y) + 0.1 * extent.y, centre.z);
    return {look_along(eye, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}),
            orthographic(height * aspect, height, 0.0, 1.2 * extent.y, clip_depth), clip_depth};
}

}  // namespace

ViewFromAbove::ViewFromAbove(gl::RenderTarget target, gl::LineDrawer lines)
    : target_(std::move(target)), lines_(std::move(lines)) {}

Result<ViewFromAbove> ViewFromAbove::create(int width, int height) {
    Result<gl::RenderTarget> target = gl::RenderTarget::create(width, height);
    if (!target) return target.error();
    Result<gl::LineDrawer> lines = gl::LineDrawer::create();
    if (!lines) return lines.error();
    return ViewFromAbove(std::move(target).value(), std::move(lines).value());
}

gl::Picture ViewFromAbove::draw(const FramePlan& everything, const FramePlan& plan,
                                const FramePlanner& planner, const gl::SceneBuffers& buffers,
                                const Aabb& bounds, const View& view, gl::Executor& executor) {
    const double aspect = static_cast<double>(target_.width()) / target_.height();
    const View above = view_from_above(bounds, buffers.origin(), aspect, view.clip_depth);
    target_.begin(view.clip_depth, kPaper);
    executor.draw(everything, buffers, above, {gl::Submission::MultiDraw, kNotDrawn});
    executor.draw(plan, buffers, above, {gl::Submission::MultiDraw, kDrawn});
    gl::Lines boxes;
    for (const std::uint32_t chosen : plan.chosen) boxes.add_box(planner.bounds_of(chosen), buffers.origin());
    lines_.draw(boxes, above, kBoxes);
    gl::Lines frustum;
    frustum.add_frustum(view, static_cast<double>(glm::length(bounds.extent())));
    lines_.draw(frustum, above, kFrustum);
    return target_.read_colour();
}

}  // namespace rhview::cli
