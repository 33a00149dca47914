// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "statistics.h"

#include <gtest/gtest.h>

#include <vector>

namespace rhview::cli {
namespace {

TEST(Statistics, of_one_value_are_that_value) {
    const std::vector<double> one{3.0};
    const Statistics s = summarise(one);
    EXPECT_EQ(s.mean, 3.0);
    EXPECT_EQ(s.median, 3.0);
    EXPECT_EQ(s.p95, 3.0);
    EXPECT_EQ(s.max, 3.0);
}

TEST(Statistics, of_one_to_twenty_in_any_order) {
    std::vector<double> values;
    for (int i = 20; i >= 1; --i) values.push_back(i);
    const Statistics s = summarise(values);
    EXPECT_EQ(s.mean, 10.5);
    EXPECT_EQ(s.median, 10.5);
    EXPECT_EQ(s.p95, 19.0);
    EXPECT_EQ(s.max, 20.0);
}

TEST(Statistics, median_of_an_odd_count_is_the_middle) {
    const std::vector<double> values{9.0, 1.0, 2.0};
    EXPECT_EQ(summarise(values).median, 2.0);
}

}  // namespace
}  // namespace rhview::cli
