// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// What a renderer may draw lies in the planes pushed outwards by its rounding, at the distance of the
// farthest corner. The corners of that polytope are those of its planes' triples that lie on its right side
// of all the planes: whatever the projection (oblique, orthographic), and also where a pushed near plane lets
// the apex in.

#include "rhview/frustum/corner_test.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "rhview/base/rounding.h"

namespace rhview {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A corner that misses a plane by this share of its distance still counts: too many only grow the box.
constexpr double kTolerance = 1e-7;

struct Extent {
    glm::dvec3 min{kInfinity};
    glm::dvec3 max{-kInfinity};

    /// The greatest distance from the eye on any axis; infinite if there is no corner.
    [[nodiscard]] double reach() const {
        if (!(min.x <= max.x)) return kInfinity;
        const glm::dvec3 far = glm::max(glm::abs(min), glm::abs(max));
        return std::max({far.x, far.y, far.z});
    }
};

/// normal · p + distance >= 0.
struct HalfSpace {
    glm::dvec3 normal;
    double distance;
};

bool is_inside(const std::array<HalfSpace, 6>& planes, const glm::dvec3& corner) {
    for (const HalfSpace& plane : planes) {
        const double scale = glm::length(corner) + std::abs(plane.distance);
        if (!(glm::dot(plane.normal, corner) + plane.distance >= -kTolerance * scale)) return false;
    }
    return true;
}

Extent corners_of(const std::array<HalfSpace, 6>& planes) {
    Extent extent;
    for (int i = 0; i < 6; ++i)
        for (int j = i + 1; j < 6; ++j)
            for (int k = j + 1; k < 6; ++k) {
                const glm::dmat3 normals =
                    glm::transpose(glm::dmat3(planes[i].normal, planes[j].normal, planes[k].normal));
                if (!(std::abs(glm::determinant(normals)) > 1e-12)) continue;
                const glm::dvec3 corner =
                    glm::inverse(normals) *
                    -glm::dvec3(planes[i].distance, planes[j].distance, planes[k].distance);
                if (!is_inside(planes, corner)) continue;
                extent.min = glm::min(extent.min, corner);
                extent.max = glm::max(extent.max, corner);
            }
    return extent;
}

/// The box of the frustum's corners, relative to the eye, or the default if it has none that may be trusted.
Extent pushed_corners(const Frustum& frustum) {
    std::array<HalfSpace, 6> planes;
    for (int i = 0; i < 6; ++i)
        planes[i] = {glm::dvec3(frustum.planes[i].normal), frustum.planes[i].distance};
    // Pushed by the slack at twice the reach: right if the pushed corners are within it.
    const double reach = 2.0 * corners_of(planes).reach();
    if (!(reach < kInfinity)) return {};
    for (int i = 0; i < 6; ++i) {
        const FrustumPlane& plane = frustum.planes[i];
        planes[i].distance += glm::dot(glm::dvec3(plane.slack_per_metre), glm::dvec3(reach)) + plane.slack;
    }
    const Extent extent = corners_of(planes);
    return extent.reach() <= reach ? extent : Extent{};
}

}  // namespace

CornerFrustum make_corner_frustum(const View& view, const glm::dvec3& scene_origin) {
    CornerFrustum frustum{make_frustum(view, scene_origin), {glm::vec3(-INFINITY), glm::vec3(INFINITY)}};
    if (frustum.mask != 0x3f) return frustum;
    const Extent extent = pushed_corners(frustum);
    if (!(extent.reach() < kInfinity)) return frustum;
    // The test rounds a box's corner once.
    const glm::dvec3 rest = frustum.eye - glm::dvec3(frustum.box_eye);
    const double margin = 0x1p-22 * extent.reach();
    frustum.corner_box = {nearest_float(extent.min + rest - margin),
                          nearest_float(extent.max + rest + margin)};
    return frustum;
}

Containment classify(const CornerFrustum& frustum, const Aabb& box, PlaneMask& mask) {
    const Containment containment = classify(static_cast<const Frustum&>(frustum), box, mask);
    if (containment != Containment::Intersecting) return containment;
    const glm::vec3 low = box.min - frustum.box_eye, high = box.max - frustum.box_eye;
    const Aabb& corners = frustum.corner_box;
    const bool beyond = high.x < corners.min.x || high.y < corners.min.y || high.z < corners.min.z ||
                        low.x > corners.max.x || low.y > corners.max.y || low.z > corners.max.z;
    if (!beyond) return Containment::Intersecting;
    // A NaN on another axis must not be proved anything.
    return std::isfinite(glm::dot(low, high)) ? Containment::Outside : Containment::Intersecting;
}

}  // namespace rhview
