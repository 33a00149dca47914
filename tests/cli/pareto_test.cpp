// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "pareto.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../uniform.h"

namespace rhview::cli {
namespace {

using Front = std::vector<std::size_t>;

TEST(Pareto, front_holds_what_nothing_else_beats) {
    const std::vector<double> costs{10, 5, 6, 3, 9};
    const std::vector<double> errors{0, 1, 2, 4, 0.5};
    EXPECT_EQ(pareto_front(costs, errors), (Front{0, 4, 1, 3}));
}

TEST(Pareto, equals_stand_together_and_a_tie_in_one_goes_to_the_better_in_the_other) {
    EXPECT_EQ(pareto_front(std::vector<double>{2, 1, 1, 3}, std::vector<double>{0, 0, 0, 0}), (Front{1, 2}));
    EXPECT_EQ(pareto_front(std::vector<double>{1, 1}, std::vector<double>{2, 1}), (Front{1}));
    EXPECT_EQ(pareto_front(std::vector<double>{}, std::vector<double>{}), Front{});
}

TEST(Pareto, what_was_not_measured_is_never_better) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(pareto_front(std::vector<double>{unknown, 1, 0}, std::vector<double>{0, 1, unknown}),
              (Front{0, 1, 2}));
    EXPECT_EQ(pareto_front(std::vector<double>{unknown, 1}, std::vector<double>{1, 1}), (Front{1}));
}

TEST(Pareto, agrees_with_comparing_everything_with_everything) {
    Uniform uniform(5);
    for (int round = 0; round < 200; ++round) {
        std::vector<double> costs, errors;
        for (int i = 0; i < 25; ++i) {
            costs.push_back(std::floor(uniform(0, 12)));
            errors.push_back(std::floor(uniform(0, 12)));
        }
        const Front front = pareto_front(costs, errors);
        for (std::size_t i = 0; i < costs.size(); ++i) {
            bool beaten = false;
            for (std::size_t k = 0; k < costs.size(); ++k)
                beaten = beaten || (costs[k] <= costs[i] && errors[k] <= errors[i] &&
                                    (costs[k] < costs[i] || errors[k] < errors[i]));
            EXPECT_EQ(std::ranges::find(front, i) != front.end(), !beaten) << i;
        }
    }
}

}  // namespace
}  // namespace rhview::cli
