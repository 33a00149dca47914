// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// Ear clipping after Meisters, "Polygons have ears", 1975, in the plane that the polygon's area vector
// (Newell's method) is most nearly perpendicular to.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "import_internal.h"

namespace rhview {
namespace {

constexpr std::size_t kMostEarCorners = 256;

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The polygon seen from its front: counter-clockwise, one axis dropped.
std::vector<glm::dvec2> flatten(std::span<const glm::dvec3> corners) {
    glm::dvec3 area(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = corners[i] - corners[0];
        area += glm::cross(a, corners[(i + 1) % corners.size()] - corners[0]);
    }
    int axis = 0;
    if (std::abs(area.y) > std::abs(area[axis])) axis = 1;
    if (std::abs(area.z) > std::abs(area[axis])) axis = 2;
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (area[axis] < 0.0) std::swap(u, v);
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::dvec3& corner : corners) flat.emplace_back(corner[u], corner[v]);
    return flat;
}

bool is_ear(const std::vector<glm::dvec2>& points, const std::vector<std::uint32_t>& left, std::size_t at) {
    const std::size_t n = left.size();
    const glm::dvec2& a = points[left[(at + n - 1) % n]];
    const glm::dvec2& b = points[left[at]];
    const glm::dvec2& c = points[left[(at + 1) % n]];
    if (!(turn(a, b, c) > 0.0)) return false;
    for (const std::uint32_t other : left) {
        const glm::dvec2& p = points[other];
        if (p == a || p == b || p == c) continue;
        if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
    }
    return true;
}

}  // namespace

void triangulate_polygon(std::span<const glm::dvec3> corners, std::vector<std::uint32_t>& triangles) {
    if (corners.size() < 3) return;
    std::vector<std::uint32_t> left(corners.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<std::uint32_t>(i);
    if (left.size() > 3 && left.size() <= kMostEarCorners) {
        const std::vector<glm::dvec2> points = flatten(corners);
        while (left.size() > 3) {
            // Starting at corner 1, a convex polygon becomes a fan around corner 0.
            std::size_t ear = 1;
            while (ear < left.size() && !is_ear(points, left, ear)) ++ear;
            if (ear == left.size()) break;
            const std::size_t n = left.size();
            triangles.insert(triangles.end(), {left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
        }
    }
    for (std::size_t i = 1; i + 1 < left.size(); ++i)
        triangles.insert(triangles.end(), {left[0], left[i], left[i + 1]});
}

}  // namespace rhview
