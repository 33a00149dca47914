// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// Which query is asked: gate, ways, cold start, intervals, policies.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "one_view.h"

namespace rhview {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Gate, asks_first_only_where_what_is_saved_exceeds_the_price) {
    OneView view({}, box_pass_costs(1000));
    std::vector<OcclusionCandidate> candidates = row(2, 1900);  // p(hidden) of the unknown is a half
    candidates[1].render_ns = 2100;
    view.frame(candidates, always);
    EXPECT_EQ(view.action(0), OcclusionAction::Draw);
    EXPECT_EQ(view.action(1), OcclusionAction::QueryFirst);
}

TEST(Gate, boxes_pixels_and_draws_are_part_of_the_price) {
    const AnswerCosts never{0, kUnaffordable, 0, 0, 0};
    OneView view({}, {never, {0, 100, 10, 1, 50}});
    std::vector<OcclusionCandidate> candidates = row(5, 1000, 100);  // worth 500, costs 100 + 10 + 100 + 50
    candidates[1].boxes = 26;
    candidates[2].pixels = 350;
    candidates[3].draws = 9;
    view.frame(candidates, always);
    EXPECT_EQ(view.action(0), OcclusionAction::QueryFirst);
    for (const std::size_t dear : {1, 2, 3})
        EXPECT_NE(view.action(dear), OcclusionAction::QueryFirst) << dear;
    EXPECT_DOUBLE_EQ(view.decided.query_ns, 2 * 260.0);
    EXPECT_DOUBLE_EQ(view.decided.saved_ns, 2 * (500.0 - 260.0));
}

TEST(Gate, what_cannot_be_tested_is_drawn) {
    OneView view({}, box_pass_costs(1));
    std::vector<OcclusionCandidate> candidates = row(2, 1e6);
    candidates[1].testable = false;
    for (int frame = 0; frame < 50; ++frame) {
        view.frame(candidates, always, 1e9);
        EXPECT_EQ(view.action(0), OcclusionAction::QueryFirst);
        EXPECT_EQ(view.action(1), OcclusionAction::Draw);
        EXPECT_EQ(view.members(1), 0u);
    }
}

TEST(Ways, the_cheaper_one_is_taken_for_each_item_when_both_pay_for_themselves) {
    // By pixels: the box pass is cheap for small boxes, hardware for big ones.
    OneView view({}, {{0, 500, 0, 0, 0}, {0, 10, 0, 1, 0}});
    std::vector<OcclusionCandidate> candidates = row(2, 1e5, 10);
    candidates[1].pixels = 5000;
    view.frame(candidates, always);
    ASSERT_EQ(view.decided.queries.size(), 2u);
    EXPECT_EQ(view.decided.queries[view.decided.decisions[0].query].way, QueryWay::BoxPass);
    EXPECT_EQ(view.decided.queries[view.decided.decisions[1].query].way, QueryWay::HardwareQuery);
}

TEST(Ways, a_way_is_opened_only_if_it_pays_for_its_frame) {
    // 10 items gain 100 ns each by the box pass against hardware; it costs 900 or 1,100 once.
    for (const double frame_ns : {900.0, 1100.0}) {
        OneView view({}, {{0, 200, 0, 0, 0}, {frame_ns, 100, 0, 0, 0}});
        view.frame(row(10, 1e5), always);
        const QueryWay wanted = frame_ns < 1000 ? QueryWay::BoxPass : QueryWay::HardwareQuery;
        for (const ScheduledQuery& query : view.decided.queries) EXPECT_EQ(query.way, wanted);
        EXPECT_DOUBLE_EQ(view.decided.query_ns, frame_ns < 1000 ? 1900.0 : 2000.0);
    }
}

TEST(Ways, none_is_opened_for_less_than_it_costs) {
    OneView view({}, box_pass_costs(100, 4000));
    view.frame(row(9, 1000), always);  // gains 9 × (500 − 100)
    EXPECT_TRUE(view.decided.queries.empty());
    view.frame(row(11, 1000), always);
    EXPECT_EQ(view.count(OcclusionAction::QueryFirst), 11u);
}

TEST(Ways, who_counts_samples_gets_a_hardware_query_of_his_own) {
    OneView view({}, {{0, 500, 0, 0, 0}, {0, 1, 0, 0, 0}});
    std::vector<OcclusionCandidate> candidates = row(20, 1e6);
    for (std::size_t i = 0; i < 3; ++i) candidates[i].counts_samples = true;
    for (int frame = 0; frame < 20; ++frame) {
        view.frame(candidates, always);
        for (std::size_t i = 0; i < 20; ++i) {
            const ScheduledQuery& query = view.decided.queries[view.decided.decisions[i].query];
            EXPECT_EQ(query.counts_samples, i < 3);
            EXPECT_EQ(query.way, i < 3 ? QueryWay::HardwareQuery : QueryWay::BoxPass);
            EXPECT_EQ(query.member_count, 1u);
        }
    }
}

TEST(ColdStart, the_nearest_are_drawn_until_they_cover_the_screen_twice) {
    OneView view({}, box_pass_costs(100));
    view.frame(row(10, 1e5, 500), always, 0.0, 1000.0);
    for (std::size_t i = 0; i < 10; ++i) {
        // Drawn, but asked about for the next frame.
        EXPECT_EQ(view.action(i), i < 4 ? OcclusionAction::DrawAndQuery : OcclusionAction::QueryFirst) << i;
    }
}

TEST(ColdStart, what_costs_more_than_it_hides_is_asked_first) {
    // All together take 10 * 1e5 + 1e6 + 1e4 ns, half of it hidden: 1,005,000 / 2,000 = 502 ns a pixel.
    OneView view({}, box_pass_costs(100));
    std::vector<OcclusionCandidate> candidates = row(12, 1e5, 300);
    candidates[0].render_ns = 1e6;
    candidates[0].pixels = 100;  // the nearest: 10,000 ns a pixel
    candidates[1].render_ns = 1e4;
    candidates[1].pixels = 30;  // as small, and cheap: 333
    view.frame(candidates, always, 0.0, 1000.0);
    EXPECT_EQ(view.action(0), OcclusionAction::QueryFirst);
    EXPECT_EQ(view.action(1), OcclusionAction::DrawAndQuery);
    for (std::size_t i = 2; i < 12; ++i)  // 30 + 7 * 300 pixels cover the screen twice
        EXPECT_EQ(view.action(i), i < 9 ? OcclusionAction::DrawAndQuery : OcclusionAction::QueryFirst) << i;
}

TEST(ColdStart, what_is_seen_while_occluders_are_unknown_is_asked_again) {
    OneView view({}, box_pass_costs(100));
    const std::vector<OcclusionCandidate> candidates = row(10, 1e5, 500);
    view.frame(candidates, never, 0.0, 1000.0);
    view.frame(
        candidates, [](std::uint32_t item) { return item >= 4; }, 0.0, 1000.0);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(view.action(i), i < 4 ? OcclusionAction::Draw : OcclusionAction::QueryFirst) << i;
    }
}

TEST(ColdStart, without_a_screen_everything_worth_it_is_asked_first) {
    OneView view({}, box_pass_costs(100));
    view.frame(row(10, 1e5, 500), always);
    EXPECT_EQ(view.count(OcclusionAction::QueryFirst), 10u);
}

TEST(Visible, items_are_not_asked_again_before_the_interval_and_then_spread) {
    OneView view({.visible_interval = 16, .exploration_share = 0}, box_pass_costs(10));
    const std::vector<OcclusionCandidate> candidates = row(64, 1e5);
    std::vector<int> first_test(64, 0);
    view.frame(candidates, never);
    for (int frame = 1; frame <= 16; ++frame) {
        view.frame(candidates, never);
        for (std::size_t i = 0; i < 64; ++i) {
            if (view.action(i) == OcclusionAction::DrawAndQuery && first_test[i] == 0) first_test[i] = frame;
        }
    }
    std::vector<int> tests(17, 0);
    for (const int frame : first_test) ++tests[frame];
    EXPECT_EQ(tests[0], 0);  // each was tested within the interval
    for (const int count : tests) EXPECT_LE(count, 16);
    // Afterwards each waits for at least the interval.
    std::vector<int> last(first_test);
    for (int frame = 17; frame <= 200; ++frame) {
        view.frame(candidates, never);
        for (std::size_t i = 0; i < 64; ++i) {
            if (view.action(i) != OcclusionAction::DrawAndQuery) continue;
            EXPECT_GE(frame - last[i], 16);
            last[i] = frame;
        }
    }
}

TEST(Visible, an_item_that_turned_hidden_is_found_out_and_then_asked_first) {
    OneView view({.exploration_share = 0}, box_pass_costs(1000));
    const std::vector<OcclusionCandidate> candidates = row(50, 1e5);
    for (int frame = 0; frame < 40; ++frame) view.frame(candidates, never);
    EXPECT_EQ(view.count(OcclusionAction::QueryFirst), 0u);
    for (int frame = 0; frame < 40; ++frame) view.frame(candidates, always);
    EXPECT_EQ(view.count(OcclusionAction::QueryFirst), 50u);
}

TEST(Paper, asks_about_all_items_once_drawing_exceeds_the_budget) {
    const OcclusionSettings settings{.policy = OcclusionPolicy::Paper, .paper_budget_ns = 16e6};
    OneView view(settings, {{0, 1e5, 0, 0, 0}, {0, 1, 0, 0, 0}});
    std::vector<OcclusionCandidate> candidates = row(16, 1e6);
    candidates[3].testable = false;
    view.frame(candidates, always);
    EXPECT_EQ(view.count(OcclusionAction::Draw), 16u);
    candidates[0].render_ns = 1.1e6f;
    for (int frame = 0; frame < 3; ++frame) {
        view.frame(candidates, never);
        EXPECT_EQ(view.count(OcclusionAction::QueryFirst), 15u);
        EXPECT_EQ(view.action(3), OcclusionAction::Draw);
        for (const ScheduledQuery& query : view.decided.queries) {
            EXPECT_EQ(query.way, QueryWay::HardwareQuery);
            EXPECT_EQ(query.member_count, 1u);
        }
        EXPECT_DOUBLE_EQ(view.decided.query_ns, 15e5);
    }
}

TEST(HardNumbers, an_item_of_unknown_price_or_gain_is_drawn) {
    const auto never_asked = [](const OcclusionCandidate& candidate, const QueryCosts& costs) {
        OneView view({}, costs);
        for (int frame = 0; frame < 200; ++frame) {
            view.frame({candidate}, always, 1e7, 1e6);
            if (view.action(0) != OcclusionAction::Draw) return false;
            if (!(view.decided.query_ns == 0.0 && view.decided.saved_ns == 0.0)) return false;
        }
        return true;
    };
    OcclusionCandidate candidate = row(1, 1e6)[0];
    const QueryCosts costs{{0, 100, 1, 1, 1}, {0, 100, 1, 1, 1}};
    ASSERT_FALSE(never_asked(candidate, costs));
    for (const double render_ns : {kNan, -1.0, -kInfinity, 0.0}) {
        OcclusionCandidate odd = candidate;
        odd.render_ns = static_cast<float>(render_ns);
        EXPECT_TRUE(never_asked(odd, costs)) << render_ns;
    }
    for (const double pixels : {kNan, kInfinity}) {
        OcclusionCandidate odd = candidate;
        odd.pixels = static_cast<float>(pixels);
        EXPECT_TRUE(never_asked(odd, costs)) << pixels;
    }
    for (const double cost : {kNan, -1.0, kInfinity}) {
        for (double AnswerCosts::*const field :
             {&AnswerCosts::frame_ns, &AnswerCosts::query_ns, &AnswerCosts::box_ns, &AnswerCosts::pixel_ns,
              &AnswerCosts::draw_ns}) {
            QueryCosts odd = costs;
            odd.hardware.*field = odd.box_pass.*field = cost;
            OneView view({.exploration_share = 0}, odd);
            view.frame({candidate}, always);
            EXPECT_EQ(view.action(0), OcclusionAction::Draw) << cost;
        }
    }
}

TEST(HardNumbers, an_item_of_infinite_cost_is_asked_about) {
    OcclusionCandidate candidate = row(1, std::numeric_limits<float>::infinity())[0];
    OneView view({}, hardware_costs(100));
    for (int frame = 0; frame < 20; ++frame) {
        view.frame({candidate}, always);
        EXPECT_EQ(view.action(0), OcclusionAction::QueryFirst);
        EXPECT_TRUE(std::isfinite(view.decided.saved_ns));
    }
}

TEST(HardNumbers, queries_that_cost_nothing_are_asked_about_everything_doubtful) {
    OneView view({}, {});
    const std::vector<OcclusionCandidate> candidates = row(20, 1000);
    for (int frame = 0; frame < 50; ++frame) {
        view.frame(candidates, always);
        EXPECT_EQ(view.count(OcclusionAction::QueryFirst), 20u);
        EXPECT_EQ(view.decided.query_ns, 0.0);
    }
}

TEST(HardNumbers, odd_frame_times_and_screens_are_survived) {
    for (const double odd : {kNan, -1.0, kInfinity, 0.0, 1e308}) {
        OneView view({}, hardware_costs(1000));
        for (int frame = 0; frame < 100; ++frame) {
            view.frame(
                row(20, 1e5), [](std::uint32_t item) { return item % 2 == 0; }, odd, odd);
            EXPECT_TRUE(std::isfinite(view.decided.exploration_ns));
            EXPECT_GE(view.decided.query_ns, view.decided.exploration_ns);
        }
    }
}

TEST(HardNumbers, odd_settings_are_survived) {
    OcclusionSettings odd;
    odd.keep_certainty = odd.keep_doubt = odd.keep_prior_answers = odd.unknown_hidden = odd.turn_frames =
        kNan;
    odd.memory_answers = odd.memory_item_frames = odd.exploration_share = odd.exploration_floor = kNan;
    odd.cold_coverage = kNan;
    odd.visible_interval = odd.max_multiquery = odd.lost_after_frames = odd.latent_max_age = 0;
    odd.merge_interval = odd.max_merge_interval = odd.explore_after = 0;
    for (const OcclusionMode mode : {OcclusionMode::Exact, OcclusionMode::Latent}) {
        odd.mode = mode;
        OneView view(odd, hardware_costs(1000));
        for (int frame = 0; frame < 100; ++frame) {
            view.frame(
                row(20, 1e5), [](std::uint32_t item) { return item % 2 == 0; }, 1e7, 1e6);
            if (frame % 7 == 0) view.scheduler.may_try(3, kNan);
            EXPECT_FALSE(std::isnan(view.decided.query_ns));
            EXPECT_FALSE(std::isnan(view.decided.saved_ns));
            EXPECT_GE(view.scheduler.p_hidden(0), 0.0);
            EXPECT_LE(view.scheduler.p_hidden(0), 1.0);
        }
    }
}

}  // namespace
}  // namespace rhview
