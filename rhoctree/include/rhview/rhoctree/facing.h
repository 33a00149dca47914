// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// From where a set of triangles is seen from behind only: normal cones and the test against a viewpoint.
///
/// Front faces are counter-clockwise by the order of a triangle's indices; positions are `float` in scene
/// space, metres. Two-sided materials have no back: don't ask for them. A set that a matrix places is tested
/// with the viewpoint taken into the set's space: turning, moving and uniform scaling keep the slack, a
/// matrix that mirrors turns the winding round (ask nothing then, or bound the set with two indices swapped).
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "rhview/base/view.h"

namespace rhview {

/// Bounds a set of triangles. `apex` lies on or behind the plane of each; each normal is within the angle
/// asin(`cutoff`) of `axis`. Parallel normals have cutoff 0 (up to the rounding of `axis`, 2^-22) and an apex
/// on the lowest plane: the test is then that of the slab. The default is never culled.
struct FacingCone {
    glm::vec3 apex{0.0f};
    float reach = 0.0f;  ///< no corner is farther from `apex`, metres
    glm::vec3 axis{0.0f};
    float cutoff = 2.0f;  ///< above 1: never culled
};

/// What a triangle that is seen from behind must have between its plane and the rays to its corners, as the
/// sine of the angle, before it counts as turned away.
///
/// Rasterisers snap corners to 1/256 of a pixel and vertex shaders round: a triangle almost edge-on may come
/// out front-facing. With an error of at most e pixels per corner the sign of a triangle's area holds if the
/// sine exceeds 3e / h, where h is its shortest altitude in pixels, seen face-on (the sum over the corners
/// of e times the opposite edge is at most 3e times the longest edge). For e = sqrt(2)/512 (snapping) and
/// h = 1 pixel that is 0.0083; 2^-7 = 0.0078 thus proves it for triangles of 1.06 pixels and more. Rounding
/// of a camera-relative `float` transform, 16 · 2^-24 of the distance, is below that as long as the altitude
/// is above 1/2700 of the distance. A thinner or smaller triangle can flip at steeper angles: nothing but its
/// own pixels could tell.
inline constexpr float kFacingSlack = 0x1p-7f;

/// From where a camera sees the scene. Mirroring views (a planar reflection, a flipped axis) are `Unknown`,
/// since they turn the winding round and only the engine knows whether it follows: nothing is ever culled.
struct Viewpoint {
    /// Perspective has a point, parallel projection a direction; of `Unknown` nothing faces away.
    enum class Kind : std::uint8_t { Unknown, Point, Direction };

    Kind kind = Kind::Unknown;
    glm::dvec3 point{0.0};      ///< centre of projection, relative to the scene's origin (`Point`)
    glm::vec3 direction{0.0f};  ///< unit, from the viewer into the scene (`Direction`)
    float slack = kFacingSlack;
};

/// The viewpoint of a view that `validate` accepts: a point for any perspective (asymmetric, oblique near
/// plane, infinite far plane), a direction where w is constant. `Unknown` also for what lies between, to
/// rounding, and for an orthographic view whose depth row does not say which way it looks. Cost: about 150
/// flops in double. Derivation: facing.cpp.
Viewpoint make_viewpoint(const View& view, const glm::dvec3& scene_origin = glm::dvec3(0.0));

/// The smallest cone over the normals of the triangles `indices` (three each, into `positions`), its apex as
/// far along the axis as the planes allow. Triangles without area draw nothing and bind nothing: those whose
/// altitude is below 2^-30 of an edge, where corners in `float` leave no normal. Never culled: normals that
/// no cone of less than 89.9 degrees holds, a corner that is not finite, a set without area. Rounded
/// outwards: the `float` cone is measured against each triangle in double.
/// Cost: linear, about ten passes over the normals; allocates 48 bytes per triangle while it runs.
FacingCone bound_facing(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

/// Proves that all triangles of the set are back-facing for a renderer, by a margin of `viewpoint.slack`.
/// False proves nothing, and NaN gives false. Cost: 25 flops; no division, no root. Thread-safe. Why: for
/// unit n within the cone and r = apex - viewpoint, axis·r >= sin·|r| + m gives n·r >= m, and n·(corner -
/// viewpoint) >= n·r since the apex is behind the plane; with m = slack · (|r| + reach) the sine at every
/// corner is at least the slack. Rounding of this test is below 2^-13 of m. Source: anchored cones,
/// Sander et al., "Silhouette clipping", 2000; the slack is our own.
inline bool faces_away(const FacingCone& cone, const Viewpoint& viewpoint) {
    // Squares of less would be denormal, and their rounding no longer small.
    constexpr float kLeastMargin = 1e-15f;
    const float sine = cone.cutoff + viewpoint.slack;
    switch (viewpoint.kind) {
        case Viewpoint::Kind::Point: {
            const glm::vec3 r(glm::dvec3(cone.apex) - viewpoint.point);
            const float along = glm::dot(cone.axis, r) - viewpoint.slack * cone.reach;
            // Strictly greater: where the squares overflow both are infinite, and nothing is proved.
            // Both are computed: a branch here is a coin toss, and costs more than the products.
            const bool behind = along > kLeastMargin;
            return behind & (along * along > sine * sine * glm::dot(r, r));
        }
        case Viewpoint::Kind::Direction:
            return glm::dot(cone.axis, viewpoint.direction) > sine;
        case Viewpoint::Kind::Unknown:
            break;
    }
    return false;
}

}  // namespace rhview
