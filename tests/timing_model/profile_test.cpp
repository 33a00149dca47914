// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/timing_model/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "synthetic.h"

namespace rhview {
namespace {

using test::kCoreTerms;

Work some_work() {
    Work work;
    work.indices = 3e6;
    work.draw_calls = 500.0;
    work.sub_draws = 900.0;
    work.queries = 20.0;
    work.material_changes = 40.0;
    work.fragments = 2e5;
    return work;
}

TEST(Profile, predicts_by_hand_and_absent_terms_cost_nothing) {
    TimingProfile profile;
    profile.c0_ns = 1000.0;
    profile.c1_ns = 0.5;
    profile.c3_ns = 400.0;
    EXPECT_EQ(profile.predict_ns(some_work()), 1000.0 + 1.5e6 + 2e5);
    profile.query_ns = 5000.0;
    profile.sub_draw_ns = 100.0;
    profile.material_ns = 250.0;
    profile.fragment_ns = 2.0;
    EXPECT_EQ(profile.predict_ns(some_work()), 1000.0 + 1.5e6 + 2e5 + 1e5 + 9e4 + 1e4 + 4e5);
}

TEST(Profile, the_maximum_takes_the_longer_side_and_the_constant) {
    TimingProfile profile;
    profile.c0_ns = 1000.0;
    profile.c1_ns = 0.5;
    profile.c3_ns = 400.0;
    profile.combination = Combination::MaxOfCpuAndGpu;
    EXPECT_EQ(profile.predict_ns(some_work()), 1000.0 + 1.5e6);
    profile.c3_ns = 4000.0;
    EXPECT_EQ(profile.predict_ns(some_work()), 1000.0 + 2e6);
    profile.fragment_ns = 5.0;
    EXPECT_EQ(profile.predict_ns(some_work()), 1000.0 + 2.5e6);
}

TEST(Profile, holds_what_the_fit_found_and_predicts_alike) {
    const auto samples = test::samples_of(test::kCoreMachine, Combination::Sum, 60, 0.05, 2);
    const Result<Fit> fit = fit_terms(samples, kCoreTerms);
    ASSERT_TRUE(fit.ok());
    const TimingProfile profile = make_profile(*fit);
    EXPECT_EQ(profile.c0_ns, fit->find(Term::Constant)->value_ns);
    EXPECT_EQ(profile.c1_ns, fit->find(Term::Indices)->value_ns);
    EXPECT_EQ(profile.c3_ns, fit->find(Term::DrawCalls)->value_ns);
    EXPECT_FALSE(profile.query_ns.has_value());
    EXPECT_EQ(profile.standard_errors_ns[index_of(Term::Indices)],
              fit->find(Term::Indices)->standard_error_ns);
    EXPECT_EQ(profile.samples, 60u);
    EXPECT_EQ(profile.hold_out_error, fit->hold_out_error);
    EXPECT_EQ(profile.predict_ns(some_work()), predict_ns(*fit, some_work()));
    EXPECT_TRUE(validate(profile).ok());
}

TEST(Profile, every_term_has_a_constant_of_its_own) {
    TimingProfile profile;
    for (const Term term : kAllTerms) profile.set_constant(term, 1.0 + static_cast<double>(index_of(term)));
    for (const Term term : kAllTerms)
        EXPECT_EQ(profile.constant(term), 1.0 + static_cast<double>(index_of(term))) << name_of(term);
}

TEST(Profile, numbers_that_cannot_be_written_are_told_by_name) {
    TimingProfile profile;
    profile.c3_ns = -1.0;
    EXPECT_EQ(validate(profile).error().message,
              "\"c3_ns\" is negative; it must be finite and not negative, so calibrate again");
    profile.c3_ns = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(validate(profile).error().message.starts_with("\"c3_ns\" is not a number;"));
    profile.c3_ns = 1.0;
    profile.query_ns = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(validate(profile).error().message.starts_with("\"query_ns\" is infinite;"));
    profile.query_ns.reset();
    profile.standard_errors_ns[index_of(Term::Indices)] = -0.5;
    EXPECT_TRUE(
        validate(profile).error().message.starts_with("the standard error of \"c1_ns\" is negative;"));
    profile.standard_errors_ns = {};
    profile.residuals.emplace();
    profile.residuals->p95 = std::numeric_limits<double>::infinity();
    EXPECT_EQ(validate(profile).error().message,
              "the residual percentile \"p95\" is not finite; calibrate again");
}

}  // namespace
}  // namespace rhview
