// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// One box against one view by each of the techniques that need no memory of earlier frames.

#pragma once

#include <array>

#include "rhview/frustum/corner_test.h"
#include "rhview/frustum/techniques.h"

namespace rhview {

/// What a frame is culled with.
struct TechniqueView {
    TechniqueView(const View& view, const glm::dvec3& scene_origin, const CullingTechniques& techniques);

    CornerFrustum frustum;
    bool is_symmetric = false;  ///< perspective, with a far plane, not off-axis, not sheared
    // Radar: the camera's axes (right, up, forward), and the half opening per metre of depth.
    std::array<glm::vec3, 3> axes{};
    float wide = 0.0f, tall = 0.0f, near = 0.0f, far = 0.0f;
    // Octants: the frustum's middle, how far it is from the nearest plane.
    float middle_depth = 0.0f, clearance = 0.0f;
    // All planes side by side, two of them neutral.
    struct Lanes {
        std::array<float, 8> x{}, y{}, z{}, outside{}, inside{};
    } lanes;
};

/// A box relative to `box_eye`.
struct RelativeBox {
    RelativeBox(const TechniqueView& view, const Aabb& box);
    glm::vec3 low, high;
    float slack;
};

/// One bit per plane.
struct PlaneSides {
    unsigned outside = 0;  ///< proved
    unsigned crossed = 0;  ///< not proved inside
};

PlaneSides side_of_corners(const TechniqueView& view, const RelativeBox& box, int plane);
PlaneSides side_of_p_and_n_vertex(const TechniqueView& view, const RelativeBox& box, int plane);
PlaneSides sides_by_radar(const TechniqueView& view, const RelativeBox& box);
PlaneSides sides_in_one_vector(const TechniqueView& view, const RelativeBox& box);

/// The three planes of the box's octant, or all where it is too large for the test.
PlaneMask octant_planes(const TechniqueView& view, const RelativeBox& box);
bool is_beyond_corners(const TechniqueView& view, const RelativeBox& box);

}  // namespace rhview
