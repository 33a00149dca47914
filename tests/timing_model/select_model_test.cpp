// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>

#include "rhview/timing_model/fit.h"
#include "synthetic.h"

namespace rhview {
namespace {

using test::kCoreMachine;
using test::samples_of;

constexpr double kNoise = 0.05;

Selection select(const Constants& machine, Combination combination, std::uint32_t seed,
                 std::size_t count = 120) {
    Result<Selection> selection = select_model(samples_of(machine, combination, count, kNoise, seed));
    EXPECT_TRUE(selection.ok()) << selection.error().message;
    return selection.ok() ? *selection : Selection{};
}

TEST(SelectModel, a_machine_of_the_core_alone_keeps_nothing_more) {
    int wrongly_kept = 0, wrong_maximum = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        const Selection selection = select(kCoreMachine, Combination::Sum, seed);
        wrongly_kept += selection.fit.coefficients.size() > 3;
        wrong_maximum += selection.fit.combination != Combination::Sum;
    }
    RecordProperty("false_keep_rate", std::to_string(wrongly_kept / 100.0));
    EXPECT_LE(wrongly_kept, 2);
    EXPECT_EQ(wrong_maximum, 0);
}

struct KeepCase {
    Term term;
    double value_ns;
};

class SelectModelKeeps : public testing::TestWithParam<KeepCase> {};

TEST_P(SelectModelKeeps, the_term_that_matters_and_no_other) {
    Constants machine = kCoreMachine;
    machine[index_of(GetParam().term)] = GetParam().value_ns;
    int found = 0, exact = 0;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const Fit fit = select(machine, Combination::Sum, seed).fit;
        found += fit.find(GetParam().term) != nullptr;
        exact += fit.find(GetParam().term) != nullptr && fit.coefficients.size() == 4 &&
                 fit.combination == Combination::Sum;
    }
    EXPECT_EQ(found, 20);
    EXPECT_GE(exact, 19);
}

INSTANTIATE_TEST_SUITE_P(Terms, SelectModelKeeps,
                         testing::Values(KeepCase{Term::Fragments, 3.0}, KeepCase{Term::Queries, 10000.0},
                                         KeepCase{Term::MaterialChanges, 4000.0},
                                         KeepCase{Term::SubDraws, 200.0}, KeepCase{Term::Primitives, 30.0},
                                         KeepCase{Term::PassedSamples, 5.0}),
                         [](const auto& test) { return std::string(name_of(test.param.term)); });

TEST(SelectModel, recognises_a_machine_that_overlaps_both_sides) {
    int found = 0;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const Fit fit = select(kCoreMachine, Combination::MaxOfCpuAndGpu, seed, 200).fit;
        found += fit.combination == Combination::MaxOfCpuAndGpu && fit.coefficients.size() == 3;
    }
    EXPECT_GE(found, 19);
}

TEST(SelectModel, lists_every_candidate_with_its_error_and_the_reason) {
    Constants machine = kCoreMachine;
    machine[index_of(Term::Fragments)] = 3.0;
    const Selection selection = select(machine, Combination::Sum, 1);
    // The core, then six terms and the maximum, then five terms and the maximum.
    ASSERT_EQ(selection.candidates.size(), 14u);
    EXPECT_TRUE(selection.candidates[0].kept);
    EXPECT_EQ(selection.candidates[0].note, "the core");
    const auto kept = std::count_if(selection.candidates.begin(), selection.candidates.end(),
                                    [](const Candidate& c) { return c.kept; });
    EXPECT_EQ(kept, 2);
    for (const Candidate& candidate : selection.candidates) {
        EXPECT_FALSE(candidate.note.empty());
        EXPECT_TRUE(candidate.hold_out_error.has_value() ||
                    candidate.note.starts_with("could not be fitted: "))
            << candidate.note;
        if (candidate.kept && candidate.terms.size() == 4) {
            EXPECT_EQ(candidate.terms.back(), Term::Fragments);
            EXPECT_EQ(*candidate.hold_out_error, selection.fit.hold_out_error);
            EXPECT_TRUE(candidate.note.starts_with("kept: lowers the hold-out error by")) << candidate.note;
        }
    }
}

TEST(SelectModel, the_plain_form_is_reported_beside) {
    const Selection selection = select(kCoreMachine, Combination::Sum, 2);
    ASSERT_EQ(selection.plain.coefficients.size(), 2u);
    EXPECT_EQ(selection.plain.find(Term::Constant), nullptr);
    EXPECT_GT(selection.plain.hold_out_error, selection.fit.hold_out_error);
}

TEST(SelectModel, a_candidate_that_was_never_varied_is_listed_and_not_an_error) {
    auto samples = samples_of(kCoreMachine, Combination::Sum, 80, kNoise, 3);
    for (Sample& sample : samples) {
        sample.work.queries = 0.0;
        sample.work.sub_draws = sample.work.draw_calls;
    }
    const Result<Selection> selection = select_model(samples);
    ASSERT_TRUE(selection.ok()) << selection.error().message;
    int impossible = 0;
    for (const Candidate& c : selection->candidates) {
        if (c.hold_out_error) continue;
        const bool queries = c.terms.back() == Term::Queries;
        EXPECT_NE(
            c.note.find(queries ? "the same queries (0)" : "draw_calls and sub_draws rise and fall together"),
            std::string::npos)
            << c.note;
        ++impossible;
    }
    EXPECT_EQ(impossible, 2);
}

TEST(SelectModel, what_spoils_the_core_is_an_error) {
    auto samples = samples_of(kCoreMachine, Combination::Sum, 80, kNoise, 3);
    samples[4].measured_ns = 0.0;
    const Result<Selection> selection = select_model(samples);
    ASSERT_FALSE(selection.ok());
    EXPECT_TRUE(selection.error().message.starts_with("sample 4: the measured time is 0 ns"));
}

}  // namespace
}  // namespace rhview
