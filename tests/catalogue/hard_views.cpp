// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Oblique near planes: Lengyel, "Oblique view frustum depth projection and clipping", 2005, for each
// convention of depth.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "hard_case.h"

namespace rhview {
namespace {

constexpr double kAspect = 4.0 / 3.0;

/// Replaces the near plane by `plane` (camera space, positive where things are seen); the far plane then goes
/// through the corner of the old one that is opposite.
glm::dmat4 with_near_plane(const glm::dmat4& clip, const glm::dvec4& plane, ClipDepth depth) {
    glm::dmat4 rows = glm::transpose(clip);
    const double farthest = depth == ClipDepth::ReversedZeroToOne ? 0.0 : 1.0;
    const glm::dvec4 corner = glm::inverse(clip) * glm::dvec4(std::copysign(1.0, plane.x),
                                                              std::copysign(1.0, plane.y), farthest, 1.0);
    const double share = glm::dot(rows[3], corner) / glm::dot(plane, corner);
    switch (depth) {
        case ClipDepth::NegativeOneToOne:
            rows[2] = 2.0 * share * plane - rows[3];
            break;
        case ClipDepth::ZeroToOne:
            rows[2] = share * plane;
            break;
        case ClipDepth::ReversedZeroToOne:
            rows[2] = rows[3] - share * plane;
            break;
    }
    return glm::transpose(rows);
}

glm::dmat4 projection_of(const Lens& lens, double unit, ClipDepth depth, Uniform& uniform) {
    const double near = lens.near * unit, far = lens.far * unit;
    if (lens.projection == Projection::Orthographic) {
        const double height = unit * uniform.log(4.0, 80.0);
        return orthographic(kAspect * height, height, near, far, depth);
    }
    glm::dmat4 clip = perspective(lens.fov_y, kAspect, near, far, depth);
    if (lens.projection == Projection::Asymmetric) {
        clip[2][0] = uniform(-1.5, 1.5);
        clip[2][1] = uniform(-1.5, 1.5);
    }
    if (lens.projection == Projection::Oblique) {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(uniform(-0.6, 0.6), uniform(-0.6, 0.6), -1.0));
        clip = with_near_plane(clip, glm::dvec4(normal, -unit * uniform.log(0.5, 10.0)), depth);
    }
    return clip;
}

Stand anywhere(const HardScene& scene, Uniform& uniform) {
    const glm::dvec3 eye = uniform.point(45.0), target = uniform.point(12.0);
    return {scene.middle + scene.unit * eye, target - eye};
}

View any_view(const HardCase& hard_case, const HardScene& scene, ClipDepth depth, Uniform& uniform) {
    const auto count = static_cast<double>(scene.stands.size());
    const Stand stand = scene.stands.empty() ? anywhere(scene, uniform)
                                             : scene.stands[static_cast<std::size_t>(uniform(0, count))];
    return {look_along(scene.scene.origin + stand.eye, stand.forward, {0.02, 1.0, 0.01}),
            projection_of(hard_case.lens, scene.unit, depth, uniform), depth};
}

}  // namespace

std::vector<View> views_of(const HardCase& hard_case, const HardScene& scene, ClipDepth depth, Amount amount,
                           int count, Uniform& uniform) {
    std::vector<View> views;
    if (hard_case.cameras != nullptr) {
        for (const View& view : hard_case.cameras(scene, depth, amount))
            if (validate(view)) views.push_back(view);
        return views;
    }
    while (views.size() < static_cast<std::size_t>(count)) {
        const View view = any_view(hard_case, scene, depth, uniform);
        if (validate(view)) views.push_back(view);
    }
    return views;
}

std::vector<View> hostile_cameras(const HardScene& scene, ClipDepth depth, Amount amount) {
    constexpr double kLargest = std::numeric_limits<double>::max();
    constexpr double kLargestFloat = std::numeric_limits<float>::max();
    constexpr double kHostile[] = {std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::infinity(),
                                   -0.0,
                                   std::numeric_limits<double>::denorm_min(),
                                   -1e-310,
                                   1e-45,
                                   1e-20,
                                   kLargest,
                                   -kLargest,
                                   1e300,
                                   kLargestFloat,
                                   -kLargestFloat,
                                   1e20,
                                   -1.0,
                                   1e8};
    const View usual{look_along(scene.scene.origin + scene.middle + scene.unit * glm::dvec3(20, 6, 31),
                                {-20, -5, -30}, {0, 1, 0}),
                     perspective(1.0, kAspect, 0.05 * scene.unit, 300.0 * scene.unit, depth), depth};
    std::vector<View> views{usual};
    std::size_t number = 0;
    for (int entry = 0; entry < 32; ++entry)
        for (const double value : kHostile) {
            if (amount == Amount::Sample && number++ % 23 != 0) continue;
            views.push_back(usual);
            glm::dmat4& matrix = entry < 16 ? views.back().camera_from_world : views.back().clip_from_camera;
            matrix[entry / 4 % 4][entry % 4] = value;
        }
    return views;
}

}  // namespace rhview
