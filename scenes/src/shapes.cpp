// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "shapes.h"

#include <array>
#include <cmath>

namespace rhview {
namespace {

constexpr double kTwoPi = 6.283185307179586;

/// Joins rings of vertices: ring k is `count[k]` vertices from `first[k]`, either `sides` or a single tip.
struct RingJoin {
    std::uint32_t first = 0;
    bool tip = false;
};

void join_rings(ShapeBuffer& buffer, const RingJoin& low, const RingJoin& high, int sides) {
    for (int i = 0; i < sides; ++i) {
        const auto a = static_cast<std::uint32_t>(i);
        const auto b = static_cast<std::uint32_t>(i + 1 == sides ? 0 : i + 1);
        if (low.tip && high.tip) return;
        if (low.tip)
            buffer.add_triangle(low.first, high.first + a, high.first + b);
        else if (high.tip)
            buffer.add_triangle(low.first + a, high.first, low.first + b);
        else
            buffer.add_quad(low.first + a, high.first + a, high.first + b, low.first + b);
    }
}

}  // namespace

CosSin cos_sin_of_turns(double turns) {
    const double quarter = std::floor(turns * 4.0 + 0.5);
    const double angle = (turns - quarter * 0.25) * kTwoPi;  // at most an eighth of a turn either way
    const double square = angle * angle;
    // Taylor series: the first terms left out are below 1e-17.
    // Side by side, so that one instruction divides both.
    double series[2]{1.0, 1.0};
    for (int n = 16; n >= 2; n -= 2) {
        const double divisors[2]{static_cast<double>(n * (n - 1)), static_cast<double>(n * (n + 1))};
        for (int i = 0; i < 2; ++i) series[i] = 1.0 - series[i] * square / divisors[i];
    }
    const double cosine = series[0], sine = series[1] * angle;
    switch (static_cast<std::int64_t>(quarter) & 3) {
        case 0:
            return {cosine, sine};
        case 1:
            return {-sine, cosine};
        case 2:
            return {-cosine, -sine};
        default:
            return {sine, -cosine};
    }
}

void ShapeBuffer::clear() {
    positions.clear();
    normals.clear();
    indices.clear();
}

std::uint32_t ShapeBuffer::add_vertex(const glm::dvec3& position, const glm::dvec3& normal) {
    positions.emplace_back(position);
    normals.emplace_back(normal);
    return static_cast<std::uint32_t>(positions.size() - 1);
}

void ShapeBuffer::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    indices.insert(indices.end(), {a, b, c});
}

void ShapeBuffer::add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    indices.insert(indices.end(), {a, b, c, a, c, d});
}

Frame turned_frame(const glm::dvec3& origin, double turns) {
    const CosSin angle = cos_sin_of_turns(turns);
    return {origin, {angle.cos, 0.0, -angle.sin}, {0.0, 1.0, 0.0}, {angle.sin, 0.0, angle.cos}};
}

Frame frame_along(const glm::dvec3& origin, const glm::dvec3& axis) {
    const glm::dvec3 helper = std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(axis, helper));
    return {origin, x, axis, glm::cross(x, axis)};
}

void add_box(ShapeBuffer& buffer, const Frame& frame, const glm::dvec3& min, const glm::dvec3& max) {
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 normal(0.0);
            normal[axis] = side;
            std::array<std::uint32_t, 4> corner{};
            for (std::uint32_t i = 0; i < 4; ++i) {
                glm::dvec3 p;
                p[axis] = side > 0.0 ? max[axis] : min[axis];
                p[u] = (i == 1 || i == 2) ? max[u] : min[u];
                p[v] = i >= 2 ? max[v] : min[v];
                corner[i] = buffer.add_vertex(frame.point(p), frame.direction(normal));
            }
            if (side > 0.0)
                buffer.add_quad(corner[0], corner[1], corner[2], corner[3]);
            else
                buffer.add_quad(corner[0], corner[3], corner[2], corner[1]);
        }
    }
}

void add_lathe(ShapeBuffer& buffer, const Frame& frame, std::span<const OutlinePoint> outline, int sides) {
    RingJoin below;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const OutlinePoint& p = outline[k];
        const RingJoin ring{static_cast<std::uint32_t>(buffer.positions.size()), p.radius == 0.0};
        for (int i = 0; i < (ring.tip ? 1 : sides); ++i) {
            const CosSin angle = cos_sin_of_turns(static_cast<double>(i) / sides);
            const glm::dvec3 outwards = angle.cos * frame.x + angle.sin * frame.z;
            const glm::dvec3 normal = ring.tip ? (p.normal.y < 0.0 ? -frame.y : frame.y)
                                               : p.normal.x * outwards + p.normal.y * frame.y;
            buffer.add_vertex(frame.origin + p.radius * outwards + p.height * frame.y, normal);
        }
        const bool crease = k > 0 && outline[k - 1].radius == p.radius && outline[k - 1].height == p.height;
        if (k > 0 && !crease) join_rings(buffer, below, ring, sides);
        below = ring;
    }
}

void add_cylinder(ShapeBuffer& buffer, const Frame& frame, double bottom_radius, double top_radius,
                  double height, int sides, bool caps) {
    const glm::dvec2 side = glm::normalize(glm::dvec2(height, bottom_radius - top_radius));
    const glm::dvec2 down(0, -1), up(0, 1);
    const std::array<OutlinePoint, 6> outline{{{0.0, 0.0, down},
                                               {bottom_radius, 0.0, down},
                                               {bottom_radius, 0.0, side},
                                               {top_radius, height, side},
                                               {top_radius, height, up},
                                               {0.0, height, up}}};
    const std::span<const OutlinePoint> all(outline);
    if (!caps) return add_lathe(buffer, frame, all.subspan(2, 2), sides);
    const std::size_t first = bottom_radius == 0.0 ? 2 : 0;
    const std::size_t last = top_radius == 0.0 ? 4 : 6;
    add_lathe(buffer, frame, all.subspan(first, last - first), sides);
}

void add_sphere(ShapeBuffer& buffer, const Frame& frame, double radius, double half_height, int sides,
                int rings) {
    std::vector<OutlinePoint> outline;
    outline.reserve(static_cast<std::size_t>(rings) + 1);
    for (int k = 0; k <= rings; ++k) {
        const CosSin angle = cos_sin_of_turns(0.5 * k / rings - 0.25);
        const bool pole = k == 0 || k == rings;
        const glm::dvec2 normal = glm::normalize(glm::dvec2(angle.cos * half_height, angle.sin * radius));
        outline.push_back({pole ? 0.0 : radius * angle.cos, half_height * angle.sin, normal});
    }
    add_lathe(buffer, frame, outline, sides);
}

void add_turned(ShapeBuffer& buffer, const Frame& frame, std::initializer_list<glm::dvec2> points,
                int sides) {
    std::vector<OutlinePoint> outline;
    outline.reserve(2 * points.size());
    for (const glm::dvec2* p = points.begin(); p + 1 < points.end(); ++p) {
        const glm::dvec2 along = p[1] - p[0];
        const glm::dvec2 normal = glm::normalize(glm::dvec2(along.y, -along.x));
        outline.push_back({p[0].x, p[0].y, normal});
        outline.push_back({p[1].x, p[1].y, normal});
    }
    add_lathe(buffer, frame, outline, sides);
}

void add_torus(ShapeBuffer& buffer, const Frame& frame, double ring_radius, double tube_radius,
               int ring_segments, int tube_segments) {
    const auto first = static_cast<std::uint32_t>(buffer.positions.size());
    for (int u = 0; u < ring_segments; ++u) {
        const CosSin ring = cos_sin_of_turns(static_cast<double>(u) / ring_segments);
        const glm::dvec3 outwards = ring.cos * frame.x + ring.sin * frame.z;
        for (int v = 0; v < tube_segments; ++v) {
            const CosSin tube = cos_sin_of_turns(static_cast<double>(v) / tube_segments);
            const glm::dvec3 normal = tube.cos * outwards + tube.sin * frame.y;
            buffer.add_vertex(frame.origin + ring_radius * outwards + tube_radius * normal, normal);
        }
    }
    const auto at = [&](int u, int v) {
        return first + static_cast<std::uint32_t>((u % ring_segments) * tube_segments + v % tube_segments);
    };
    for (int u = 0; u < ring_segments; ++u)
        for (int v = 0; v < tube_segments; ++v)
            buffer.add_quad(at(u, v), at(u, v + 1), at(u + 1, v + 1), at(u + 1, v));
}

void add_elbow(ShapeBuffer& buffer, const Frame& frame, double bend_radius, double radius, int sides,
               int segments) {
    const glm::dvec3 centre = frame.origin + bend_radius * frame.x;
    RingJoin below;
    for (int k = 0; k <= segments; ++k) {
        const RingJoin ring{static_cast<std::uint32_t>(buffer.positions.size()), false};
        const CosSin bend = cos_sin_of_turns(0.25 * k / segments);
        const glm::dvec3 away = bend.sin * frame.y - bend.cos * frame.x;
        for (int i = 0; i < sides; ++i) {
            // Backwards round the tube: `away`, the tangent and z are then handed as join_rings expects.
            const CosSin angle = cos_sin_of_turns(-static_cast<double>(i) / sides);
            const glm::dvec3 normal = angle.cos * away + angle.sin * frame.z;
            buffer.add_vertex(centre + bend_radius * away + radius * normal, normal);
        }
        if (k > 0) join_rings(buffer, below, ring, sides);
        below = ring;
    }
}

}  // namespace rhview
