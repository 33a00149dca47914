// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Axis-aligned boxes in scene space.
#pragma once

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace rhview {

/// Closed box [min, max]. The default is empty: min > max on every axis, the identity of `grow`.
struct Aabb {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};

    [[nodiscard]] bool is_empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    [[nodiscard]] glm::vec3 centre() const { return 0.5f * min + 0.5f * max; }
    [[nodiscard]] glm::vec3 extent() const { return max - min; }

    /// To the smallest box that holds `point` too.
    void grow(const glm::vec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    /// To the smallest box that holds all of `box` too; an empty one changes nothing.
    void grow(const Aabb& box) {
        min = glm::min(min, box.min);
        max = glm::max(max, box.max);
    }

    friend bool operator==(const Aabb&, const Aabb&) = default;
};

/// Box of `box` under an affine map, computed in double and rounded outwards: it contains the exact image.
/// An empty box stays empty. Source: Arvo, "Transforming axis-aligned bounding boxes", Graphics Gems, 1990.
Aabb transform_box(const glm::dmat4& to_from_box, const Aabb& box);

}  // namespace rhview
