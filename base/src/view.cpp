// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/view.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace rhview {
namespace {

bool is_finite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

/// Maps OpenGL's clip depth, z in [-w, w], to the convention asked for.
glm::dmat4 convert_depth(glm::dmat4 clip, ClipDepth clip_depth) {
    if (clip_depth == ClipDepth::NegativeOneToOne) return clip;
    const double sign = clip_depth == ClipDepth::ZeroToOne ? 0.5 : -0.5;
    for (int column = 0; column < 4; ++column)
        clip[column][2] = sign * clip[column][2] + 0.5 * clip[column][3];
    return clip;
}

/// Squared volume that three rows span, each scaled to unit length; NaN when one is zero.
double gram_determinant(glm::dvec4 a, glm::dvec4 b, glm::dvec4 c) {
    a = glm::normalize(a);
    b = glm::normalize(b);
    c = glm::normalize(c);
    const double ab = glm::dot(a, b), ac = glm::dot(a, c), bc = glm::dot(b, c);
    return 1.0 + 2.0 * ab * ac * bc - ab * ab - ac * ac - bc * bc;
}

}  // namespace

glm::dvec3 View::eye() const {
    return -(glm::inverse(glm::dmat3(camera_from_world)) * glm::dvec3(camera_from_world[3]));
}

glm::dmat4 View::clip_from_eye_relative() const {
    return clip_from_camera * glm::dmat4(glm::dmat3(camera_from_world));
}

Status validate(const View& view) {
    if (!is_finite(view.camera_from_world) || !is_finite(view.clip_from_camera))
        return Error{"the camera holds a number that is not finite"};
    const glm::dmat4& camera = view.camera_from_world;
    if (camera[0][3] != 0.0 || camera[1][3] != 0.0 || camera[2][3] != 0.0 || camera[3][3] != 1.0)
        return Error{"the camera's position matrix is not affine (its last row must be 0 0 0 1)"};
    const glm::dmat3 axes(camera);
    const double volume = glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
    if (!(std::abs(glm::determinant(axes)) > 1e-9 * volume))
        return Error{"the camera is singular (is it looking along its own up vector?)"};
    // Rows x, y and w of the projection must be independent: otherwise side planes of the frustum coincide.
    const glm::dmat4 rows = glm::transpose(view.clip_from_camera);
    if (!(gram_determinant(rows[0], rows[1], rows[3]) > 1e-18))
        return Error{"the camera's projection is singular (check field of view, width and height)"};
    if (!(view.eye() == view.eye())) return Error{"the camera has no finite position"};
    return success();
}

glm::dmat4 look_along(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up) {
    const glm::dvec3 f = glm::normalize(forward);
    const glm::dvec3 side = glm::cross(f, glm::normalize(up));
    // Along `up` any direction would be as good: zero axes, which `validate` refuses by name.
    const glm::dvec3 right = glm::length(side) > 1e-9 ? glm::normalize(side) : glm::dvec3(0.0);
    const glm::dvec3 u = glm::cross(right, f);
    glm::dmat4 view(1.0);
    for (int column = 0; column < 3; ++column) {
        view[column][0] = right[column];
        view[column][1] = u[column];
        view[column][2] = -f[column];
    }
    view[3] = glm::dvec4(-glm::dot(right, eye), -glm::dot(u, eye), glm::dot(f, eye), 1.0);
    return view;
}

glm::dmat4 perspective(double fov_y, double aspect, double near, double far, ClipDepth clip_depth) {
    const double focal = 1.0 / std::tan(0.5 * fov_y);
    const bool infinite = std::isinf(far);
    glm::dmat4 clip(0.0);
    clip[0][0] = focal / aspect;
    clip[1][1] = focal;
    clip[2][3] = -1.0;
    // Each convention is written out: converting from OpenGL's loses the far plane when near/far is below
    // 1e-16.
    switch (clip_depth) {
        case ClipDepth::NegativeOneToOne:
            clip[2][2] = infinite ? -1.0 : (far + near) / (near - far);
            clip[3][2] = infinite ? -2.0 * near : 2.0 * far * near / (near - far);
            break;
        case ClipDepth::ZeroToOne:
            clip[2][2] = infinite ? -1.0 : far / (near - far);
            clip[3][2] = infinite ? -near : far * near / (near - far);
            break;
        case ClipDepth::ReversedZeroToOne:
            clip[2][2] = infinite ? 0.0 : near / (far - near);
            clip[3][2] = infinite ? near : far * near / (far - near);
            break;
    }
    return clip;
}

glm::dmat4 orthographic(double width, double height, double near, double far, ClipDepth clip_depth) {
    glm::dmat4 clip(1.0);
    clip[0][0] = 2.0 / width;
    clip[1][1] = 2.0 / height;
    clip[2][2] = 2.0 / (near - far);
    clip[3][2] = (far + near) / (near - far);
    return convert_depth(clip, clip_depth);
}

}  // namespace rhview
