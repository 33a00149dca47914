// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The distance of a point from a triangle.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rhview {

struct Triangle {
    glm::dvec3 a, b, c;
};

/// Squared, of `p` from the segment `a` to `b`, or from `a` if they are one.
inline double segment_distance_squared(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 edge = b - a, to_p = p - a;
    const double length = glm::dot(edge, edge), along = glm::dot(to_p, edge);
    const double t = !(along > 0.0) ? 0.0 : along < length ? along / length : 1.0;
    const glm::dvec3 off = to_p - t * edge;
    return glm::dot(off, off);
}

/// Squared, of `p` from `triangle`; one of no area is a segment or a point. Over the triangle it is the
/// distance from its plane; elsewhere the nearest point is on an edge that `p` lies outside of.
inline double distance_squared(const glm::dvec3& p, const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = glm::dot(normal, normal);
    const bool beyond_ab = !(glm::dot(glm::cross(b - a, p - a), normal) > 0.0);
    const bool beyond_bc = !(glm::dot(glm::cross(c - b, p - b), normal) > 0.0);
    const bool beyond_ca = !(glm::dot(glm::cross(a - c, p - c), normal) > 0.0);
    if (!beyond_ab && !beyond_bc && !beyond_ca) {
        const double height = glm::dot(p - a, normal);
        return height * height / area;
    }
    double nearest = beyond_ab ? segment_distance_squared(p, a, b) : glm::dot(p - a, p - a);
    if (beyond_bc) nearest = glm::min(nearest, segment_distance_squared(p, b, c));
    if (beyond_ca) nearest = glm::min(nearest, segment_distance_squared(p, c, a));
    return nearest;
}

}  // namespace rhview
