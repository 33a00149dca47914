// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Planes: Gribb & Hartmann, "Fast extraction of viewing frustum planes from the world-view-projection
// matrix", 2001. Test: Assarsson & Möller, "Optimized view frustum culling algorithms for bounding boxes",
// 2000 (p- and n-vertex, plane masks), with the slack derived below.

#include "rhview/frustum/frustum.h"

#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rhview {
namespace {

// Slack. Let u = 2^-24. The renderer evaluates a plane a ± b (two rows of the clip matrix) at v - eye in
// float: rounding v - eye (2u), the matrix entries (1u), three products and three sums (4u) gives at most 7u
// · Σ w_j |v_j - eye_j| with w_j = |a_j| + |b_j|. Our own test rounds the normal, the corner, products and
// sums: 6u of the same sum at most.
constexpr double kRoundingUnits = 16.0;
constexpr double kUnit = 0x1p-24;

// Splitting the eye in two floats leaves 2^-48 of it (and the split is used three times).
constexpr double kEyeSplit = 0x1p-46;

// Below this share of its rows a combined normal is cancellation noise: the plane is at infinity.
constexpr double kNoNormal = 1e-13;

FrustumPlane make_plane(const glm::dvec4& a, const glm::dvec4& b, double sign, double eye_magnitude,
                        bool& exists) {
    const glm::dvec4 sum = a + sign * b;
    const glm::dvec4 weight = glm::abs(a) + glm::abs(b);
    const glm::dvec3 weight3(weight);
    const double length = glm::length(glm::dvec3(sum));
    exists = length > kNoNormal * glm::length(weight3);
    if (!exists) return {};
    const double scale = kRoundingUnits * kUnit / length;
    FrustumPlane plane;
    plane.normal = glm::vec3(glm::dvec3(sum) / length);
    plane.distance = static_cast<float>(sum.w / length);
    plane.slack_per_metre = glm::vec3(scale * weight3);
    plane.slack = static_cast<float>(scale * weight.w +
                                     kEyeSplit * eye_magnitude * (weight.x + weight.y + weight.z) / length);
    return plane;
}

}  // namespace

Frustum make_frustum(const View& view, const glm::dvec3& scene_origin) {
    RHVIEW_ASSERT(validate(view).ok());
    Frustum frustum;
    frustum.eye = view.eye() - scene_origin;
    const double eye_magnitude = glm::length(frustum.eye);
    const glm::dmat4 rows = glm::transpose(view.clip_from_eye_relative());
    const glm::dvec4 zero(0.0);
    const auto set = [&](Frustum::Plane index, const glm::dvec4& a, const glm::dvec4& b, double sign) {
        bool exists = false;
        frustum.planes[index] = make_plane(a, b, sign, eye_magnitude, exists);
        if (exists) frustum.mask = static_cast<PlaneMask>(frustum.mask | 1u << index);
    };
    set(Frustum::Left, rows[3], rows[0], 1.0);
    set(Frustum::Right, rows[3], rows[0], -1.0);
    set(Frustum::Bottom, rows[3], rows[1], 1.0);
    set(Frustum::Top, rows[3], rows[1], -1.0);
    switch (view.clip_depth) {
        case ClipDepth::NegativeOneToOne:
            set(Frustum::Near, rows[3], rows[2], 1.0);
            set(Frustum::Far, rows[3], rows[2], -1.0);
            break;
        case ClipDepth::ZeroToOne:
            set(Frustum::Near, rows[2], zero, 1.0);
            set(Frustum::Far, rows[3], rows[2], -1.0);
            break;
        case ClipDepth::ReversedZeroToOne:
            set(Frustum::Near, rows[3], rows[2], -1.0);
            set(Frustum::Far, rows[2], zero, 1.0);
            break;
    }
    return frustum;
}

Containment classify(const Frustum& frustum, const Aabb& box, PlaneMask& mask) {
    const glm::vec3 low(glm::dvec3(box.min) - frustum.eye);
    const glm::vec3 high(glm::dvec3(box.max) - frustum.eye);
    const glm::vec3 reach = glm::max(glm::abs(low), glm::abs(high));
    PlaneMask crossed = 0;
    for (unsigned rest = mask; rest != 0; rest &= rest - 1) {
        const int index = std::countr_zero(rest);
        const FrustumPlane& plane = frustum.planes[index];
        const glm::vec3 p_vertex(plane.normal.x >= 0.0f ? high.x : low.x,
                                 plane.normal.y >= 0.0f ? high.y : low.y,
                                 plane.normal.z >= 0.0f ? high.z : low.z);
        const glm::vec3 n_vertex(plane.normal.x >= 0.0f ? low.x : high.x,
                                 plane.normal.y >= 0.0f ? low.y : high.y,
                                 plane.normal.z >= 0.0f ? low.z : high.z);
        const float slack = glm::dot(plane.slack_per_metre, reach) + plane.slack;
        // Written so that NaN proves nothing: both comparisons are then false.
        if (glm::dot(plane.normal, p_vertex) + plane.distance < -slack) return Containment::Outside;
        if (!(glm::dot(plane.normal, n_vertex) + plane.distance >= slack))
            crossed = static_cast<PlaneMask>(crossed | 1u << index);
    }
    mask = crossed;
    return crossed == 0 ? Containment::Inside : Containment::Intersecting;
}

}  // namespace rhview
