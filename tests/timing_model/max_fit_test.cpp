// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "rhview/timing_model/fit.h"
#include "synthetic.h"

namespace rhview {
namespace {

using test::kCoreMachine;
using test::kCoreTerms;
using test::samples_of;

FitOptions maximum() {
    FitOptions options;
    options.combination = Combination::MaxOfCpuAndGpu;
    return options;
}

TEST(MaxFit, finds_the_constants_of_both_sides) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const auto samples = samples_of(kCoreMachine, Combination::MaxOfCpuAndGpu, 80, 0.02, seed);
        const Result<Fit> fit = fit_terms(samples, kCoreTerms, maximum());
        ASSERT_TRUE(fit.ok()) << fit.error().message;
        for (const Coefficient& c : fit->coefficients) {
            const double truth = kCoreMachine[index_of(c.term)];
            EXPECT_NEAR(c.value_ns, truth, 5.0 * c.standard_error_ns) << seed << ' ' << name_of(c.term);
            EXPECT_NEAR(c.value_ns, truth, 0.05 * truth) << seed << ' ' << name_of(c.term);
        }
        EXPECT_LT(fit->hold_out_error, 0.025);
    }
}

TEST(MaxFit, intervals_cover_between_92_and_98_percent) {
    int inside = 0;
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        const auto samples = samples_of(kCoreMachine, Combination::MaxOfCpuAndGpu, 120, 0.05, 500 + seed);
        const Result<Fit> fit = fit_terms(samples, kCoreTerms, maximum());
        ASSERT_TRUE(fit.ok()) << fit.error().message;
        for (const Coefficient& c : fit->coefficients)
            inside +=
                c.low_ns <= kCoreMachine[index_of(c.term)] && kCoreMachine[index_of(c.term)] <= c.high_ns;
    }
    RecordProperty("coverage", std::to_string(inside / 600.0));
    EXPECT_GE(inside, 552);
    EXPECT_LE(inside, 588);
}

TEST(MaxFit, a_side_that_is_never_the_longer_one_is_told) {
    Constants machine = kCoreMachine;
    machine[index_of(Term::DrawCalls)] = 1e-3;
    machine[index_of(Term::Constant)] = 0.0;
    const auto samples = samples_of(machine, Combination::MaxOfCpuAndGpu, 60, 0.02, 3);
    const Result<Fit> fit = fit_terms(samples, kCoreTerms, maximum());
    ASSERT_FALSE(fit.ok());
    EXPECT_NE(fit.error().message.find("the CPU's side is the longer one in only"), std::string::npos)
        << fit.error().message;
}

TEST(MaxFit, a_tenth_of_the_samples_a_hundred_times_too_slow_does_not_move_the_constants) {
    auto samples = samples_of(kCoreMachine, Combination::MaxOfCpuAndGpu, 100, 0.02, 8);
    for (std::size_t i = 0; i < 100; i += 10) samples[i].measured_ns *= 100.0;
    const Result<Fit> fit = fit_terms(samples, kCoreTerms, maximum());
    ASSERT_TRUE(fit.ok()) << fit.error().message;
    for (const Coefficient& c : fit->coefficients)
        EXPECT_NEAR(c.value_ns / kCoreMachine[index_of(c.term)], 1.0, 0.05) << name_of(c.term);
}

}  // namespace
}  // namespace rhview
