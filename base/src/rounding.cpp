// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/rounding.h"

namespace rhview {

float nearest_float(double value) {
    const volatile float rounded = static_cast<float>(value);
    return rounded;
}

glm::vec3 nearest_float(const glm::dvec3& value) {
    return {nearest_float(value.x), nearest_float(value.y), nearest_float(value.z)};
}

SplitPosition split_position(const glm::dvec3& position) {
    const glm::vec3 high = nearest_float(position);
    return {high, nearest_float(position - glm::dvec3(high))};
}

}  // namespace rhview
