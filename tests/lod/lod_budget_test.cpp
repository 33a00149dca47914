// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Levels within a budget, against every possible selection.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "lod_fixture.h"

namespace rhview {
namespace {

struct Case {
    std::vector<LodChain> chains;
    std::vector<LodObject> objects;
    LodSelectionOptions options;

    [[nodiscard]] double cost(const std::vector<std::uint32_t>& levels) const {
        std::uint64_t indices = 0;
        std::set<std::pair<std::uint32_t, std::uint32_t>> groups;
        for (std::size_t i = 0; i < objects.size(); ++i) {
            indices += chains[objects[i].chain].levels[levels[i]].index_count;
            groups.emplace(objects[i].chain, levels[i]);
        }
        const LodCosts& costs = options.costs;
        return costs.index_ns * static_cast<double>(indices) +
               costs.draw_ns * static_cast<double>(groups.size()) +
               costs.object_ns * static_cast<double>(objects.size());
    }
    [[nodiscard]] double loss(const std::vector<std::uint32_t>& levels) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < objects.size(); ++i)
            sum += error_px(chains[objects[i].chain], objects[i], levels[i]) * std::sqrt(objects[i].size_px);
        return sum;
    }
    [[nodiscard]] std::vector<std::uint32_t> coarsest() const {
        std::vector<std::uint32_t> levels;
        for (const LodObject& object : objects)
            levels.push_back(static_cast<std::uint32_t>(chains[object.chain].levels.size() - 1));
        return levels;
    }
    /// Calls `visit` with every selection of levels no finer than what the bound wants.
    template <class Visit>
    void visit_all(const Visit& visit) const {
        std::vector<std::uint32_t> finest;
        for (const LodObject& object : objects) {
            const LodChain& chain = chains[object.chain];
            std::uint32_t level = 0;
            while (level + 1 < chain.levels.size() &&
                   error_px(chain, object, level + 1) <= options.max_error_px)
                ++level;
            finest.push_back(level);
        }
        std::vector<std::uint32_t> levels = finest;
        const std::vector<std::uint32_t> last = coarsest();
        for (;;) {
            visit(levels);
            std::size_t i = 0;
            while (i < levels.size() && levels[i] == last[i]) {
                levels[i] = finest[i];
                ++i;
            }
            if (i == levels.size()) return;
            ++levels[i];
        }
    }
};

Case random_case(Uniform& uniform, double draw_ns) {
    Case c;
    const auto chains = static_cast<std::uint32_t>(uniform(1, 3.999));
    for (std::uint32_t i = 0; i < chains; ++i) c.chains.push_back(random_chain(uniform, 4));
    const auto count = static_cast<std::uint32_t>(uniform(1, 6.999));
    for (std::uint32_t i = 0; i < count; ++i)
        c.objects.push_back({i,
                             static_cast<std::uint32_t>(uniform(0, chains)),
                             uniform.log(0.5, 100),
                             uniform.log(1, 1e5),
                             {}});
    c.options.max_error_px = uniform(0, 1) < 0.5 ? 0.0 : uniform.log(0.5, 10);
    c.options.costs = {uniform.log(0.1, 10), uniform(0, 100), draw_ns};
    const double cheapest = c.cost(c.coarsest()), dearest = c.cost(std::vector<std::uint32_t>(count, 0));
    c.options.budget_ns = cheapest + uniform(-0.2, 1.2) * (dearest - cheapest);
    return c;
}

TEST(LodBudget, is_met_whenever_any_selection_meets_it_and_the_answer_says_so) {
    Uniform uniform(11);
    int met = 0, unmet = 0;
    for (int round = 0; round < 3000; ++round) {
        const Case c = random_case(uniform, round % 2 == 0 ? 0.0 : uniform.log(10, 10'000));
        bool possible = false;
        c.visit_all(
            [&](const auto& levels) { possible = possible || c.cost(levels) <= c.options.budget_ns; });
        LodSelector selector(c.chains);
        LodSelection selection;
        selector.select(c.objects, c.options, selection);
        ASSERT_EQ(selection.budget_met, possible) << round;
        ASSERT_DOUBLE_EQ(selection.cost_ns, c.cost(selection.levels)) << round;
        ASSERT_EQ(selection.cost_ns <= c.options.budget_ns, possible) << round;
        if (!possible) {
            ASSERT_EQ(selection.levels, c.coarsest());
        }
        (possible ? met : unmet) += 1;
    }
    EXPECT_GT(met, 1500);
    EXPECT_GT(unmet, 100);
}

TEST(LodBudget, gains_at_least_half_of_what_the_best_selection_gains_where_draws_cost_nothing) {
    Uniform uniform(12);
    double worst = 1.0, sum = 0.0;
    int counted = 0;
    for (int round = 0; round < 3000; ++round) {
        const Case c = random_case(uniform, 0.0);
        const double start = c.loss(c.coarsest());
        double best = -1.0;
        c.visit_all([&](const auto& levels) {
            if (c.cost(levels) <= c.options.budget_ns) best = std::max(best, start - c.loss(levels));
        });
        if (!(best > 1e-9)) continue;
        LodSelector selector(c.chains);
        LodSelection selection;
        selector.select(c.objects, c.options, selection);
        const double share = (start - c.loss(selection.levels)) / best;
        ASSERT_GE(share, 0.5 - 1e-9) << round;
        ASSERT_LE(share, 1.0 + 1e-9) << round;
        worst = std::min(worst, share);
        sum += share;
        ++counted;
    }
    RecordProperty("worst_share", std::to_string(worst));
    EXPECT_GT(counted, 1000);
    EXPECT_GT(sum / counted, 0.97) << "as a rule it is close to the best";
}

TEST(LodBudget, no_step_that_still_fits_is_left_undone) {
    Uniform uniform(13);
    for (int round = 0; round < 1000; ++round) {
        const Case c = random_case(uniform, 0.0);
        LodSelector selector(c.chains);
        LodSelection selection;
        selector.select(c.objects, c.options, selection);
        if (!selection.budget_met) continue;
        for (std::size_t i = 0; i < c.objects.size(); ++i) {
            const LodChain& chain = c.chains[c.objects[i].chain];
            const std::uint32_t level = selection.levels[i];
            if (level == 0 || error_px(chain, c.objects[i], level) <= c.options.max_error_px) continue;
            std::vector<std::uint32_t> finer = selection.levels;
            --finer[i];
            ASSERT_GT(c.cost(finer), c.options.budget_ns) << round;
        }
    }
}

TEST(LodBudget, a_small_useful_object_does_not_keep_out_a_large_one) {
    // The small step gains more per index, but the large one alone gains a hundred times as much.
    Case c;
    c.chains.push_back(made_chain({2, 1}, {0.0f, 0.02f}));
    c.chains.push_back(made_chain({1001, 1}, {0.0f, 1.0f}));
    c.objects = {{0, 0, 100.0, 1.0, {}}, {1, 1, 100.0, 1.0, {}}};
    c.options = {.max_error_px = 0.0, .costs = {1.0, 0.0, 0.0}};
    c.options.budget_ns = 3.0 * 1002.0;
    LodSelector selector(c.chains);
    LodSelection selection;
    selector.select(c.objects, c.options, selection);
    EXPECT_EQ(selection.levels, (std::vector<std::uint32_t>{1, 0}));
}

TEST(LodBudget, the_bound_gives_way_only_where_it_costs_too_much) {
    Case c;
    for (std::uint32_t i = 0; i < 50; ++i) {
        c.chains.push_back(usual_chain(10'000, 6, 0.01f));
        c.objects.push_back({i, i, 10.0 * (1 + i), 1000.0, {}});
    }
    LodSelector selector(c.chains);
    LodSelection unbounded, ample, scarce;
    selector.select(c.objects, {}, unbounded);
    LodSelectionOptions options{.costs = {1.0, 0.0, 0.0}};
    options.budget_ns = static_cast<double>(unbounded.indices);
    selector.select(c.objects, options, ample);
    EXPECT_EQ(ample.levels, unbounded.levels);
    EXPECT_TRUE(ample.bound_met);
    options.budget_ns *= 0.5;
    selector.select(c.objects, options, scarce);
    EXPECT_TRUE(scarce.budget_met);
    EXPECT_FALSE(scarce.bound_met);
    EXPECT_GT(scarce.max_error_px, 1.0);
    EXPECT_LE(scarce.cost_ns, options.budget_ns);
    EXPECT_GT(scarce.cost_ns, 0.9 * options.budget_ns);
}

TEST(LodBudget, a_camera_that_trembles_changes_the_selection_three_times_at_most) {
    Uniform uniform(14);
    std::vector<LodChain> chains{usual_chain(10'000, 6, 0.01f), usual_chain(3'000, 5, 0.02f)};
    for (int round = 0; round < 100; ++round) {
        LodSelector selector(chains);
        std::vector<LodObject> objects;
        for (std::uint32_t i = 0; i < 40; ++i)
            objects.push_back({i, i % 2, uniform.log(1, 1000), uniform.log(10, 1e5), {}});
        LodSelection selection;
        LodSelectionOptions options{.costs = {1.0, 5.0, 100.0}};
        LodSelector measure(chains);
        measure.select(objects, options, selection);
        // At and about the price of the bound's own levels, and far below.
        options.budget_ns = selection.cost_ns * (round % 3 == 0 ? 1.0 : uniform(0.2, 1.05));
        int changed = -1;
        std::vector<LodObject> trembling = objects;
        for (int frame = 0; frame < 60; ++frame) {
            const double tremble = uniform(0.97, 1.03);
            for (std::size_t i = 0; i < objects.size(); ++i)
                trembling[i].pixels_per_unit = objects[i].pixels_per_unit * tremble;
            selector.select(trembling, options, selection);
            changed += selection.switches > 0 || frame == 0 ? 1 : 0;
            ASSERT_EQ(selection.cost_ns <= options.budget_ns, selection.budget_met);
        }
        ASSERT_LE(changed, 3) << round;
    }
}

TEST(LodBudget, unbounded_errors_are_refined_first) {
    // One object surrounds the eye: nothing bounds its error but full detail.
    const std::vector<LodChain> chains{usual_chain(1000, 4, 0.01f)};
    std::vector<LodObject> objects{{0, 0, 50.0, 1000.0, {}},
                                   {1, 0, std::numeric_limits<double>::infinity(), 1000.0, {}}};
    LodSelector selector(chains);
    LodSelection selection;
    selector.select(objects, {.max_error_px = 0.0, .budget_ns = 3.0 * 1100.0, .costs = {1.0, 0.0, 0.0}},
                    selection);
    EXPECT_EQ(selection.levels[1], 0u);
    EXPECT_GT(selection.levels[0], 0u);
    EXPECT_TRUE(std::isfinite(selection.max_error_px));
}

}  // namespace
}  // namespace rhview
