// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Viewpoint. Let a, b, c be the rows x, y, w of the clip matrix on (v, 1). Where w > 0 the area of a triangle
// on the screen has the sign of det of the corners' (x, y, w), and by Cauchy-Binet that is n·(N.xyz - N.w v)
// for its normal n, any corner v, and the null vector N of the three rows, with N.w = -det(a, b, c) and N.xyz
// = a.w (b×c) + b.w (c×a) + c.w (a×b). N.w > 0: front faces are those with the centre N.xyz / N.w before
// their plane, as it should be; N.w < 0: the view mirrors. N.w = 0: those that N.xyz points at the front of.
//
// Cone of normals: the smallest cap that holds points of a hemisphere is fixed by two or three of them. Keep
// these, add the point farthest outside, solve for at most four, repeat: the cap grows each time, so it
// ends (the dual of the simplex method; Gärtner 1999 uses it for balls).

#include "rhview/rhoctree/facing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/assert.h"

namespace rhview {
namespace {

// Below this share of its rows a determinant is rounding, and the centre it gives nowhere.
constexpr double kLeastVolume = 1e-9;

// A float corner is wrong by 2^-24 of its distance from zero, but exact as the triangle that it is: products
// of differences in double lose 2^-52 each, so a cross product keeps 22 bits above this.
constexpr double kLeastAltitude = 0x1p-30;

// cos 89.9 degrees: what is wider is never seen from behind in practice.
constexpr double kLeastCosine = 0x1p-9;

// Angles that a dot product in double can't tell from nothing.
constexpr double kSameCosine = 1e-14;

/// Not unit; zero for a triangle without area; NaN for corners that are not finite.
glm::dvec3 unit_normal(const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 first = corners[1] - corners[0], second = corners[2] - corners[0];
    const glm::dvec3 cross = glm::cross(first, second);
    const glm::dvec3 third = corners[2] - corners[1];
    const double area = glm::length(cross);
    const double longest =
        std::max({glm::dot(first, first), glm::dot(second, second), glm::dot(third, third)});
    // NaN goes on to the division.
    if (area <= kLeastAltitude * longest) return glm::dvec3(0.0);
    return cross / area;
}

std::array<glm::dvec3, 3> corners_of(std::span<const glm::vec3> positions, const std::uint32_t* indices) {
    return {glm::dvec3(positions[indices[0]]), glm::dvec3(positions[indices[1]]),
            glm::dvec3(positions[indices[2]])};
}

/// A cap of the unit sphere; cosine of its angular radius. Larger cosine, smaller cap.
struct Cap {
    glm::dvec3 axis{0.0};
    double cosine = -1.0;
};

/// The smallest cap that holds `points`, at most four, among those that two or three of them fix; moves these
/// to the front of `points` and leaves out the rest.
Cap smallest_cap(std::array<glm::dvec3, 4>& points, std::size_t& count) {
    Cap best;
    std::array<std::size_t, 3> support{};
    std::size_t support_count = 0;
    const auto consider = [&](glm::dvec3 axis, std::array<std::size_t, 3> by, std::size_t by_count) {
        const double length = glm::length(axis);
        if (!(length > 0.0)) return;
        axis /= length;
        if (glm::dot(axis, points[by[0]]) < 0.0) axis = -axis;
        double cosine = 1.0;
        for (std::size_t i = 0; i < count; ++i) cosine = std::min(cosine, glm::dot(axis, points[i]));
        if (cosine > best.cosine) {
            best = {axis, cosine};
            support = by;
            support_count = by_count;
        }
    };
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = i + 1; j < count; ++j) {
            consider(points[i] + points[j], {i, j, 0}, 2);
            for (std::size_t k = j + 1; k < count; ++k)
                consider(glm::cross(points[j] - points[i], points[k] - points[i]), {i, j, k}, 3);
        }
    }
    const std::array<glm::dvec3, 4> all = points;
    for (std::size_t i = 0; i < support_count; ++i) points[i] = all[support[i]];
    count = support_count;
    return best;
}

/// The axis of the smallest cap that holds all normals; zero if none is smaller than a hemisphere.
glm::dvec3 smallest_cap_axis(std::span<const glm::dvec3> normals) {
    const auto farthest_from = [&](const glm::dvec3& axis) {
        return *std::min_element(
            normals.begin(), normals.end(),
            [&](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a, axis) < glm::dot(b, axis); });
    };
    // Each round of the exact method grows the cap; rounding could stall it, so rounds are bounded. A cap
    // that is not the smallest is a looser bound, never a wrong one.
    constexpr int kRounds = 64;
    std::array<glm::dvec3, 4> points{farthest_from(normals.front()), glm::dvec3(0.0), glm::dvec3(0.0),
                                     glm::dvec3(0.0)};
    std::size_t count = 1;
    Cap cap{points[0], 1.0};
    for (int round = 0; round < kRounds; ++round) {
        const glm::dvec3 outside = farthest_from(cap.axis);
        if (glm::dot(outside, cap.axis) >= cap.cosine - kSameCosine) break;
        points[count++] = outside;
        const Cap grown = smallest_cap(points, count);
        if (grown.cosine < kLeastCosine) return glm::dvec3(0.0);
        if (grown.cosine >= cap.cosine) break;
        cap = grown;
    }
    return cap.axis;
}

/// To the nearest float, for real: GCC 12 takes the way of a whole vector from double to float and back for
/// nothing (-O2, seen with 12.2), and the apex that was checked would not be the one returned.
float nearest(double value) {
    const volatile float rounded = static_cast<float>(value);
    return rounded;
}

float round_up(double value) {
    const float rounded = nearest(value);
    return static_cast<double>(rounded) >= value
               ? rounded
               : std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

/// The triangles that have an area: a normal and a corner of each plane.
struct Planes {
    std::vector<glm::dvec3> normals;
    std::vector<glm::dvec3> corners;
    Aabb bounds;
    bool finite = true;
};

Planes planes_of(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    Planes planes;
    planes.normals.reserve(indices.size() / 3);
    planes.corners.reserve(indices.size() / 3);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::array<glm::dvec3, 3> corners = corners_of(positions, &indices[i]);
        const glm::dvec3 normal = unit_normal(corners);
        planes.finite = planes.finite && glm::dot(normal, normal) <= 2.0;  // false for NaN
        if (normal == glm::dvec3(0.0)) continue;
        for (std::size_t corner = 0; corner < 3; ++corner) planes.bounds.grow(positions[indices[i + corner]]);
        planes.normals.push_back(normal);
        planes.corners.push_back(corners[0]);
    }
    return planes;
}

/// How far `apex` lies before the foremost of the planes that it should be behind, along the axis.
double excess_along(const Planes& planes, const glm::dvec3& axis, const glm::dvec3& apex) {
    double excess = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < planes.normals.size(); ++i) {
        const glm::dvec3& normal = planes.normals[i];
        excess = std::max(excess, glm::dot(apex - planes.corners[i], normal) / glm::dot(axis, normal));
    }
    return excess;
}

/// A point in float, on or behind all planes, on the line from `centre` along `axis` to rounding.
glm::vec3 place_apex(const Planes& planes, const glm::dvec3& axis, const glm::dvec3& centre) {
    double back = excess_along(planes, axis, centre);
    // Rounding to float may put the point before a plane again, by less than an ulp over the least cosine:
    // then it goes back by an ulp or by as much as it lies before, and twice that each time.
    constexpr int kTries = 24;
    double step = 0.0;
    for (int i = 0; i < kTries; ++i) {
        const glm::dvec3 exact = centre - back * axis;
        const glm::vec3 apex(nearest(exact.x), nearest(exact.y), nearest(exact.z));
        const double excess = excess_along(planes, axis, glm::dvec3(apex));
        if (excess <= 0.0) return apex;
        const glm::vec3 size = glm::abs(apex);
        const double ulp = 0x1p-23 * static_cast<double>(std::max({size.x, size.y, size.z}));
        step = std::max(2.0 * step, std::max(excess, ulp));
        back += step;
    }
    return glm::vec3(std::numeric_limits<float>::quiet_NaN());
}

}  // namespace

FacingCone bound_facing(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    RHVIEW_ASSERT(indices.size() % 3 == 0);
    const Planes planes = planes_of(positions, indices);
    if (!planes.finite || planes.normals.empty()) return {};
    FacingCone cone;
    const glm::dvec3 centre = smallest_cap_axis(planes.normals);
    const glm::vec3 axis(nearest(centre.x), nearest(centre.y), nearest(centre.z));
    if (axis == glm::vec3(0.0f)) return {};
    const glm::dvec3 unit = glm::normalize(glm::dvec3(axis));
    double sine = 0.0;
    for (const glm::dvec3& normal : planes.normals) {
        if (glm::dot(unit, normal) < kLeastCosine) return {};
        sine = std::max(sine, glm::length(glm::cross(unit, normal)));
    }
    const glm::dvec3 low(planes.bounds.min), high(planes.bounds.max);
    cone.apex = place_apex(planes, unit, 0.5 * (low + high));
    cone.axis = axis;
    cone.cutoff = round_up(sine);
    const glm::dvec3 apex(cone.apex);
    cone.reach = round_up(glm::length(glm::max(glm::abs(low - apex), glm::abs(high - apex))));
    return std::isfinite(cone.reach) ? cone : FacingCone{};
}

Viewpoint make_viewpoint(const View& view, const glm::dvec3& scene_origin) {
    RHVIEW_ASSERT(validate(view).ok());
    const glm::dmat4 rows = glm::transpose(view.clip_from_eye_relative());
    const glm::dvec3 a(rows[0]), b(rows[1]), c(rows[3]);
    const glm::dvec3 null =
        rows[0].w * glm::cross(b, c) + rows[1].w * glm::cross(c, a) + rows[3].w * glm::cross(a, b);
    const double null_w = -glm::dot(a, glm::cross(b, c));
    Viewpoint viewpoint;
    if (c == glm::dvec3(0.0)) {
        // Depth grows away from the viewer, or towards him if it is reversed.
        const glm::dvec3 depth(rows[2]);
        const double away = view.clip_depth == ClipDepth::ReversedZeroToOne ? -1.0 : 1.0;
        const double size = glm::length(null);
        if (!(rows[3].w > 0.0 && away * glm::dot(depth, null) < -kLeastVolume * glm::length(depth) * size))
            return viewpoint;
        viewpoint.kind = Viewpoint::Kind::Direction;
        viewpoint.direction = glm::vec3(-null / size);
    } else if (null_w > kLeastVolume * glm::length(a) * glm::length(b) * glm::length(c)) {
        viewpoint.kind = Viewpoint::Kind::Point;
        viewpoint.point = view.eye() - scene_origin + null / null_w;
    }
    return viewpoint;
}

}  // namespace rhview
