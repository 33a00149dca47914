// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/timing_model/frame_budget.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "uniform.h"

namespace rhview {
namespace {

ResidualPercentiles with_p5(double p5) {
    ResidualPercentiles residuals;
    residuals.p5 = p5;
    return residuals;
}

TEST(FrameBudget, before_any_frame_the_profile_says_how_wrong_predictions_are) {
    EXPECT_DOUBLE_EQ(FrameBudget(with_p5(-0.5)).margin(), 2.0);
    EXPECT_DOUBLE_EQ(FrameBudget(with_p5(0.1)).margin(), 1.0);
    EXPECT_DOUBLE_EQ(FrameBudget(std::nullopt).margin(), 1.5);
    EXPECT_DOUBLE_EQ(FrameBudget(with_p5(-0.5)).plannable_ns(10.0), 5.0);
}

TEST(FrameBudget, of_few_frames_the_worst_counts) {
    FrameBudget budget(with_p5(-0.2));
    budget.observe(10.0, 9.0);
    EXPECT_DOUBLE_EQ(budget.margin(), 1.25);
    budget.observe(10.0, 30.0);
    EXPECT_DOUBLE_EQ(budget.margin(), 3.0);
}

TEST(FrameBudget, what_is_no_time_is_ignored) {
    FrameBudget budget(std::nullopt);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double wrong : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
        budget.observe(wrong, 1.0);
        budget.observe(1.0, wrong);
    }
    EXPECT_DOUBLE_EQ(budget.margin(), 1.5);
}

// A machine that slept, or a clock that was set: a time that is a number, and nonsense.
TEST(FrameBudget, a_clock_that_jumped_is_forgotten_with_its_frames) {
    FrameBudget budget(std::nullopt);
    for (int i = 0; i < 200; ++i) budget.observe(1e6, 1.1e6);
    const double usual = budget.margin();
    budget.observe(1e6, 3.6e15);
    budget.observe(1e6, 1e-3);
    EXPECT_TRUE(std::isfinite(budget.margin()));
    for (int i = 0; i < 1000; ++i) budget.observe(1e6, 1.1e6);
    EXPECT_DOUBLE_EQ(budget.margin(), usual);
}

TEST(FrameBudget, holds_for_the_promised_share_of_frames_like_those_before) {
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        Uniform uniform(seed);
        FrameBudget budget(with_p5(-0.3));
        int held = 0;
        constexpr int kFrames = 4000;
        for (int frame = 0; frame < kFrames; ++frame) {
            const double predicted = uniform.log(1.0, 50.0), measured = predicted * uniform.log(0.8, 1.6);
            held += measured <= predicted * budget.margin();
            budget.observe(predicted, measured);
        }
        EXPECT_GE(held, 0.96 * kFrames);
        EXPECT_LE(held, 0.99 * kFrames) << "a margin that is never used up is too wide";
    }
}

TEST(FrameBudget, follows_a_machine_that_gets_faster_within_two_seconds) {
    FrameBudget budget(std::nullopt);
    for (int i = 0; i < 200; ++i) budget.observe(1.0, 4.0);
    EXPECT_DOUBLE_EQ(budget.margin(), 4.0);
    for (int i = 0; i < 120; ++i) budget.observe(1.0, 1.1);
    EXPECT_DOUBLE_EQ(budget.margin(), 1.1);
}

}  // namespace
}  // namespace rhview
