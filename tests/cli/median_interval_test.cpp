// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "median_interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "../uniform.h"

namespace rhview::cli {
namespace {

std::vector<double> one_to(int n) {
    std::vector<double> values(static_cast<std::size_t>(n));
    std::iota(values.begin(), values.end(), 1.0);
    return values;
}

TEST(MedianInterval, is_none_for_fewer_than_six_values) {
    for (int n = 0; n < 6; ++n) EXPECT_FALSE(median_interval(one_to(n))) << n;
    EXPECT_TRUE(median_interval(one_to(6)));
}

TEST(MedianInterval, takes_the_ranks_of_the_tables) {
    // Ranks of the 95 % interval: 6 values (1, 6), 10 (2, 9), 25 (8, 18), 100 (40, 61).
    const std::vector<std::array<int, 3>> table{{6, 1, 6}, {10, 2, 9}, {25, 8, 18}, {100, 40, 61}};
    for (const auto& [n, low, high] : table) {
        const auto interval = median_interval(one_to(n));
        ASSERT_TRUE(interval) << n;
        EXPECT_EQ(interval->low, low) << n;
        EXPECT_EQ(interval->high, high) << n;
        EXPECT_EQ(interval->median, 0.5 * (n + 1)) << n;
    }
}

TEST(MedianInterval, holds_the_median_of_a_skewed_distribution_nineteen_times_in_twenty) {
    Uniform uniform(11);
    int held = 0;
    constexpr int kTrials = 2000;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<double> values(31);
        for (double& value : values) value = -std::log(uniform(1e-12, 1.0));
        const auto interval = median_interval(values);
        held += interval->low <= std::log(2.0) && std::log(2.0) <= interval->high;
    }
    EXPECT_GE(held, 0.94 * kTrials);
    EXPECT_LE(held, 0.985 * kTrials);
}

TEST(MedianInterval, of_many_values_is_narrow) {
    const auto interval = median_interval(one_to(100'000));
    EXPECT_NEAR(interval->low, 50'000.0, 320.0);
    EXPECT_NEAR(interval->high, 50'000.0, 320.0);
}

}  // namespace
}  // namespace rhview::cli
