// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// What answers, and their absence, make the scheduler believe.

#include <gtest/gtest.h>

#include <cmath>

#include "one_view.h"

namespace rhview {
namespace {

/// The curve alone: answers hardly move it.
const OcclusionSettings kFixedCurve{.keep_prior_answers = 1e12, .exploration_share = 0};

TEST(History, confidence_follows_the_curve_of_consecutive_hidden_answers) {
    OneView view(kFixedCurve, box_pass_costs(10));
    const std::vector<OcclusionCandidate> candidates = row(1, 1e5);
    view.frame(candidates, always);
    EXPECT_DOUBLE_EQ(view.scheduler.p_hidden(0), 0.5);
    for (int i = 1; i < 12; ++i) {
        view.frame(candidates, always);
        EXPECT_NEAR(view.scheduler.p_hidden(0), 0.99 - 0.7 * std::exp(-i), 1e-9) << i;
    }
    view.frame(candidates, never);
    view.frame(candidates, never);
    EXPECT_LT(view.scheduler.p_hidden(0), 0.05);
    EXPECT_TRUE(view.scheduler.turned_visible(0));
}

TEST(History, confidence_is_learned_where_answers_say_otherwise) {
    OneView still({}, box_pass_costs(10));
    const std::vector<OcclusionCandidate> candidates = row(50, 1e5);
    for (int frame = 0; frame < 100; ++frame) still.frame(candidates, always);
    EXPECT_GT(still.scheduler.p_hidden(0), 0.997);
    OneView busy({}, box_pass_costs(10));
    int frame = 0;
    for (; frame < 300; ++frame) {
        busy.frame(candidates, [&](std::uint32_t item) { return (item + frame) % 4 != 0; });
    }
    busy.frame(candidates, always);
    for (std::uint32_t item = 0; item < 50; ++item) EXPECT_LT(busy.scheduler.p_hidden(item), 0.9);
}

TEST(History, an_item_that_was_out_of_sight_is_forgotten) {
    OneView view(kFixedCurve, box_pass_costs(10));
    const std::vector<OcclusionCandidate> candidates = row(2, 1e5);
    for (int frame = 0; frame < 5; ++frame) view.frame(candidates, always);
    view.frame({candidates[1]}, always);
    view.scheduler.absorb(view.answers);
    view.scheduler.begin_frame(0);
    EXPECT_EQ(view.scheduler.visit(0), Belief::Unknown);
    EXPECT_EQ(view.scheduler.visit(1), Belief::Hidden);
    EXPECT_GT(view.scheduler.p_hidden(1), 0.98);
}

TEST(History, a_forgotten_item_is_believed_to_be_what_the_caller_says) {
    OcclusionScheduler scheduler(kFixedCurve, box_pass_costs(10));
    scheduler.resize(3);
    scheduler.begin_frame(0);
    EXPECT_EQ(scheduler.visit(0, Belief::Hidden), Belief::Hidden);
    EXPECT_EQ(scheduler.visit(1, Belief::Visible), Belief::Visible);
    EXPECT_EQ(scheduler.visit(2), Belief::Unknown);
    EXPECT_NEAR(scheduler.p_hidden(0), 0.99 - 0.7 * std::exp(-1), 1e-9);  // the least confidence
    scheduler.begin_frame(0);
    EXPECT_EQ(scheduler.visit(1, Belief::Hidden), Belief::Visible);  // known: not asked
}

TEST(History, answers_from_before_an_item_was_forgotten_are_not_believed) {
    OneView view(kFixedCurve, box_pass_costs(10));
    const std::vector<OcclusionCandidate> candidates = row(1, 1e5);
    view.frame(candidates, always);
    const std::vector<QueryAnswer> late = view.answers;
    view.answers.clear();
    view.frame({}, always);
    view.frame(candidates, always);
    view.scheduler.absorb(late);
    view.answers.clear();
    view.scheduler.begin_frame(0);
    EXPECT_EQ(view.scheduler.visit(0), Belief::Unknown);
    EXPECT_EQ(view.scheduler.counters().answers, 1u);
}

TEST(History, answers_out_of_order_leave_the_newest_belief) {
    OneView view(kFixedCurve, box_pass_costs(10));
    const std::vector<OcclusionCandidate> candidates = row(1, 1e5);
    std::vector<std::vector<QueryAnswer>> answers;
    for (int frame = 0; frame < 3; ++frame) {
        view.frame(candidates, frame == 2 ? never : always);
        answers.push_back(view.answers);
        view.answers.clear();
    }
    view.scheduler.absorb(answers[2]);
    view.scheduler.absorb(answers[0]);
    view.scheduler.absorb(answers[1]);
    view.scheduler.begin_frame(0);
    EXPECT_EQ(view.scheduler.visit(0), Belief::Visible);
}

TEST(History, unknown_and_double_tickets_are_counted_and_ignored) {
    OneView view(kFixedCurve, box_pass_costs(10));
    view.frame(row(1, 1e5), always);
    const std::uint64_t ticket = view.answers[0].ticket;
    const QueryAnswer answers[] = {{ticket, false, 0},           {ticket, true, 0},     {0, true, 0},
                                   {~std::uint64_t{0}, true, 0}, {ticket + 1, true, 0}, {12345, true, 0}};
    view.scheduler.absorb(answers);
    EXPECT_EQ(view.scheduler.counters().answers, 1u);
    EXPECT_EQ(view.scheduler.counters().hidden, 1u);
    EXPECT_EQ(view.scheduler.counters().unknown_tickets, 5u);
    view.scheduler.begin_frame(0);
    EXPECT_EQ(view.scheduler.visit(0), Belief::Hidden);
}

TEST(History, a_query_that_never_returns_counts_as_visible) {
    OneView view({.exploration_share = 0, .lost_after_frames = 4}, box_pass_costs(10));
    const std::vector<OcclusionCandidate> candidates = row(3, 1e5);
    for (int frame = 0; frame < 4; ++frame) {
        view.frame(candidates, always);
        view.answers.clear();
        EXPECT_EQ(view.scheduler.counters().lost, 0u);
        EXPECT_EQ(view.action(0), OcclusionAction::QueryFirst);
    }
    view.frame(candidates, always);
    EXPECT_EQ(view.scheduler.counters().lost, 3u);
    EXPECT_EQ(view.action(0), OcclusionAction::Draw);
    EXPECT_LT(view.scheduler.p_hidden(0), 0.1);
}

TEST(History, members_of_a_failed_multiquery_are_asked_alone_next) {
    OneView view({.exploration_share = 0}, hardware_costs(1000));
    const std::vector<OcclusionCandidate> candidates = row(40, 3000);
    for (int frame = 0; frame < 60; ++frame) view.frame(candidates, always);
    ASSERT_GT(view.members(7), 4u);
    std::vector<bool> failed(40);
    view.frame(candidates, [](std::uint32_t item) { return item != 7; });
    for (std::size_t i = 0; i < 40; ++i) {
        failed[i] = view.decided.decisions[i].query == view.decided.decisions[7].query;
    }
    view.frame(candidates, [](std::uint32_t item) { return item != 7; });
    for (std::size_t i = 0; i < 40; ++i) {
        ASSERT_EQ(view.action(i), OcclusionAction::QueryFirst);
        EXPECT_EQ(view.members(i) == 1, failed[i]) << i;
    }
    view.frame(candidates, [](std::uint32_t item) { return item != 7; });
    EXPECT_EQ(view.action(7), OcclusionAction::Draw);
    for (std::size_t i = 0; i < 40; ++i) {
        EXPECT_EQ(view.action(i), i == 7 ? OcclusionAction::Draw : OcclusionAction::QueryFirst) << i;
    }
}

/// A frame as a planner does it: item 0 stands for its parts 1 to 4, which are always hidden.
class OneOfParts {
  public:
    explicit OneOfParts(const OcclusionSettings& settings) : view(settings, box_pass_costs(10)) {}

    /// Whether it was asked about as one on trial, in a frame in which it answers `seen`.
    bool frame(bool seen) {
        view.scheduler.absorb(view.answers);
        view.scheduler.begin_frame(0);
        candidates.clear();
        belief = view.scheduler.visit(0);
        bool tried = false;
        if (belief == Belief::Hidden) {
            candidates = row(1, 4e5);
        } else {
            candidates = row(5, 1e5);
            candidates.erase(candidates.begin());
            bool hidden = true;
            for (const OcclusionCandidate& part : candidates)
                hidden = view.scheduler.visit(part.item) == Belief::Hidden && hidden;
            tried = hidden && view.scheduler.may_try(0, view.scheduler.p_hidden(1));
            if (tried) {
                candidates.push_back(row(1, 4e5).front());
                candidates.back().trial = true;
            }
        }
        view.scheduler.decide(candidates, view.decided);
        view.answers.clear();
        for (const ScheduledQuery& query : view.decided.queries) {
            const std::uint32_t item = candidates[view.decided.members[query.first_member]].item;
            view.answers.push_back({query.ticket, item == 0 && seen, 0});
        }
        return tried;
    }

    OneView view;
    std::vector<OcclusionCandidate> candidates;
    Belief belief = Belief::Unknown;
};

TEST(Trial, what_hangs_on_its_parts_stays_there_until_it_is_known_to_be_hidden) {
    OneOfParts node(kFixedCurve);
    while (!node.frame(false)) ASSERT_LT(node.candidates.size(), 5u);
    ASSERT_EQ(node.candidates.size(), 5u);
    for (std::size_t part = 0; part < 4; ++part)
        EXPECT_EQ(node.view.action(part), OcclusionAction::QueryFirst) << part;
    EXPECT_EQ(node.view.action(4), OcclusionAction::DrawAndQuery);
    const double p_of_parts = node.view.scheduler.p_hidden(1);
    EXPECT_FALSE(node.frame(false));
    EXPECT_EQ(node.belief, Belief::Hidden);
    EXPECT_EQ(node.view.action(0), OcclusionAction::QueryFirst);
    EXPECT_NEAR(node.view.scheduler.p_hidden(0), p_of_parts, 1e-6);
}

TEST(Trial, is_refused_for_longer_each_time_that_it_was_seen) {
    OcclusionSettings settings = kFixedCurve;
    settings.merge_interval = 8;
    settings.max_merge_interval = 40;
    OneOfParts node(settings);
    std::vector<int> refused;
    int since = 0;
    for (int frame = 0; frame < 200; ++frame) {
        const bool tried = node.frame(true);
        EXPECT_NE(node.belief, Belief::Hidden);
        if (tried) refused.push_back(since);
        since = tried ? 0 : since + 1;
    }
    ASSERT_GE(refused.size(), 5u);
    for (std::size_t i = 1; i < refused.size(); ++i)
        EXPECT_NEAR(refused[i], std::min(8 << (i - 1), 40), 1) << i;
}

TEST(Trial, is_not_repeated_while_its_answer_is_on_the_way) {
    OneOfParts node(kFixedCurve);
    while (!node.frame(false)) ASSERT_LT(node.candidates.size(), 5u);
    node.view.answers.clear();
    for (int frame = 0; frame < 10; ++frame) EXPECT_FALSE(node.frame(false));
}

TEST(Trial, that_is_lost_counts_as_seen) {
    OcclusionSettings settings = kFixedCurve;
    settings.lost_after_frames = 4;
    OneOfParts node(settings);
    while (!node.frame(false)) ASSERT_LT(node.candidates.size(), 5u);
    node.view.answers.clear();
    int frames = 0;
    while (!node.frame(false)) ASSERT_LT(++frames, 100);
    EXPECT_NE(node.belief, Belief::Hidden);
    EXPECT_GE(frames, 2 + static_cast<int>(settings.merge_interval));
}

TEST(Trial, says_nothing_of_items_of_its_kind) {
    OneOfParts node({});
    while (!node.frame(true)) ASSERT_LT(node.candidates.size(), 5u);
    const double p_of_parts = node.view.scheduler.p_hidden(1);
    EXPECT_FALSE(node.frame(true));
    EXPECT_GE(node.view.scheduler.p_hidden(1), p_of_parts);
}

TEST(Trial, is_asked_only_where_it_saves_its_price_before_an_answer_is_old) {
    OcclusionSettings settings = kFixedCurve;
    settings.visible_interval = 8;
    for (const auto& [saves_ns, asked] : {std::pair{1100.0f, false}, {1400.0f, true}}) {
        OneView view(settings, box_pass_costs(10000));
        std::vector<OcclusionCandidate> trial = row(1, saves_ns);
        trial[0].trial = true;
        view.scheduler.begin_frame(0);
        view.scheduler.visit(0);
        ASSERT_TRUE(view.scheduler.may_try(0, 0.95));
        view.scheduler.decide(trial, view.decided);
        EXPECT_EQ(view.decided.queries.size(), asked ? 1u : 0u) << saves_ns;
        // What was not asked may be tried again at once.
        view.scheduler.begin_frame(0);
        view.scheduler.visit(0);
        EXPECT_EQ(view.scheduler.may_try(0, 0.95), !asked) << saves_ns;
    }
}

TEST(Trial, is_told_nothing_by_what_was_asked_before) {
    OneView view(kFixedCurve, box_pass_costs(10));
    const std::vector<OcclusionCandidate> candidates = row(1, 1e5);
    view.frame(candidates, always);
    const std::vector<QueryAnswer> on_the_way = view.answers;
    view.scheduler.begin_frame(0);
    view.scheduler.visit(0);
    ASSERT_TRUE(view.scheduler.may_try(0, 0.95));
    std::vector<OcclusionCandidate> trial = candidates;
    trial[0].trial = true;
    view.scheduler.decide(trial, view.decided);
    view.scheduler.absorb(on_the_way);
    view.scheduler.begin_frame(0);
    EXPECT_EQ(view.scheduler.visit(0), Belief::Unknown);
}

TEST(Views, two_of_them_over_the_same_items_know_nothing_of_each_other) {
    OneView one({}, box_pass_costs(10)), other({}, box_pass_costs(10));
    const std::vector<OcclusionCandidate> candidates = row(5, 1e5);
    for (int frame = 0; frame < 5; ++frame) {
        one.frame(candidates, always);
        other.frame(candidates, never);
    }
    EXPECT_EQ(one.count(OcclusionAction::QueryFirst), 5u);
    EXPECT_EQ(other.count(OcclusionAction::QueryFirst), 0u);
}

TEST(Items, those_beyond_a_smaller_count_are_forgotten) {
    OneView view(kFixedCurve, box_pass_costs(10), 10);
    const std::vector<OcclusionCandidate> candidates = row(10, 1e5);
    view.frame(candidates, always);
    view.scheduler.resize(5);
    view.scheduler.resize(10);
    view.scheduler.absorb(view.answers);
    view.scheduler.begin_frame(0);
    EXPECT_EQ(view.scheduler.visit(4), Belief::Hidden);
    EXPECT_EQ(view.scheduler.visit(5), Belief::Unknown);
}

}  // namespace
}  // namespace rhview
