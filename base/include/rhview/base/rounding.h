// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Rounding from double to float that the compiler may not undo.
///
/// GCC 12.2 vectorises the way of a whole vector from double to float and back (`dvec3(vec3(v))`) and drops
/// it at -O2: `v - dvec3(vec3(v))` then is 0. What must be rounded for real goes through these functions.
#pragma once

#include <glm/vec3.hpp>

namespace rhview {

/// The nearest float.
float nearest_float(double value);
/// The same of each coordinate.
glm::vec3 nearest_float(const glm::dvec3& value);

/// A position as two floats: `high` is nearest to it, `low` to what that leaves. Relative error 2^-48.
struct SplitPosition {
    glm::vec3 high{0.0f};
    glm::vec3 low{0.0f};
};
/// The two floats of `position`; finite.
SplitPosition split_position(const glm::dvec3& position);

}  // namespace rhview
