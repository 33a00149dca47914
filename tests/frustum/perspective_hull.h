// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "rhview/base/aabb.h"
#include "rhview/base/view.h"
#include "rhview/frustum/separating_axes.h"

namespace rhview {

using Exact = long double;
using ExactVec = glm::vec<3, Exact>;

/// A perspective camera by its parameters; the frustum's corners follow from these in long double, without
/// the matrices that the library reads.
struct PerspectiveCamera {
    glm::dvec3 eye{0.0};
    glm::dvec3 forward{0.0, 0.0, -1.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    double fov_y = 1.0, aspect = 1.0, near = 0.1, far = 100.0;
    ClipDepth clip_depth = ClipDepth::NegativeOneToOne;

    [[nodiscard]] View view() const {
        return {look_along(eye, forward, up), perspective(fov_y, aspect, near, far, clip_depth), clip_depth};
    }
    /// Relative to the eye.
    [[nodiscard]] FrustumHull<Exact> hull() const {
        const ExactVec f = glm::normalize(ExactVec(forward));
        const ExactVec right = glm::normalize(glm::cross(f, glm::normalize(ExactVec(up))));
        const ExactVec above = glm::cross(right, f);
        const Exact tall = std::tan(Exact{0.5} * Exact{fov_y}), wide = tall * Exact{aspect};
        FrustumHull<Exact> corners;
        for (int i = 0; i < 8; ++i) {
            const Exact depth = i & 4 ? far : near;
            corners[i] = depth * (f + (i & 1 ? wide : -wide) * right + (i & 2 ? tall : -tall) * above);
        }
        return corners;
    }
};

/// The box as it is, relative to the eye.
inline HullBox<Exact> hull_box(const Aabb& box, const glm::dvec3& eye) {
    const ExactVec low = ExactVec(box.min) - ExactVec(eye), high = ExactVec(box.max) - ExactVec(eye);
    return {Exact{0.5} * (low + high),
            {ExactVec(1, 0, 0), ExactVec(0, 1, 0), ExactVec(0, 0, 1)},
            Exact{0.5} * (high - low)};
}

}  // namespace rhview
