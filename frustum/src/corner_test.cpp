// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// What a renderer may draw of a box lies in the planes pushed outwards by its rounding, which grows with the
// farthest vertex of the box (a triangle is interpolated between its vertices' errors). So there is a
// polytope for each of some reaches. Its corners are those of its planes' triples that lie on its right side
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
#include <span>

#include "box_test.h"
#include "rhview/base/rounding.h"

namespace rhview {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A corner that misses a plane by this share of its distance still counts: too many only grow the extents.
constexpr double kTolerance = 1e-7;

// Reaches, beside the frustum's own.
constexpr double kFirstReach = 2.0, kNextReach = 64.0;

/// Twenty triples of planes, at most, meet in corners.
struct Corners {
    std::array<glm::dvec3, 20> points;
    int count = 0;

    [[nodiscard]] std::span<const glm::dvec3> span() const {
        return std::span(points).first(static_cast<std::size_t>(count));
    }
    /// The greatest distance from the eye on any axis; infinite if there is no corner.
    [[nodiscard]] double reach() const {
        double reach = count > 0 ? 0.0 : kInfinity;
        for (const glm::dvec3& point : span())
            for (int axis = 0; axis < 3; ++axis) reach = std::max(reach, std::abs(point[axis]));
        return reach;
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

Corners corners_of(const std::array<HalfSpace, 6>& planes) {
    Corners corners;
    for (int i = 0; i < 6; ++i)
        for (int j = i + 1; j < 6; ++j)
            for (int k = j + 1; k < 6; ++k) {
                const glm::dmat3 normals =
                    glm::transpose(glm::dmat3(planes[i].normal, planes[j].normal, planes[k].normal));
                if (!(std::abs(glm::determinant(normals)) > 1e-12)) continue;
                const glm::dvec3 corner =
                    glm::inverse(normals) *
                    -glm::dvec3(planes[i].distance, planes[j].distance, planes[k].distance);
                if (is_inside(planes, corner)) corners.points[corners.count++] = corner;
            }
    return corners;
}

/// The corners of the planes pushed by what they err by at `reach`.
Corners pushed_corners(const Frustum& frustum, double reach) {
    std::array<HalfSpace, 6> planes;
    for (int i = 0; i < 6; ++i) {
        const FrustumPlane& plane = frustum.planes[i];
        planes[i] = {glm::dvec3(plane.normal), plane.distance};
        planes[i].distance += glm::dot(glm::dvec3(plane.slack_per_metre), glm::dvec3(reach)) + plane.slack;
    }
    return corners_of(planes);
}

/// At right angles to an axis and an edge where two planes meet.
void find_edge_axes(CornerFrustum& frustum) {
    constexpr int kEdges[6][2] = {{Frustum::Left, Frustum::Bottom}, {Frustum::Right, Frustum::Bottom},
                                  {Frustum::Left, Frustum::Top},    {Frustum::Right, Frustum::Top},
                                  {Frustum::Near, Frustum::Left},   {Frustum::Near, Frustum::Bottom}};
    for (const auto& [first, second] : kEdges) {
        const glm::dvec3 edge =
            glm::cross(glm::dvec3(frustum.planes[first].normal), glm::dvec3(frustum.planes[second].normal));
        for (int k = 0; k < 3; ++k) {
            glm::dvec3 axis(0.0);
            axis[(k + 1) % 3] = edge[(k + 2) % 3];
            axis[(k + 2) % 3] = -edge[(k + 1) % 3];
            const double greatest = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
            // Along an edge that is an axis nothing new is seen.
            if (greatest > 1e-6 * glm::length(edge))
                frustum.edge_axes[frustum.edge_axis_count++] = nearest_float(axis / greatest);
        }
    }
}

/// Of the corners, relative to `box_eye`, which is `rest` from the eye.
CornerFrustum::Extent extent_of(const CornerFrustum& frustum, const Corners& corners, const glm::dvec3& rest,
                                double reach) {
    // A box's corner is rounded once.
    const double margin = 0x1p-22 * corners.reach();
    glm::dvec3 low(kInfinity), high(-kInfinity);
    for (const glm::dvec3& corner : corners.span()) {
        low = glm::min(low, corner + rest - margin);
        high = glm::max(high, corner + rest + margin);
    }
    CornerFrustum::Extent extent;
    extent.reach = static_cast<float>(reach);
    extent.corner_box = {nearest_float(low), nearest_float(high)};
    for (int i = 0; i < frustum.edge_axis_count; ++i) {
        double least = kInfinity, most = -kInfinity;
        for (const glm::dvec3& corner : corners.span()) {
            const double value = glm::dot(glm::dvec3(frustum.edge_axes[i]), corner + rest);
            least = std::min(least, value);
            most = std::max(most, value);
        }
        extent.low[i] = nearest_float(least - margin);
        extent.high[i] = nearest_float(most + margin);
    }
    return extent;
}

bool is_beyond(const Aabb& corners, const glm::vec3& low, const glm::vec3& high) {
    return high.x < corners.min.x || high.y < corners.min.y || high.z < corners.min.z ||
           low.x > corners.max.x || low.y > corners.max.y || low.z > corners.max.z;
}

/// `slack` covers the rounding of two products and a sum many times.
bool is_beyond_edges(const CornerFrustum& frustum, const CornerFrustum::Extent& extent, const glm::vec3& low,
                     const glm::vec3& high, float slack) {
    for (int i = 0; i < frustum.edge_axis_count; ++i) {
        const glm::vec3& a = frustum.edge_axes[i];
        const float middle = glm::dot(a, low) + glm::dot(a, high);
        const float radius = glm::dot(glm::abs(a), high - low);
        // Twice the values, to save the halves.
        if (middle + radius + slack < 2.0f * extent.low[i] || middle - radius - slack > 2.0f * extent.high[i])
            return true;
    }
    return false;
}

}  // namespace

CornerFrustum make_corner_frustum(const View& view, const glm::dvec3& scene_origin) {
    CornerFrustum frustum{make_frustum(view, scene_origin), {}, 0, {}};
    if (frustum.mask != 0x3f) return frustum;
    find_edge_axes(frustum);
    const glm::dvec3 rest = frustum.eye - glm::dvec3(frustum.box_eye);
    double reach = kFirstReach * pushed_corners(frustum, 0.0).reach();
    for (CornerFrustum::Extent& extent : frustum.extents) {
        if (!(reach < 1e30)) break;
        const Corners corners = pushed_corners(frustum, reach);
        if (!(corners.reach() <= reach)) break;
        extent = extent_of(frustum, corners, rest, reach);
        reach *= kNextReach;
    }
    return frustum;
}

Containment classify(const CornerFrustum& frustum, const Aabb& box, PlaneMask& mask) {
    const Containment containment = classify(static_cast<const Frustum&>(frustum), box, mask);
    if (containment != Containment::Intersecting) return containment;
    const glm::vec3 low = box.min - frustum.box_eye, high = box.max - frustum.box_eye;
    const float slack = box_slack(low, high);
    for (const CornerFrustum::Extent& extent : frustum.extents) {
        // NaN and infinity are in no reach.
        if (!(slack <= kBoxSlack * extent.reach)) continue;
        const bool outside =
            is_beyond(extent.corner_box, low, high) || is_beyond_edges(frustum, extent, low, high, slack);
        return outside ? Containment::Outside : Containment::Intersecting;
    }
    return Containment::Intersecting;
}

}  // namespace rhview
