// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// An affine map as it acts on positions, normals and windings, and whether a mesh can be drawn through it.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "rhview/scenes/scene.h"

namespace rhview {

inline bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

struct Placement {
    explicit Placement(const glm::dmat4& target_from_piece)
        : matrix(target_from_piece), mirrored(glm::determinant(glm::dmat3(target_from_piece)) < 0.0) {
        // The cofactor matrix carries normals through any affine map, singular ones included (Abrash; Garrity
        // 2008).
        const glm::dmat3 linear(matrix);
        normals = glm::dmat3(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                             glm::cross(linear[0], linear[1])) *
                  (mirrored ? -1.0 : 1.0);
    }
    [[nodiscard]] glm::dvec3 exact_position(const glm::vec3& p) const {
        return {matrix * glm::dvec4(glm::dvec3(p), 1.0)};
    }
    [[nodiscard]] glm::vec3 position(const glm::vec3& p) const { return glm::vec3(exact_position(p)); }
    [[nodiscard]] PackedNormal normal(const glm::vec3& source) const {
        const glm::dvec3 n = normals * glm::dvec3(source);
        const double length = glm::length(n);
        return pack_normal(length > 0.0 && std::isfinite(length) ? glm::vec3(n / length)
                                                                 : glm::vec3(0, 1, 0));
    }

    glm::dmat4 matrix;
    glm::dmat3 normals;
    bool mirrored;
};

/// Whether a renderer may draw a mesh through this map instead of its placed vertices: affine, finite,
/// neither flat nor so sheared that float arithmetic in the mesh's own space would lose pixels.
bool can_be_drawn_through(const glm::dmat4& scene_from_mesh);

/// A box of doubles as one of floats that contains it; false where it is empty or has no finite one.
bool round_outwards(const glm::dvec3& min, const glm::dvec3& max, Aabb& box);

}  // namespace rhview
