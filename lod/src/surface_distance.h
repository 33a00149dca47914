// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// How far a surface is from another one, proved rather than sampled.
///
/// The distance from one triangle S is a convex function of the point: over a triangle T it is greatest in a
/// corner of T. So the greatest distance of T's corners from one S bounds the distance of all of T from the
/// surface that S belongs to. Where the S nearest to T's centre does not bound T tightly, T is cut in two:
/// where an edge leaves what S does bound tightly, else in the middle. Every stage gives a bound; cutting
/// only makes it tighter.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "triangle_tree.h"

namespace rhview {

/// A surface whose triangles' distance is bounded.
struct SurfaceTriangles {
    std::span<const glm::vec3> positions;
    std::span<const std::uint32_t> indices;  ///< three per triangle
};

/// A bound of the distance of any point of `from`'s triangles from those of `to`, at least 0. It is above the
/// true maximum by at most 5 %, `floor` or 1e-7 of `to`'s diagonal, whichever is most, unless the surfaces
/// are so unlike that cutting is given up; it is a bound then too. Deterministic on any number of oneTBB's
/// threads. Cost: about five searches of the nearest triangle for each triangle of either surface, 64 at
/// most.
double one_sided_distance_bound(const SurfaceTriangles& from, const TriangleTree& to, double floor);

}  // namespace rhview
