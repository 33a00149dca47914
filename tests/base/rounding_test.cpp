// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/rounding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "uniform.h"

namespace rhview {
namespace {

TEST(Rounding, splits_a_position_into_two_floats_that_hold_it_to_48_bits) {
    Uniform uniform(3);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 position = uniform.point(1.0) * uniform.log(1e-3, 1e8);
        const SplitPosition split = split_position(position);
        for (int axis = 0; axis < 3; ++axis) {
            const double high = static_cast<double>(split.high[axis]),
                         low = static_cast<double>(split.low[axis]);
            EXPECT_EQ(split.high[axis], nearest_float(position[axis]));
            EXPECT_LE(std::abs(low), std::abs(position[axis]) * 0x1p-24);
            EXPECT_LE(std::abs(high + low - position[axis]), std::abs(position[axis]) * 0x1p-48);
        }
    }
}

TEST(Rounding, what_a_float_cannot_hold_is_in_the_low_part) {
    const SplitPosition split = split_position({1e7 + 0.3, 2e7 + 0.1, -3e7 + 0.0056});
    EXPECT_EQ(split.high, glm::vec3(1e7f, 2e7f, -3e7f));
    EXPECT_FLOAT_EQ(split.low.x, 0.3f);
    EXPECT_FLOAT_EQ(split.low.y, 0.1f);
    EXPECT_FLOAT_EQ(split.low.z, 0.0056f);
}

}  // namespace
}  // namespace rhview
