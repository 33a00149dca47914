// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Radar: Placeres, "Improved frustum culling", Game Programming Gems 5, 2005. Octants: Assarsson & Möller
// 2000, section 4.2.

#include "technique_test.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "box_test.h"

namespace rhview {
namespace {

glm::vec3 corner_of(const RelativeBox& box, int i) {
    return {i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z};
}

/// A camera without scale or shear, a projection without shift.
bool is_symmetric_perspective(const View& view) {
    const glm::dmat3 axes(view.camera_from_world);
    const glm::dmat3 product = axes * glm::transpose(axes);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (std::abs(product[i][j] - (i == j ? 1.0 : 0.0)) > 1e-12) return false;
    glm::dmat4 clip = view.clip_from_camera;
    if (!(clip[0][0] > 0.0 && clip[1][1] > 0.0 && clip[2][3] == -1.0)) return false;
    clip[0][0] = clip[1][1] = clip[2][2] = clip[2][3] = clip[3][2] = 0.0;
    return clip == glm::dmat4(0.0);
}

}  // namespace

TechniqueView::TechniqueView(const View& view, const glm::dvec3& scene_origin,
                             const CullingTechniques& techniques) {
    if (techniques.frustum_box_first)
        frustum = make_corner_frustum(view, scene_origin);
    else
        static_cast<Frustum&>(frustum) = make_frustum(view, scene_origin);
    is_symmetric = frustum.mask == 0x3f && is_symmetric_perspective(view);
    const glm::dmat3 rows = glm::transpose(glm::dmat3(view.camera_from_world));
    axes = {glm::vec3(rows[0]), glm::vec3(rows[1]), glm::vec3(-rows[2])};
    wide = static_cast<float>(1.0 / view.clip_from_camera[0][0]);
    tall = static_cast<float>(1.0 / view.clip_from_camera[1][1]);
    near = -frustum.planes[Frustum::Near].distance;
    far = frustum.planes[Frustum::Far].distance;
    // The mean of the eight corners is half way between the planes.
    middle_depth = 0.5f * (near + far);
    const float to_side = std::min(wide / std::hypot(1.0f, wide), tall / std::hypot(1.0f, tall));
    clearance = 0.999f * std::min(0.5f * (far - near), middle_depth * to_side);
    for (std::size_t i = 0; i < 8; ++i) {
        const bool exists = i < 6 && (frustum.mask >> i & 1u) != 0;
        const BoxPlane plane = exists ? frustum.box_planes[i] : BoxPlane{};
        lanes.x[i] = plane.normal.x;
        lanes.y[i] = plane.normal.y;
        lanes.z[i] = plane.normal.z;
        lanes.outside[i] = plane.outside_distance;
        lanes.inside[i] = plane.inside_distance;
    }
}

RelativeBox::RelativeBox(const TechniqueView& view, const Aabb& box)
    : low(box.min - view.frustum.box_eye),
      high(box.max - view.frustum.box_eye),
      slack(box_slack(low, high)) {}

PlaneSides side_of_corners(const TechniqueView& view, const RelativeBox& box, int plane) {
    const BoxPlane& p = view.frustum.box_planes[plane];
    int outside = 0, inside = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 c = corner_of(box, i);
        const float value = (p.normal.x * c.x + p.normal.y * c.y) + p.normal.z * c.z;
        outside += (value + p.outside_distance) + box.slack < 0.0f;
        inside += (value + p.inside_distance) - box.slack >= 0.0f;
    }
    return {outside == 8 ? 1u << plane : 0u, inside == 8 ? 0u : 1u << plane};
}

PlaneSides side_of_p_and_n_vertex(const TechniqueView& view, const RelativeBox& box, int plane) {
    const BoxPlane& p = view.frustum.box_planes[plane];
    const glm::vec3& n = p.normal;
    const bool x = n.x >= 0.0f, y = n.y >= 0.0f, z = n.z >= 0.0f;
    const glm::vec3 &low = box.low, &high = box.high;
    const float far = (n.x * (x ? high.x : low.x) + n.y * (y ? high.y : low.y)) + n.z * (z ? high.z : low.z);
    if ((far + p.outside_distance) + box.slack < 0.0f) return {1u << plane, 1u << plane};
    const float close =
        (n.x * (x ? low.x : high.x) + n.y * (y ? low.y : high.y)) + n.z * (z ? low.z : high.z);
    return {0u, (close + p.inside_distance) - box.slack >= 0.0f ? 0u : 1u << plane};
}

PlaneSides sides_by_radar(const TechniqueView& view, const RelativeBox& box) {
    // The planes' slack, in the units of the limits, and the rest of the eye.
    const glm::vec3 reach = glm::max(glm::abs(box.low), glm::abs(box.high));
    const float rest = 0x1p-21f * glm::length(view.frustum.box_eye);
    const float scale[3] = {std::hypot(1.0f, view.wide), 1.0f, std::hypot(1.0f, view.tall)};
    float slack[6];
    for (unsigned k = 0; k < 6; ++k) {
        const FrustumPlane& plane = view.frustum.planes[k];
        slack[k] = scale[k / 2] * (glm::dot(plane.slack_per_metre, reach) + plane.slack + rest);
    }
    unsigned all_outside = 0x3f, all_inside = 0x3f;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 c = corner_of(box, i);
        const float x = glm::dot(view.axes[0], c), y = glm::dot(view.axes[1], c),
                    depth = glm::dot(view.axes[2], c);
        const float wide = view.wide * depth, tall = view.tall * depth;
        const float limits[6] = {wide + x, wide - x, depth - view.near, view.far - depth, tall + y, tall - y};
        unsigned outside = 0, inside = 0;
        for (unsigned k = 0; k < 6; ++k) {
            outside |= (limits[k] < -slack[k] ? 1u : 0u) << k;
            inside |= (limits[k] >= slack[k] ? 1u : 0u) << k;
        }
        all_outside &= outside;
        all_inside &= inside;
    }
    return {all_outside, ~all_inside & 0x3fu};
}

PlaneSides sides_in_one_vector(const TechniqueView& view, const RelativeBox& box) {
    const TechniqueView::Lanes& l = view.lanes;
    std::array<float, 8> far, close;
    for (std::size_t i = 0; i < 8; ++i) {
        const float x0 = l.x[i] * box.low.x, x1 = l.x[i] * box.high.x;
        const float y0 = l.y[i] * box.low.y, y1 = l.y[i] * box.high.y;
        const float z0 = l.z[i] * box.low.z, z1 = l.z[i] * box.high.z;
        far[i] =
            (((x0 > x1 ? x0 : x1) + (y0 > y1 ? y0 : y1)) + (z0 > z1 ? z0 : z1) + l.outside[i]) + box.slack;
        close[i] =
            (((x0 > x1 ? x1 : x0) + (y0 > y1 ? y1 : y0)) + (z0 > z1 ? z1 : z0) + l.inside[i]) - box.slack;
    }
    PlaneSides sides;
    for (unsigned i = 0; i < 6; ++i) {
        sides.outside |= (far[i] < 0.0f ? 1u : 0u) << i;
        sides.crossed |= (close[i] >= 0.0f ? 0u : 1u) << i;
    }
    return sides;
}

PlaneMask octant_planes(const TechniqueView& view, const RelativeBox& box) {
    const glm::vec3 half = 0.5f * (box.high - box.low), centre = box.low + half;
    if (!(glm::dot(half, half) < view.clearance * view.clearance)) return view.frustum.mask;
    const bool right = glm::dot(view.axes[0], centre) >= 0.0f, above = glm::dot(view.axes[1], centre) >= 0.0f;
    const bool beyond = glm::dot(view.axes[2], centre) >= view.middle_depth;
    return static_cast<PlaneMask>(1u << (right ? Frustum::Right : Frustum::Left) |
                                  1u << (above ? Frustum::Top : Frustum::Bottom) |
                                  1u << (beyond ? Frustum::Far : Frustum::Near));
}

bool is_beyond_corners(const TechniqueView& view, const RelativeBox& box) {
    const CornerFrustum::Extent& extent = view.frustum.extents[0];
    const Aabb& corners = extent.corner_box;
    const bool beyond = box.high.x < corners.min.x || box.high.y < corners.min.y ||
                        box.high.z < corners.min.z || box.low.x > corners.max.x ||
                        box.low.y > corners.max.y || box.low.z > corners.max.z;
    return beyond && box.slack <= kBoxSlack * extent.reach;
}

}  // namespace rhview
