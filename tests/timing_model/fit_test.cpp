// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/timing_model/fit.h"

#include <gtest/gtest.h>

#include "synthetic.h"

namespace rhview {
namespace {

using test::kCoreMachine;
using test::kCoreTerms;
using test::samples_of;

TEST(Fit, exact_samples_give_the_exact_constants) {
    const auto samples = samples_of(kCoreMachine, Combination::Sum, 40, 0.0, 1);
    const Result<Fit> fit = fit_terms(samples, kCoreTerms);
    ASSERT_TRUE(fit.ok()) << fit.error().message;
    for (const Coefficient& c : fit->coefficients)
        EXPECT_NEAR(c.value_ns, kCoreMachine[index_of(c.term)], 1e-8 * kCoreMachine[index_of(c.term)]);
    EXPECT_NEAR(fit->r_squared, 1.0, 1e-12);
    EXPECT_LT(fit->hold_out_error, 1e-8);
    EXPECT_EQ(fit->samples, 40u);
    EXPECT_EQ(fit->outliers, 0u);
    EXPECT_EQ(fit->timer_step_ns, 0.0);
}

Coefficient coefficient(Term term, double value_ns) {
    Coefficient result;
    result.term = term;
    result.value_ns = value_ns;
    return result;
}

struct Coverage {
    int inside = 0, all = 0;
    [[nodiscard]] double share() const { return static_cast<double>(inside) / all; }
};

Coverage coverage_of(const Constants& machine, std::span<const Term> terms, std::size_t count, double noise) {
    Coverage coverage;
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        const Result<Fit> fit =
            fit_terms(samples_of(machine, Combination::Sum, count, noise, 1000 + seed), terms);
        EXPECT_TRUE(fit.ok()) << fit.error().message;
        if (!fit.ok()) continue;
        for (const Coefficient& c : fit->coefficients) {
            const double truth = machine[index_of(c.term)];
            coverage.inside += c.low_ns <= truth && truth <= c.high_ns;
            ++coverage.all;
        }
    }
    return coverage;
}

struct CoverageCase {
    const char* name;
    std::size_t samples;
    double noise;
};

class FitCoverage : public testing::TestWithParam<CoverageCase> {};

TEST_P(FitCoverage, of_the_95_percent_interval_is_between_92_and_98_percent_over_200_seeds) {
    const Coverage coverage = coverage_of(kCoreMachine, kCoreTerms, GetParam().samples, GetParam().noise);
    RecordProperty("coverage", std::to_string(coverage.share()));
    EXPECT_EQ(coverage.all, 600);
    EXPECT_GE(coverage.share(), 0.92);
    EXPECT_LE(coverage.share(), 0.98);
}

INSTANTIATE_TEST_SUITE_P(Cases, FitCoverage,
                         testing::Values(CoverageCase{"few_samples", 20, 0.05},
                                         CoverageCase{"some_samples", 60, 0.05},
                                         CoverageCase{"many_samples", 300, 0.05},
                                         CoverageCase{"little_noise", 60, 0.005},
                                         CoverageCase{"much_noise", 100, 0.15}),
                         [](const auto& test) { return test.param.name; });

TEST(Fit, intervals_cover_with_five_terms_too) {
    const Constants machine{50e3, 0.3, 400.0, 0.0, 2.0, 0.0, 3000.0};
    constexpr std::array kTerms{Term::Constant, Term::Indices, Term::DrawCalls, Term::Fragments,
                                Term::MaterialChanges};
    const Coverage coverage = coverage_of(machine, kTerms, 120, 0.05);
    RecordProperty("coverage", std::to_string(coverage.share()));
    EXPECT_GE(coverage.share(), 0.92);
    EXPECT_LE(coverage.share(), 0.98);
}

TEST(Fit, constants_are_unbiased_under_proportional_noise) {
    Constants sum{};
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        const Result<Fit> fit =
            fit_terms(samples_of(kCoreMachine, Combination::Sum, 100, 0.1, seed), kCoreTerms);
        ASSERT_TRUE(fit.ok());
        for (const Coefficient& c : fit->coefficients) sum[index_of(c.term)] += c.value_ns / 200.0;
    }
    // Weights of 1 / measured would be 1 % low here.
    for (const Term term : kCoreTerms)
        EXPECT_NEAR(sum[index_of(term)] / kCoreMachine[index_of(term)], 1.0, 0.005) << name_of(term);
}

TEST(Fit, a_constant_that_is_not_there_is_at_the_bound_and_says_so) {
    Constants machine = kCoreMachine;
    machine[index_of(Term::Constant)] = 0.0;
    int at_bound = 0, covered = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        const Result<Fit> fit = fit_terms(samples_of(machine, Combination::Sum, 60, 0.05, seed), kCoreTerms);
        ASSERT_TRUE(fit.ok());
        const Coefficient& c0 = *fit->find(Term::Constant);
        EXPECT_GE(c0.value_ns, 0.0);
        EXPECT_EQ(c0.at_bound, c0.value_ns == 0.0);
        EXPECT_GT(c0.standard_error_ns, 0.0);
        at_bound += c0.at_bound;
        covered += c0.low_ns <= 0.0;
    }
    EXPECT_GT(at_bound, 30);
    EXPECT_LT(at_bound, 70);
    EXPECT_GE(covered, 92);
}

TEST(Fit, hold_out_error_is_the_noise_that_is_in_the_samples) {
    const Result<Fit> fit = fit_terms(samples_of(kCoreMachine, Combination::Sum, 400, 0.05, 3), kCoreTerms);
    ASSERT_TRUE(fit.ok());
    const double expected = 0.05 * 0.7979;  // mean of |normal|
    EXPECT_NEAR(fit->hold_out_error, expected, 3.0 * fit->hold_out_standard_error);
    EXPECT_NEAR(fit->residuals.absolute_p50, 0.05 * 0.6745, 0.005);
    EXPECT_NEAR(fit->residuals.p50, 0.0, 0.01);
    EXPECT_LT(fit->residuals.p5, -0.06);
    EXPECT_GT(fit->residuals.p95, 0.06);
}

TEST(Fit, equal_samples_give_equal_bits) {
    const auto samples = samples_of(kCoreMachine, Combination::Sum, 50, 0.1, 9);
    const Result<Fit> a = fit_terms(samples, kCoreTerms), b = fit_terms(samples, kCoreTerms);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(a->constants(), b->constants());
    EXPECT_EQ(a->hold_out_error, b->hold_out_error);
}

TEST(Fit, prediction_is_that_of_the_formula_by_hand) {
    Fit fit;
    fit.coefficients = {coefficient(Term::Constant, 1000.0), coefficient(Term::Indices, 0.5),
                        coefficient(Term::DrawCalls, 200.0)};
    Work work;
    work.indices = 4000.0;
    work.draw_calls = 30.0;
    work.queries = 7.0;  // the model has no price for it
    EXPECT_EQ(predict_ns(fit, work), 1000.0 + 2000.0 + 6000.0);
    fit.combination = Combination::MaxOfCpuAndGpu;
    EXPECT_EQ(predict_ns(fit, work), 1000.0 + 6000.0);
}

TEST(Fit, scatter_of_its_parts_widens_the_standard_errors_by_their_deviation) {
    Fit fit = fit_terms(test::samples_of(test::kCoreMachine, Combination::Sum, 60, 0.02, 1), test::kCoreTerms)
                  .value();
    const Fit before = fit;
    add_scatter(fit, std::span(&before, 1));
    EXPECT_EQ(fit.coefficients[1].standard_error_ns, before.coefficients[1].standard_error_ns);

    // Three times of measuring: the machine was a tenth slower, as fast, a tenth faster.
    std::vector<Fit> parts(3, before);
    for (std::size_t j = 0; j < 3; ++j) {
        parts[0].coefficients[j].value_ns *= 0.9;
        parts[2].coefficients[j].value_ns *= 1.1;
    }
    add_scatter(fit, parts);
    for (std::size_t j = 0; j < 3; ++j) {
        const Coefficient& c = fit.coefficients[j];
        EXPECT_NEAR(c.standard_error_ns,
                    std::hypot(before.coefficients[j].standard_error_ns, 0.1 * c.value_ns),
                    1e-9 * c.value_ns);
        EXPECT_EQ(c.value_ns, before.coefficients[j].value_ns);
        EXPECT_LT(c.low_ns, before.coefficients[j].low_ns);
        EXPECT_GT(c.high_ns, before.coefficients[j].high_ns);
    }
}

}  // namespace
}  // namespace rhview
