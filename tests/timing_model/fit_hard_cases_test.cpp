// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "rhview/timing_model/fit.h"
#include "synthetic.h"

namespace rhview {
namespace {

using test::kCoreMachine;
using test::kCoreTerms;
using test::Random;
using test::samples_of;

using Samples = std::vector<Sample>;

struct RefusalCase {
    const char* name;
    std::function<void(Samples&)> spoil;
    const char* sentence;
};

class FitRefusal : public testing::TestWithParam<RefusalCase> {};

TEST_P(FitRefusal, is_one_sentence_that_names_the_fault) {
    Samples samples = samples_of(kCoreMachine, Combination::Sum, 40, 0.02, 5);
    GetParam().spoil(samples);
    const Result<Fit> fit = fit_terms(samples, kCoreTerms);
    ASSERT_FALSE(fit.ok());
    EXPECT_NE(fit.error().message.find(GetParam().sentence), std::string::npos) << fit.error().message;
    EXPECT_EQ(fit.error().message.find('\n'), std::string::npos);
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Change>
std::function<void(Samples&)> every(Change change) {
    return [change](Samples& samples) {
        for (Sample& sample : samples) {
            change(sample.work);
            sample.measured_ns = predict_ns(kCoreMachine, Combination::Sum, sample.work);
        }
    };
}

/// Times of 5 to 30 µs, all but the smallest work, counted in steps.
void quantise(Samples& samples, double step_ns) {
    for (Sample& sample : samples) {
        sample.measured_ns = std::fmax(1.0, std::round(sample.measured_ns / step_ns)) * step_ns;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, FitRefusal,
    testing::Values(
        RefusalCase{"no_samples", [](Samples& s) { s.clear(); }, "0 samples are too few to fit 3 terms"},
        RefusalCase{"nine_samples", [](Samples& s) { s.resize(9); },
                    "9 samples are too few to fit 3 terms; measure at least 10"},
        RefusalCase{"zero_time", [](Samples& s) { s[7].measured_ns = 0.0; },
                    "sample 7: the measured time is 0 ns"},
        RefusalCase{"negative_time", [](Samples& s) { s[8].measured_ns = -3.0; },
                    "sample 8: the measured time is -3 ns"},
        RefusalCase{"nan_time", [](Samples& s) { s[0].measured_ns = kNan; },
                    "sample 0: the measured time is nan"},
        RefusalCase{"infinite_time", [](Samples& s) { s[0].measured_ns = kInfinity; },
                    "sample 0: the measured time is inf"},
        RefusalCase{"negative_work", [](Samples& s) { s[3].work.draw_calls = -2.0; },
                    "sample 3: draw_calls is -2"},
        RefusalCase{"nan_work", [](Samples& s) { s[3].work.indices = kNan; }, "sample 3: indices is nan"},
        RefusalCase{"infinite_work_of_another_term", [](Samples& s) { s[3].work.queries = kInfinity; },
                    "sample 3: queries is inf"},
        RefusalCase{"equal_indices", every([](Work& w) { w.indices = 3000.0; }),
                    "all samples have the same indices (3000)"},
        RefusalCase{"no_draw_calls", every([](Work& w) { w.draw_calls = 0.0; }),
                    "all samples have the same draw_calls (0)"},
        RefusalCase{"proportional_columns", every([](Work& w) { w.draw_calls = w.indices / 1024.0; }),
                    "the terms indices and draw_calls rise and fall together"},
        RefusalCase{"almost_proportional_columns", every([](Work& w) {
                        w.draw_calls = w.indices / 1024.0 * (1.0 + 1e-5 * std::sin(w.queries));
                    }),
                    "the terms indices and draw_calls rise and fall together"},
        RefusalCase{"almost_equal_draw_calls",
                    every([](Work& w) { w.draw_calls = 1000.0 + std::fmod(w.indices, 2.0); }),
                    "the terms constant and draw_calls rise and fall together"},
        RefusalCase{"millisecond_timer", [](Samples& s) { quantise(s, 1e7); },
                    "the timer counts in steps of 1e+07 ns"}),
    [](const auto& test) { return test.param.name; });

TEST(FitRefusal, terms_that_are_none_or_named_twice_are_told) {
    const Samples samples = samples_of(kCoreMachine, Combination::Sum, 40, 0.02, 5);
    EXPECT_EQ(fit_terms(samples, {}).error().message, "the model has no term; name at least one");
    constexpr std::array kTwice{Term::Indices, Term::DrawCalls, Term::Indices};
    EXPECT_EQ(fit_terms(samples, kTwice).error().message,
              "the model names the term indices twice; name it once");
    FitOptions options;
    options.folds = 1;
    EXPECT_EQ(fit_terms(samples, kCoreTerms, options).error().message,
              "the cross-validation needs at least 2 folds");
}

TEST(FitHardCases, ten_samples_are_enough_for_three_terms) {
    EXPECT_TRUE(fit_terms(samples_of(kCoreMachine, Combination::Sum, 10, 0.02, 6), kCoreTerms).ok());
}

/// Worst deviation of a constant from the truth, in its standard errors, over 50 seeds.
struct Spoiled {
    double worst_relative_error = 0.0;
    std::size_t fewest_outliers = 1000;
};

Spoiled fit_with_outliers(double share, const std::function<double(Random&)>& factor) {
    Spoiled result;
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        Samples samples = samples_of(kCoreMachine, Combination::Sum, 100, 0.03, 77 + seed);
        Random random(seed);
        const auto spoiled = static_cast<std::size_t>(share * 100.0);
        for (std::size_t i = 0; i < spoiled; ++i) samples[(i * 37) % 100].measured_ns *= factor(random);
        const Result<Fit> fit = fit_terms(samples, kCoreTerms);
        EXPECT_TRUE(fit.ok()) << fit.error().message;
        if (!fit.ok()) continue;
        for (const Coefficient& c : fit->coefficients) {
            const double truth = kCoreMachine[index_of(c.term)];
            result.worst_relative_error =
                std::fmax(result.worst_relative_error, std::abs(c.value_ns - truth) / truth);
        }
        result.fewest_outliers = std::min(result.fewest_outliers, fit->outliers);
    }
    return result;
}

TEST(FitHardCases, a_fifth_of_the_samples_a_hundred_times_too_slow_does_not_move_the_constants) {
    const Spoiled spoiled = fit_with_outliers(0.2, [](Random&) { return 100.0; });
    EXPECT_LT(spoiled.worst_relative_error, 0.1);
    EXPECT_GE(spoiled.fewest_outliers, 20u);
}

TEST(FitHardCases, a_fifth_of_the_samples_a_hundred_times_too_fast_does_not_move_the_constants) {
    const Spoiled spoiled = fit_with_outliers(0.2, [](Random&) { return 0.01; });
    EXPECT_LT(spoiled.worst_relative_error, 0.1);
    EXPECT_GE(spoiled.fewest_outliers, 20u);
}

TEST(FitHardCases, hiccups_of_any_size_in_a_fifth_of_the_samples_are_survived) {
    const Spoiled spoiled = fit_with_outliers(0.2, [](Random& random) { return random.spread(1.2, 100.0); });
    EXPECT_LT(spoiled.worst_relative_error, 0.12);
}

TEST(FitHardCases, a_step_that_is_small_against_the_times_widens_the_errors_and_they_still_cover) {
    int inside = 0, all = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        Samples samples = samples_of(kCoreMachine, Combination::Sum, 60, 0.01, seed);
        std::erase_if(samples, [](const Sample& s) { return s.measured_ns < 1e6; });
        const Result<Fit> fine = fit_terms(samples, kCoreTerms);
        quantise(samples, 2e5);
        const Result<Fit> coarse = fit_terms(samples, kCoreTerms);
        ASSERT_TRUE(fine.ok() && coarse.ok()) << coarse.error().message;
        EXPECT_EQ(fine->timer_step_ns, 0.0);
        EXPECT_NEAR(coarse->timer_step_ns, 2e5, 1.0);
        EXPECT_GT(coarse->find(Term::Constant)->standard_error_ns,
                  2.0 * fine->find(Term::Constant)->standard_error_ns);
        for (const Coefficient& c : coarse->coefficients) {
            inside +=
                c.low_ns <= kCoreMachine[index_of(c.term)] && kCoreMachine[index_of(c.term)] <= c.high_ns;
            ++all;
        }
    }
    EXPECT_GE(static_cast<double>(inside) / all, 0.92);
}

TEST(FitHardCases, a_nanosecond_clock_has_no_step_that_matters) {
    Samples samples = samples_of(kCoreMachine, Combination::Sum, 60, 0.02, 4);
    for (Sample& sample : samples) sample.measured_ns = std::round(sample.measured_ns);
    const Result<Fit> fit = fit_terms(samples, kCoreTerms);
    ASSERT_TRUE(fit.ok());
    EXPECT_EQ(fit->timer_step_ns, 0.0);
}

}  // namespace
}  // namespace rhview
