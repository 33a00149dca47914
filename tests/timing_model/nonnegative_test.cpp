// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "nonnegative.h"

#include <gtest/gtest.h>

#include "synthetic.h"

namespace rhview {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(Nonnegative, a_minimum_inside_is_that_of_the_linear_system) {
    const MatrixXd gram{{1.0, 0.5}, {0.5, 1.0}};
    const VectorXd x = solve_nonnegative(gram, gram * VectorXd{{2.0, 3.0}});
    EXPECT_NEAR(x[0], 2.0, 1e-9);
    EXPECT_NEAR(x[1], 3.0, 1e-9);
}

TEST(Nonnegative, an_unknown_that_would_be_negative_is_exactly_zero) {
    const MatrixXd gram{{1.0, 0.5}, {0.5, 1.0}};
    const VectorXd x = solve_nonnegative(gram, gram * VectorXd{{2.0, -1.0}});
    EXPECT_NEAR(x[0], 1.5, 1e-9);
    EXPECT_EQ(x[1], 0.0);
}

TEST(Nonnegative, random_problems_satisfy_the_kkt_conditions) {
    test::Random random(11);
    int at_bound = 0;
    for (int problem = 0; problem < 2000; ++problem) {
        const int unknowns = 1 + problem % 7;
        MatrixXd rows(unknowns + 5, unknowns);
        for (double& value : rows.reshaped()) value = random.normal();
        rows.colwise().normalize();
        VectorXd target(rows.rows());
        for (double& value : target) value = random.normal();
        const MatrixXd gram = rows.transpose() * rows;
        const VectorXd moment = rows.transpose() * target;
        const VectorXd x = solve_nonnegative(gram, moment);
        const VectorXd slope = gram * x - moment;
        for (int j = 0; j < unknowns; ++j) {
            ASSERT_GE(x[j], 0.0);
            ASSERT_GE(slope[j], -1e-8);
            ASSERT_NEAR(x[j] * slope[j], 0.0, 1e-8);
            at_bound += x[j] == 0.0;
        }
    }
    EXPECT_GT(at_bound, 1000);
}

TEST(Nonnegative, equal_and_empty_columns_give_finite_numbers) {
    const MatrixXd gram{{1.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 0.0, 0.0}};
    const VectorXd x = solve_nonnegative(gram, VectorXd{{1.0, 1.0, 0.0}});
    EXPECT_NEAR(x[0] + x[1], 1.0, 1e-6);
    EXPECT_EQ(x[2], 0.0);
}

}  // namespace
}  // namespace rhview
