// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The test that planes lack: a box that crosses the planes' continuations, but is apart from the frustum
/// when looked at along an axis or across an edge, is outside. It pays for boxes that are large beside the
/// frustum (inner nodes, shadow cascades); a caller who wants it makes this type of frustum instead of the
/// plain one.
#pragma once

#include <array>
#include <cmath>

#include "rhview/frustum/frustum.h"

namespace rhview {

/// A frustum, its extent along the axes, and along what is at right angles to an axis and one of its edges.
struct CornerFrustum : Frustum {
    /// Three axes, six edges: with the planes these are all separating axes of a symmetric frustum and a box.
    static constexpr int kMostEdgeAxes = 18;

    /// What a renderer may draw of a box whose coordinates relative to `box_eye` are at most `reach`.
    struct Extent {
        float reach = -1.0f;  ///< negative: there is no such extent
        Aabb corner_box{glm::vec3(-INFINITY), glm::vec3(INFINITY)};
        std::array<float, kMostEdgeAxes> low{};
        std::array<float, kMostEdgeAxes> high{};
    };

    std::array<glm::vec3, kMostEdgeAxes> edge_axes{};  ///< one component is 0, the greatest 1 or -1
    int edge_axis_count = 0;
    /// The larger a box, the more its vertices are moved by rounding: by rising reach. None where the
    /// frustum has no end (no far plane) or where rounding moves its far plane out of sight.
    std::array<Extent, 5> extents;
};

/// `view` is valid; boxes are relative to `scene_origin`.
CornerFrustum make_corner_frustum(const View& view, const glm::dvec3& scene_origin = glm::dvec3(0.0));

/// As for a plain frustum, and `Outside` for a box beyond the extents: the same kind of proof. A box that
/// reaches farther than all of them is tested by the planes alone. Cost: where the planes do not decide, six
/// comparisons, then 18 times two products and two comparisons at most. Sources: Quílez, "Fixing frustum
/// culling", 2013; Gottschalk, Lin & Manocha, "OBBTree", 1996.
Containment classify(const CornerFrustum& frustum, const Aabb& box, PlaneMask& mask);

}  // namespace rhview
