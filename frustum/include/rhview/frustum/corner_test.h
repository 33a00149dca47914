// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The test that planes lack: a box that crosses the planes' continuations, but lies beyond all corners of
/// the frustum, is outside. It pays for boxes that are large beside the frustum (inner nodes, shadow
/// cascades); a caller who wants it makes this type of frustum instead of the plain one.
#pragma once

#include "rhview/frustum/frustum.h"

namespace rhview {

/// A frustum and the box of its corners.
struct CornerFrustum : Frustum {
    /// Relative to `box_eye`, grown by what a renderer's rounding may add. Infinite, so of no effect, where
    /// the frustum has no end (no far plane) or where rounding moves its far plane out of sight.
    Aabb corner_box;
};

CornerFrustum make_corner_frustum(const View& view, const glm::dvec3& scene_origin = glm::dvec3(0.0));

/// As for a plain frustum, and `Outside` for a box beyond all corners on one axis: the same kind of proof.
/// Cost: six comparisons more where the planes do not decide. Source: Quílez, "Fixing frustum culling", 2013.
Containment classify(const CornerFrustum& frustum, const Aabb& box, PlaneMask& mask);

}  // namespace rhview
