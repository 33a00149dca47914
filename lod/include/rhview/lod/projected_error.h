// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// How far an error in object units can move what is seen on the screen.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "rhview/base/aabb.h"

namespace rhview {

/// Object space.
struct BoundingSphere {
    glm::dvec3 centre{0.0};
    double radius = 0.0;
};

/// The sphere about a box. An empty box gives radius 0.
BoundingSphere sphere_of(const Aabb& box);

/// The longest that a vector of length 1 can get: the greatest singular value, rounded up. Not finite where
/// the matrix is not.
double largest_stretch(const glm::dmat3& linear);

/// Pixels on the screen that one object unit inside `sphere` can move at most: two points in it that are `d`
/// apart, of which one is on the screen, are at most `d` times this apart in the picture. Infinity if the
/// sphere reaches the plane through the eye (w <= 0): there nothing bounds it, so only error 0 is safe. 0 if
/// all of it is behind that plane: nothing of it is on the screen.
///
/// Proof: with rows x, y, w of `clip_from_object`, s = x·p / w·p and d = q - p,
///   x·q / w·q - s = ((x - s w)·d) / (w·q),
/// so the picture moves by the 2×3 matrix of (x - s w, y - t w), scaled to pixels, over w·q. Its norm is
/// convex in (s, t): it is greatest in a corner of the part of the screen that the sphere can be seen in; w·q
/// is least at the sphere's near side.
///
/// `clip_from_object` may hold any affine transform of the object, non-uniform and mirroring ones too, and
/// any projection; the caller subtracts the eye from the object's place in double. A matrix with a NaN gives
/// infinity. Cost: about 100 operations; no allocation.
double pixels_per_unit(const glm::dmat4& clip_from_object, const BoundingSphere& sphere, double width_px,
                       double height_px);

/// `error` units at `pixels_per_unit`, in pixels: 0 for error 0, whatever the factor.
inline double projected_error_px(float error, double pixels_per_unit) {
    return error == 0.0f ? 0.0 : static_cast<double>(error) * pixels_per_unit;
}

}  // namespace rhview
