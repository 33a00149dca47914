// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "farm_beast.h"

#include <cmath>
#include <cstdlib>

namespace rhview {
namespace {

using Vec = glm::dvec3;

constexpr double kSize = 0.6;

/// Quads round the body and along it.
struct BeastGrid {
    int around = 0;
    int along = 0;
};

/// The product nearest to the count asked for among the grids whose quads are not too long.
BeastGrid choose_grid(std::int64_t triangles) {
    const std::int64_t quads = triangles / 2;
    const auto square =
        static_cast<int>(std::sqrt(static_cast<double>(quads) / 10.0));  // it is ten times as long
    BeastGrid best;
    std::int64_t best_error = quads;
    for (int step = 0; step <= square / 3; ++step) {
        for (const int around : {square - step, square + step}) {
            const std::int64_t along = (quads + around / 2) / around;
            const std::int64_t error = std::abs(quads - around * along);
            if (error < best_error) best = {around, static_cast<int>(along)};
            if (error < best_error) best_error = error;
        }
    }
    return best;
}

/// A trefoil knot on a torus: twice about the axis, thrice about the ring.
Vec surface_point(double along, double around) {
    const CosSin axis = cos_sin_of_turns(2.0 * along), ring = cos_sin_of_turns(3.0 * along);
    const Vec outwards(axis.cos, 0.0, axis.sin), up(0, 1, 0);
    const double radius = 2.0 + ring.cos;
    // The torus's own normal is at right angles to the knot and closes after a round: a frame without a seam.
    const Vec normal = ring.cos * outwards + ring.sin * up;
    const Vec sideways(-axis.sin, 0.0, axis.cos);
    const Vec tangent = glm::normalize(2.0 * radius * sideways + 3.0 * (ring.cos * up - ring.sin * outwards));
    const Vec binormal = glm::cross(tangent, normal);
    const CosSin tube = cos_sin_of_turns(around);
    // Limbs, then ribs, then scales.
    const double limbs = cos_sin_of_turns(5.0 * along).cos;
    const double ribs = cos_sin_of_turns(60.0 * along).cos;
    const double scales =
        cos_sin_of_turns(180.0 * along + 3.0 * around).cos * cos_sin_of_turns(24.0 * around).cos;
    const double thickness = 0.5 + 0.08 * limbs + 0.012 * ribs + 0.006 * scales;
    return kSize *
           (radius * outwards + ring.sin * up + thickness * (tube.cos * normal + tube.sin * binormal));
}

}  // namespace

ShapeBuffer make_beast(std::int64_t triangles) {
    const BeastGrid grid = choose_grid(triangles);
    const auto at = [&](int along, int around) {
        return static_cast<std::uint32_t>((along + grid.along) % grid.along * grid.around +
                                          (around + grid.around) % grid.around);
    };
    std::vector<Vec> points;
    points.reserve(static_cast<std::size_t>(grid.along) * static_cast<std::size_t>(grid.around));
    for (int i = 0; i < grid.along; ++i)
        for (int j = 0; j < grid.around; ++j)
            points.push_back(
                surface_point(static_cast<double>(i) / grid.along, static_cast<double>(j) / grid.around));

    ShapeBuffer buffer;
    buffer.positions.reserve(points.size());
    buffer.normals.reserve(points.size());
    buffer.indices.reserve(6 * points.size());
    for (int i = 0; i < grid.along; ++i) {
        for (int j = 0; j < grid.around; ++j) {
            const Vec along = points[at(i + 1, j)] - points[at(i - 1, j)];
            const Vec around = points[at(i, j + 1)] - points[at(i, j - 1)];
            buffer.add_vertex(points[at(i, j)], glm::normalize(glm::cross(around, along)));
            buffer.add_quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        }
    }
    return buffer;
}

}  // namespace rhview
