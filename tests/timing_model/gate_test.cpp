// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/timing_model/gate.h"

#include <gtest/gtest.h>

#include <limits>

namespace rhview {
namespace {

TEST(Gate, a_query_is_worth_it_when_its_expected_gain_exceeds_its_price) {
    EXPECT_TRUE(worth_a_query(0.5, 1000.0, 499.0));
    EXPECT_FALSE(worth_a_query(0.5, 1000.0, 500.0));
    EXPECT_FALSE(worth_a_query(0.5, 1000.0, 501.0));
    EXPECT_FALSE(worth_a_query(0.0, 1e9, 0.0));
    EXPECT_TRUE(worth_a_query(1.0, 1.0, 0.0));
    static_assert(worth_a_query(1.0, 2.0, 1.0));
}

TEST(Gate, what_is_not_a_number_is_drawn) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(worth_a_query(kNan, 1e9, 1.0));
    EXPECT_FALSE(worth_a_query(1.0, kNan, 1.0));
    EXPECT_FALSE(worth_a_query(1.0, 1e9, kNan));
    EXPECT_FALSE(worth_a_query(0.0, kInfinity, 1.0));
    EXPECT_FALSE(worth_a_query(1.0, kInfinity, kInfinity));
}

}  // namespace
}  // namespace rhview
