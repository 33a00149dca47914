// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// View frustum planes and box classification.
///
/// Conventions: plane normals point into the frustum and have unit length, so a signed distance is in world
/// units. `Outside` and `Inside` are proofs, also far from the origin: the slack covers the rounding of this
/// test and of a renderer that subtracts the eye and applies the camera-relative clip matrix in `float`, as
/// `gl` does. `Intersecting` proves nothing.
///
/// Every box test of this module, one box or many, does the same operations in the same order: a box gets the
/// same answer from each of them, on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "rhview/base/aabb.h"
#include "rhview/base/view.h"

namespace rhview {

/// Of a box. `Outside` and `Inside` are proofs, `Intersecting` proves nothing.
enum class Containment { Outside, Intersecting, Inside };

/// One bit per plane that is still to be tested, in the order of `Frustum::Plane`.
using PlaneMask = std::uint8_t;

/// Camera-relative: a point p of the scene is tested as p - eye.
struct FrustumPlane {
    glm::vec3 normal{0.0f};
    float distance = 0.0f;  ///< signed distance of the eye
    /// A vertex v within |v - eye| <= m (per axis) is evaluated by the renderer with an error of at most
    /// dot(slack_per_metre, m) + slack.
    glm::vec3 slack_per_metre{0.0f};
    float slack = 0.0f;
};

/// A plane as box tests use it: scaled so that the renderer, and the test, evaluate it at a vertex v with an
/// error of at most kBoxSlack times the greatest |coordinate| of v - box_eye, and what the two distances
/// hold.
struct BoxPlane {
    glm::vec3 normal{0.0f};
    float outside_distance = 1.0f;  ///< the plane's distance, pushed outwards: below zero proves outside
    float inside_distance = 1.0f;   ///< pushed inwards
};
/// What a box test may err by, per unit of the greatest coordinate: see `BoxPlane`.
inline constexpr float kBoxSlack = 3 * 0x1p-20f;

/// What boxes are tested against; its planes point inwards. `make_frustum` makes it of a view.
struct Frustum {
    /// The planes' order in `planes` and in a mask.
    enum Plane { Left, Right, Near, Far, Bottom, Top };

    std::array<FrustumPlane, 6> planes;
    std::array<BoxPlane, 6> box_planes;
    PlaneMask mask = 0;   ///< the planes that exist: a far plane at infinity does not
    glm::dvec3 eye{0.0};  ///< relative to the scene's origin
    glm::vec3 box_eye{
        0.0f};  ///< what box tests subtract: `eye` but for its last bits, which their planes hold
};

/// The frustum of a view that `validate` accepts; `scene_origin` is the world position of the boxes' zero.
/// A plane that is not made of numbers, or of none but zeros, does not exist: nothing is outside of it.
/// Cost: about 200 flops in double. Source: Gribb & Hartmann 2001, on the camera-relative clip matrix.
Frustum make_frustum(const View& view, const glm::dvec3& scene_origin = glm::dvec3(0.0));

/// Classifies `box` against the planes set in `mask`.
/// On return `mask` keeps only the planes that the box may cross, so a caller that descends a hierarchy
/// passes it on; after `Outside` it means nothing. A box with NaN or without end, the default empty box among
/// them, is `Intersecting`. A box with min > max on some axis holds no point: any answer is true of it.
/// Cost: two dot products per plane at most; no allocation. Thread-safe. Source: Assarsson & Möller 2000,
/// section 3.
Containment classify(const Frustum& frustum, const Aabb& box, PlaneMask& mask);

}  // namespace rhview
