// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/view.h"
#include "uniform.h"

namespace rhview {

/// A view from `eye` in any direction, perspective or (one in five) orthographic.
inline View random_view(Uniform& uniform, const glm::dvec3& eye, ClipDepth depth) {
    const double near = uniform.log(1e-3, 10.0);
    const double far = near * uniform.log(10.0, 1e6);
    View view;
    view.clip_depth = depth;
    view.camera_from_world = look_along(eye, uniform.point(1.0), {0.1, 1.0, 0.05});
    view.clip_from_camera = uniform(0, 1) < 0.2
                                ? orthographic(uniform.log(0.1, 1e3), uniform.log(0.1, 1e3), near, far, depth)
                                : perspective(uniform(0.02, 2.9), uniform(0.3, 3.0), near, far, depth);
    return view;
}

/// Boxes within `reach` of `middle`, their half sizes spread evenly over the logarithm.
inline std::vector<Aabb> random_boxes(Uniform& uniform, std::size_t count, const glm::dvec3& middle,
                                      double reach, double least_half, double greatest_half) {
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 centre(middle + uniform.point(reach));
        const double size = uniform.log(least_half, greatest_half);
        const glm::vec3 half(size * glm::dvec3(uniform(0, 1), uniform(0, 1), uniform(0, 1)));
        boxes.push_back({centre - half, centre + half});
    }
    return boxes;
}

}  // namespace rhview
