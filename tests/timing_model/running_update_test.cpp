// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/timing_model/running_update.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "synthetic.h"

namespace rhview {
namespace {

using test::kCoreMachine;
using test::samples_of;

TimingProfile calibrated(Combination combination = Combination::Sum) {
    FitOptions options;
    options.combination = combination;
    const Result<Fit> fit =
        fit_terms(samples_of(kCoreMachine, combination, 200, 0.03, 1), test::kCoreTerms, options);
    EXPECT_TRUE(fit.ok());
    return fit.ok() ? make_profile(*fit) : TimingProfile{};
}

Constants with_draw_calls(double c3_ns) {
    Constants machine = kCoreMachine;
    machine[index_of(Term::DrawCalls)] = c3_ns;
    return machine;
}

class RunningUpdateCombination : public testing::TestWithParam<Combination> {};

TEST_P(RunningUpdateCombination, follows_draw_calls_that_become_twice_as_dear) {
    RunningUpdate update(calibrated(GetParam()));
    for (const Sample& sample : samples_of(with_draw_calls(800.0), GetParam(), 400, 0.03, 2))
        update.observe(sample);
    EXPECT_NEAR(update.profile().c3_ns, 800.0, 40.0);
    EXPECT_NEAR(update.profile().c1_ns, 0.3, 0.02);
    EXPECT_GT(update.learned_count(), 300u);
}

TEST_P(RunningUpdateCombination, follows_draw_calls_that_become_half_as_dear) {
    RunningUpdate update(calibrated(GetParam()));
    for (const Sample& sample : samples_of(with_draw_calls(200.0), GetParam(), 400, 0.03, 3))
        update.observe(sample);
    EXPECT_NEAR(update.profile().c3_ns, 200.0, 12.0);
    EXPECT_NEAR(update.profile().c1_ns, 0.3, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Combinations, RunningUpdateCombination,
                         testing::Values(Combination::Sum, Combination::MaxOfCpuAndGpu),
                         [](const auto& test) {
                             return std::string(test.param == Combination::Sum ? "sum" : "maximum");
                         });

TEST(RunningUpdate, a_machine_that_does_not_change_keeps_its_constants) {
    RunningUpdate update(calibrated());
    for (const Sample& sample : samples_of(kCoreMachine, Combination::Sum, 5000, 0.03, 4))
        update.observe(sample);
    EXPECT_NEAR(update.profile().c3_ns / 400.0, 1.0, 0.05);
    EXPECT_NEAR(update.profile().c1_ns / 0.3, 1.0, 0.05);
    EXPECT_EQ(update.change_count(), 0u);
    EXPECT_LT(update.outlier_count(), 10u);
}

TEST(RunningUpdate, does_not_move_when_frozen) {
    RunningUpdate update(calibrated());
    const Constants before = update.profile().constants();
    update.set_frozen(true);
    EXPECT_TRUE(update.is_frozen());
    for (const Sample& sample : samples_of(with_draw_calls(4000.0), Combination::Sum, 200, 0.03, 5))
        EXPECT_EQ(update.observe(sample), RunningUpdate::Outcome::Frozen);
    EXPECT_EQ(update.profile().constants(), before);
    EXPECT_EQ(update.learned_count() + update.outlier_count() + update.invalid_count(), 0u);
    update.set_frozen(false);
    EXPECT_EQ(update.observe(samples_of(kCoreMachine, Combination::Sum, 1, 0.01, 6)[0]),
              RunningUpdate::Outcome::Learned);
}

TEST(RunningUpdate, single_outliers_are_counted_and_change_nothing) {
    RunningUpdate update(calibrated());
    auto samples = samples_of(kCoreMachine, Combination::Sum, 300, 0.03, 7);
    std::uint64_t expected = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const bool spoiled = i % 10 == 3;
        if (spoiled) samples[i].measured_ns *= i % 20 == 3 ? 100.0 : 0.01;
        const Constants before = update.profile().constants();
        const RunningUpdate::Outcome outcome = update.observe(samples[i]);
        if (!spoiled) continue;
        ++expected;
        EXPECT_EQ(outcome, RunningUpdate::Outcome::Outlier);
        EXPECT_EQ(update.profile().constants(), before);
    }
    EXPECT_EQ(update.outlier_count(), expected);
    EXPECT_EQ(update.change_count(), 0u);
}

TEST(RunningUpdate, samples_that_mean_nothing_are_counted_and_change_nothing) {
    RunningUpdate update(calibrated());
    const Constants before = update.profile().constants();
    const Sample good = samples_of(kCoreMachine, Combination::Sum, 1, 0.0, 8)[0];
    for (const double time :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_EQ(update.observe({good.work, time}), RunningUpdate::Outcome::Invalid);
    }
    Sample negative = good;
    negative.work.queries = -1.0;
    EXPECT_EQ(update.observe(negative), RunningUpdate::Outcome::Invalid);
    EXPECT_EQ(update.invalid_count(), 5u);
    EXPECT_EQ(update.profile().constants(), before);
}

TEST(RunningUpdate, a_clock_that_jumps_now_and_then_changes_nothing) {
    RunningUpdate update(calibrated());
    const std::vector<Sample> samples = samples_of(kCoreMachine, Combination::Sum, 400, 0.03, 21);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        update.observe(samples[i]);
        if (i % 40 == 20) update.observe({samples[i].work, i % 80 == 20 ? 3.6e15 : 1e-3});
        ASSERT_TRUE(std::isfinite(update.predict_ns(samples[i].work)));
    }
    EXPECT_NEAR(update.profile().c3_ns, 400.0, 40.0);
}

TEST(RunningUpdate, constants_never_become_negative_and_come_back) {
    TimingProfile profile;  // nothing is known of its errors
    profile.c0_ns = 50e3;
    profile.c1_ns = 0.3;
    profile.c3_ns = 400.0;
    RunningUpdate update(profile);
    for (const Sample& sample : samples_of(with_draw_calls(0.0), Combination::Sum, 300, 0.03, 9)) {
        update.observe(sample);
        for (const double constant : update.profile().constants()) ASSERT_GE(constant, 0.0);
    }
    EXPECT_LT(update.profile().c3_ns, 20.0);
    for (const Sample& sample : samples_of(kCoreMachine, Combination::Sum, 400, 0.03, 10))
        update.observe(sample);
    EXPECT_NEAR(update.profile().c3_ns, 400.0, 40.0);
}

TEST(RunningUpdate, frames_that_are_all_alike_do_not_blow_it_up) {
    RunningUpdate update(calibrated());
    test::Random random(11);
    const Work work = test::random_work(random);
    const double truth = predict_ns(kCoreMachine, Combination::Sum, work);
    for (int i = 0; i < 20000; ++i) update.observe({work, truth * (1.0 + 0.03 * random.normal())});
    EXPECT_NEAR(update.predict_ns(work) / truth, 1.0, 0.05);
    for (const Sample& sample : samples_of(kCoreMachine, Combination::Sum, 200, 0.03, 12))
        update.observe(sample);
    EXPECT_NEAR(update.profile().c3_ns, 400.0, 40.0);
    EXPECT_NEAR(update.profile().c1_ns, 0.3, 0.03);
}

TEST(RunningUpdate, learns_only_the_terms_of_the_profile) {
    RunningUpdate update(calibrated());
    for (const Sample& sample : samples_of(kCoreMachine, Combination::Sum, 50, 0.03, 13))
        update.observe(sample);
    EXPECT_FALSE(update.profile().query_ns.has_value());
    EXPECT_FALSE(update.profile().fragment_ns.has_value());
}

}  // namespace
}  // namespace rhview
