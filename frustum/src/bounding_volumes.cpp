// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/frustum/bounding_volumes.h"

#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rhview {
namespace {

/// A volume around `centre` (relative to the eye) whose points are within `reach` of the eye on each axis;
/// `radius_along` says how far it reaches along a normal. Comparisons are written so that NaN proves nothing.
template <class RadiusAlong>
Containment classify_volume(const Frustum& frustum, const glm::vec3& centre, const glm::vec3& reach,
                            PlaneMask& mask, const RadiusAlong& radius_along) {
    PlaneMask crossed = 0;
    for (unsigned rest = mask; rest != 0; rest &= rest - 1) {
        const int index = std::countr_zero(rest);
        const FrustumPlane& plane = frustum.planes[index];
        const float slack = glm::dot(plane.slack_per_metre, reach) + plane.slack;
        const float value = glm::dot(plane.normal, centre) + plane.distance;
        const float radius = radius_along(plane.normal);
        if (value + radius < -slack) return Containment::Outside;
        if (!(value - radius >= slack)) crossed = static_cast<PlaneMask>(crossed | 1u << index);
    }
    mask = crossed;
    return crossed == 0 ? Containment::Inside : Containment::Intersecting;
}

}  // namespace

Containment classify(const Frustum& frustum, const Sphere& sphere, PlaneMask& mask) {
    const glm::vec3 centre(glm::dvec3(sphere.centre) - frustum.eye);
    return classify_volume(frustum, centre, glm::abs(centre) + sphere.radius, mask,
                           [&](const glm::vec3&) { return sphere.radius; });
}

Containment classify(const Frustum& frustum, const OrientedBox& box, PlaneMask& mask) {
    const glm::vec3 centre(glm::dvec3(box.centre) - frustum.eye);
    const glm::vec3 &a = box.half_axes[0], &b = box.half_axes[1], &c = box.half_axes[2];
    const glm::vec3 reach = glm::abs(centre) + (glm::abs(a) + glm::abs(b) + glm::abs(c));
    return classify_volume(frustum, centre, reach, mask, [&](const glm::vec3& normal) {
        return glm::abs(glm::dot(normal, a)) + glm::abs(glm::dot(normal, b)) + glm::abs(glm::dot(normal, c));
    });
}

}  // namespace rhview
