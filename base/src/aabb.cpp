// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/aabb.h"

#include <cmath>

namespace rhview {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float round_down(double value) {
    return std::nextafter(static_cast<float>(value), -kInfinity);
}

float round_up(double value) {
    return std::nextafter(static_cast<float>(value), kInfinity);
}

}  // namespace

Aabb transform_box(const glm::dmat4& to_from_box, const Aabb& box) {
    if (box.is_empty()) return {};
    Aabb result;
    for (int row = 0; row < 3; ++row) {
        double low = to_from_box[3][row];
        double high = low;
        for (int column = 0; column < 3; ++column) {
            const double a = to_from_box[column][row] * static_cast<double>(box.min[column]);
            const double b = to_from_box[column][row] * static_cast<double>(box.max[column]);
            low += std::fmin(a, b);
            high += std::fmax(a, b);
        }
        result.min[row] = round_down(low);
        result.max[row] = round_up(high);
    }
    return result;
}

}  // namespace rhview
