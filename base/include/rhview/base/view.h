// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A camera in double precision, and its camera-relative form.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "rhview/base/result.h"

namespace rhview {

/// Which interval of z/w lies inside the clip volume.
enum class ClipDepth {
    NegativeOneToOne,   ///< near -1, far +1: OpenGL's default
    ZeroToOne,          ///< near 0, far 1: Direct3D, Vulkan
    ReversedZeroToOne,  ///< near 1, far 0; the far plane may be at infinity
};

/// A camera. `validate` says whether it can be used; what takes one relies on that.
struct View {
    glm::dmat4 camera_from_world{1.0};  ///< affine; rotation and translation, as a rule
    glm::dmat4 clip_from_camera{1.0};   ///< perspective, orthographic or oblique
    ClipDepth clip_depth = ClipDepth::NegativeOneToOne;

    /// Where the camera is, in world space.
    [[nodiscard]] glm::dvec3 eye() const;
    /// Maps (world position - eye) to clip space: the camera's translation is gone from it.
    [[nodiscard]] glm::dmat4 clip_from_eye_relative() const;
};

/// Fails if a number is not finite, `camera_from_world` is not affine and invertible, or the projection is
/// singular in x, y and w (their rows depend on one another). A zero depth row is allowed: an infinite far
/// plane has one.
Status validate(const View& view);

/// A view at `eye` that looks along `forward`. `forward` and `up` need not be unit or orthogonal, but must
/// not be parallel: such a view fails `validate`.
glm::dmat4 look_along(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up);

/// A symmetric perspective projection. `fov_y` in radians; 0 < `near` < `far`; `far` may be infinite.
/// Source: Akenine-Möller et al., Real-Time Rendering, 4th ed., section 4.7.
glm::dmat4 perspective(double fov_y, double aspect, double near, double far, ClipDepth clip_depth);

/// A symmetric orthographic projection of `width` × `height` metres.
glm::dmat4 orthographic(double width, double height, double near, double far, ClipDepth clip_depth);

}  // namespace rhview
