// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The solids that the procedural scenes are made of, with smooth normals where the solid is round.
///
/// Every shape appends to a buffer, faces outwards, and is computed with + - * / and sqrt alone, so that it
/// is bit-identical on every machine. Its frame is orthonormal and right-handed.
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <span>
#include <vector>

#include "rhview/scenes/scene_builder.h"

namespace rhview {

struct CosSin {
    double cos = 1.0;
    double sin = 0.0;
};

/// Cosine and sine of an angle in whole turns, to about 1e-16; quarter turns are exact.
CosSin cos_sin_of_turns(double turns);

/// Positions, normals and triangles that grow shape by shape.
struct ShapeBuffer {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<std::uint32_t> indices;

    void clear();
    [[nodiscard]] MeshPiece piece() const { return {positions, normals, {}, indices}; }
    std::uint32_t add_vertex(const glm::dvec3& position, const glm::dvec3& normal);
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
};

struct Frame {
    glm::dvec3 origin{0.0};
    glm::dvec3 x{1.0, 0.0, 0.0};
    glm::dvec3 y{0.0, 1.0, 0.0};
    glm::dvec3 z{0.0, 0.0, 1.0};

    [[nodiscard]] glm::dvec3 direction(const glm::dvec3& v) const { return v.x * x + v.y * y + v.z * z; }
    [[nodiscard]] glm::dvec3 point(const glm::dvec3& p) const { return origin + direction(p); }
    [[nodiscard]] Frame moved(const glm::dvec3& p) const { return {point(p), x, y, z}; }
};

/// A frame turned about +y.
Frame turned_frame(const glm::dvec3& origin, double turns);
/// A frame whose y is the unit vector `axis` (for pipes); x and z are any.
Frame frame_along(const glm::dvec3& origin, const glm::dvec3& axis);

/// 12 triangles, 24 vertices.
void add_box(ShapeBuffer& buffer, const Frame& frame, const glm::dvec3& min, const glm::dvec3& max);

/// A point of an outline that turns about the frame's y, with its normal in the same half plane.
struct OutlinePoint {
    double radius = 0.0;
    double height = 0.0;
    glm::dvec2 normal{1.0, 0.0};  ///< (outwards, up), unit
};

/// A solid of revolution. The outline runs from its bottom to its top, seen on its outer side; the same place
/// twice with two normals makes a crease.
void add_lathe(ShapeBuffer& buffer, const Frame& frame, std::span<const OutlinePoint> outline, int sides);

/// A closed cylinder, or a cone where the radii differ, from the frame's origin along y. 4 * sides triangles,
/// 2 * sides fewer if `caps` is false (for ends that something else covers), `sides` fewer per tip of radius
/// 0.
void add_cylinder(ShapeBuffer& buffer, const Frame& frame, double bottom_radius, double top_radius,
                  double height, int sides, bool caps = true);

/// An ellipsoid of revolution, 2 * sides * (rings - 1) triangles.
void add_sphere(ShapeBuffer& buffer, const Frame& frame, double radius, double half_height, int sides,
                int rings);

/// An outline through `points` (radius, height) with creases at every point: for turned legs, bottles, roofs.
void add_turned(ShapeBuffer& buffer, const Frame& frame, std::initializer_list<glm::dvec2> points, int sides);

/// Round the frame's y; 2 * ring_segments * tube_segments triangles.
void add_torus(ShapeBuffer& buffer, const Frame& frame, double ring_radius, double tube_radius,
               int ring_segments, int tube_segments);

/// A quarter bend, open at both ends: starts at the origin along y, ends along x, its centre line at
/// `bend_radius` from origin + bend_radius * x. 2 * sides * segments triangles.
void add_elbow(ShapeBuffer& buffer, const Frame& frame, double bend_radius, double radius, int sides,
               int segments);

}  // namespace rhview
