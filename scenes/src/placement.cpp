// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "placement.h"

#include <glm/common.hpp>
#include <limits>

namespace rhview {
namespace {

// A renderer that subtracts the eye in mesh space rounds there: seen in the scene, the error of each
// coordinate grows by Skeel's condition number, the largest row sum of |A| |A⁻¹| (Skeel 1979). Rotations and
// scalings, mirrored and unequal ones too, have at most 3; shears have more.
constexpr double kMostSkeel = 4.0;

// Far outside of what scenes hold, far inside of what float can: squares and quotients stay finite.
constexpr double kLeastScale = 1e-9;
constexpr double kMostScale = 1e9;

double skeel_condition(const glm::dmat3& linear) {
    const glm::dmat3 inverse = glm::inverse(linear);
    double largest = 0.0;
    for (int row = 0; row < 3; ++row) {
        double sum = 0.0;
        for (int k = 0; k < 3; ++k)
            for (int column = 0; column < 3; ++column)
                sum += std::abs(linear[k][row]) * std::abs(inverse[column][k]);
        largest = std::fmax(largest, sum);
    }
    return largest;
}

}  // namespace

bool can_be_drawn_through(const glm::dmat4& scene_from_mesh) {
    for (int column = 0; column < 4; ++column) {
        if (scene_from_mesh[column][3] != (column == 3 ? 1.0 : 0.0)) return false;
        const double length = glm::length(glm::dvec3(scene_from_mesh[column]));
        if (!std::isfinite(length)) return false;
        if (column < 3 && !(length >= kLeastScale && length <= kMostScale)) return false;
    }
    const glm::dmat3 linear(scene_from_mesh);
    // Written so that NaN, of a flat map, is refused.
    return glm::determinant(linear) != 0.0 && skeel_condition(linear) <= kMostSkeel;
}

bool round_outwards(const glm::dvec3& min, const glm::dvec3& max, Aabb& box) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        // A step more than rounding, for the arithmetic that led here.
        box.min[axis] = std::nextafter(static_cast<float>(min[axis]), -kInfinity);
        box.max[axis] = std::nextafter(static_cast<float>(max[axis]), kInfinity);
    }
    return !box.is_empty() && is_finite(box.min) && is_finite(box.max);
}

}  // namespace rhview
