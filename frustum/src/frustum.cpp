// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Planes: Gribb & Hartmann, "Fast extraction of viewing frustum planes from the world-view-projection
// matrix", 2001. Test: Assarsson & Möller, "Optimized view frustum culling algorithms for bounding boxes",
// 2000 (p- and n-vertex, plane masks), with the slack derived below.

#include "rhview/frustum/frustum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "box_test.h"
#include "rhview/base/rounding.h"

namespace rhview {
namespace {

// Slack. Let u = 2^-24. The renderer evaluates a plane a ± b (two rows of the clip matrix) at v - eye in
// float: rounding v - eye (2u), the matrix entries (1u), three products and three sums (4u) gives at most 7u
// · Σ w_j |v_j - eye_j| with w_j = |a_j| + |b_j|. Our own test rounds v - eye the same way, the normal, three
// products and three sums: 7u of the same sum at most. The rest up to 16u covers the rounding of the slack
// itself. Box tests divide the plane by the greatest w_j, and allow 3 · 16u times the greatest |v_j - eye_j|.
constexpr double kRoundingUnits = 16.0;
constexpr double kUnit = 0x1p-24;

// Splitting the eye in two floats leaves 2^-48 of it, used three times. Box tests subtract the first of the
// two and put the second, at most 2^-24 of the eye, into the plane's distance: 7u of it are not seen by the
// slack.
constexpr double kEyeSplit = 0x1p-44;

// Below this share of its rows a combined normal is cancellation noise: the plane is at infinity.
constexpr double kNoNormal = 1e-13;

float rounded_up(double value) {
    return std::nextafter(nearest_float(value), HUGE_VALF);
}

/// False if there is no such plane. `sum` = 0 lies on it, `weight` is what its error grows with.
bool make_planes(const glm::dvec4& sum, const glm::dvec4& weight, const glm::dvec3& eye_rest,
                 double eye_magnitude, FrustumPlane& plane, BoxPlane& box_plane) {
    const glm::dvec3 weight3(weight);
    const double length = glm::length(glm::dvec3(sum));
    if (!(length > kNoNormal * glm::length(weight3))) return false;
    const double eye_slack = kEyeSplit * eye_magnitude * (weight.x + weight.y + weight.z);
    const double scale = kRoundingUnits * kUnit / length;
    plane.normal = glm::vec3(glm::dvec3(sum) / length);
    plane.distance = static_cast<float>(sum.w / length);
    plane.slack_per_metre = glm::vec3(scale * weight3);
    plane.slack = static_cast<float>(scale * weight.w + eye_slack / length);

    const double greatest = std::max({weight.x, weight.y, weight.z});
    const double slack = (kRoundingUnits * kUnit * weight.w + eye_slack) / greatest;
    const double distance = (sum.w - glm::dot(glm::dvec3(sum), eye_rest)) / greatest;
    box_plane.normal = nearest_float(glm::dvec3(sum) / greatest);
    box_plane.outside_distance = rounded_up(distance + slack);
    box_plane.inside_distance = -rounded_up(slack - distance);
    return true;
}

static_assert(kBoxSlack == 3 * kRoundingUnits * kUnit);

}  // namespace

Frustum make_frustum(const View& view, const glm::dvec3& scene_origin) {
    RHVIEW_ASSERT(validate(view).ok());
    Frustum frustum;
    frustum.eye = view.eye() - scene_origin;
    frustum.box_eye = nearest_float(frustum.eye);
    const glm::dvec3 rest = frustum.eye - glm::dvec3(frustum.box_eye);
    const double eye_magnitude = glm::length(frustum.eye);
    const glm::dmat4 rows = glm::transpose(view.clip_from_eye_relative());
    const glm::dvec4 zero(0.0);
    const auto set = [&](Frustum::Plane index, const glm::dvec4& a, const glm::dvec4& b, double sign) {
        if (make_planes(a + sign * b, glm::abs(a) + glm::abs(b), rest, eye_magnitude, frustum.planes[index],
                        frustum.box_planes[index]))
            frustum.mask = static_cast<PlaneMask>(frustum.mask | 1u << index);
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
    const glm::vec3 low = box.min - frustum.box_eye;
    const glm::vec3 high = box.max - frustum.box_eye;
    const float slack = box_slack(low, high);
    PlaneMask crossed = 0;
    for (unsigned rest = mask; rest != 0; rest &= rest - 1) {
        const int index = std::countr_zero(rest);
        const BoxPlane& plane = frustum.box_planes[index];
        const glm::vec3& n = plane.normal;
        const bool x = n.x >= 0.0f, y = n.y >= 0.0f, z = n.z >= 0.0f;
        const float p =
            (n.x * (x ? high.x : low.x) + n.y * (y ? high.y : low.y)) + n.z * (z ? high.z : low.z);
        // Written so that NaN proves nothing: both comparisons are then false.
        if ((p + plane.outside_distance) + slack < 0.0f) return Containment::Outside;
        const float q =
            (n.x * (x ? low.x : high.x) + n.y * (y ? low.y : high.y)) + n.z * (z ? low.z : high.z);
        if (!((q + plane.inside_distance) - slack >= 0.0f))
            crossed = static_cast<PlaneMask>(crossed | 1u << index);
    }
    mask = crossed;
    return crossed == 0 ? Containment::Inside : Containment::Intersecting;
}

}  // namespace rhview
