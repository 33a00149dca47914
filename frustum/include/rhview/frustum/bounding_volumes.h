// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Spheres and oriented boxes against the frustum: `classify` as for boxes, with the same proofs, slack and
/// masks. A volume with NaN or without end is `Intersecting`; a sphere of negative radius holds no point, so
/// any answer is true of it.
#pragma once

#include <array>

#include "rhview/frustum/frustum.h"

namespace rhview {

/// Closed; one of no radius is a point.
struct Sphere {
    glm::vec3 centre{0.0f};
    float radius = 0.0f;
};

/// The points centre + Σ tᵢ · half_axes[i], |tᵢ| <= 1: a box in any direction, or any parallelepiped.
struct OrientedBox {
    glm::vec3 centre{0.0f};
    std::array<glm::vec3, 3> half_axes{};
};

/// Cost: one dot product and one for the slack per plane.
Containment classify(const Frustum& frustum, const Sphere& sphere, PlaneMask& mask);

/// Cost: four dot products and one for the slack per plane. Source: Assarsson & Möller 2000, section 3.
Containment classify(const Frustum& frustum, const OrientedBox& box, PlaneMask& mask);

}  // namespace rhview
