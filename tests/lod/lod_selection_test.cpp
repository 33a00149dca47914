// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/lod/lod_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "../pipeline/allocations.h"
#include "lod_fixture.h"

namespace rhview {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::uint32_t level_at(LodSelector& selector, double pixels_per_unit, const LodSelectionOptions& options) {
    const LodObject object{0, 0, pixels_per_unit, 100.0, {}};
    LodSelection selection;
    selector.select({&object, 1}, options, selection);
    return selection.levels[0];
}

TEST(LodSelector, takes_the_coarsest_level_within_the_bound) {
    Uniform uniform(1);
    for (int round = 0; round < 300; ++round) {
        std::vector<LodChain> chains;
        for (int i = 0; i < 4; ++i) chains.push_back(random_chain(uniform, 6));
        LodSelector selector(chains);
        std::vector<LodObject> objects;
        for (std::uint32_t i = 0; i < 20; ++i)
            objects.push_back({i, i % 4, i == 7 ? kInfinity : uniform.log(0.01, 1000), 50.0, {}});
        const double bound = uniform.log(0.1, 20);
        LodSelection selection;
        selector.select(objects, {.max_error_px = bound}, selection);
        double greatest = 0.0;
        std::uint64_t indices = 0;
        for (std::size_t i = 0; i < objects.size(); ++i) {
            const LodChain& chain = chains[objects[i].chain];
            std::uint32_t expected = 0;
            for (std::uint32_t level = 1; level < chain.levels.size(); ++level)
                if (error_px(chain, objects[i], level) <= bound) expected = level;
            ASSERT_EQ(selection.levels[i], expected);
            greatest = std::max(greatest, error_px(chain, objects[i], expected));
            indices += chain.levels[expected].index_count;
        }
        EXPECT_EQ(selection.max_error_px, greatest);
        EXPECT_EQ(selection.indices, indices);
        EXPECT_TRUE(selection.bound_met);
        EXPECT_TRUE(selection.budget_met);
        EXPECT_EQ(selection.switches, 0u) << "all are seen for the first time";
    }
}

TEST(LodSelector, bound_0_is_full_detail) {
    const std::vector<LodChain> chains{usual_chain(1000, 4, 0.01f)};
    LodSelector selector(chains);
    EXPECT_EQ(level_at(selector, 1e-30, {.max_error_px = 0.0}), 0u);
    EXPECT_EQ(level_at(selector, 0.0, {.max_error_px = 0.0}), 0u);
}

TEST(LodSelector, a_camera_that_trembles_at_any_switch_distance_switches_once_at_most) {
    const std::vector<LodChain> chains{usual_chain(10'000, 6, 0.01f)};
    Uniform uniform(3);
    for (int round = 0; round < 500; ++round) {
        LodSelector selector(chains);
        // Error 1 px at one of the levels: that is where it switches without hysteresis.
        const double centre = 1.0 / chains[0].levels[1 + static_cast<std::size_t>(round) % 5].error;
        std::uint32_t before = level_at(selector, centre * uniform(0.5, 2.0), {});
        int switches = -1;  // the way to the place is not a tremble
        for (int frame = 0; frame < 100; ++frame) {
            const std::uint32_t level = level_at(selector, centre * uniform(0.94, 1.06), {});
            switches += level != before || frame == 0 ? 1 : 0;
            before = level;
        }
        ASSERT_LE(switches, 1) << round;
    }
}

TEST(LodSelector, hysteresis_never_breaks_the_bound) {
    const std::vector<LodChain> chains{usual_chain(10'000, 6, 0.01f)};
    LodSelector selector(chains);
    Uniform uniform(4);
    for (int frame = 0; frame < 5000; ++frame) {
        const LodObject object{0, 0, uniform.log(1, 1000), 100.0, {}};
        LodSelection selection;
        selector.select({&object, 1}, {}, selection);
        ASSERT_TRUE(selection.bound_met);
        ASSERT_LE(selection.max_error_px, 1.0);
    }
}

TEST(LodSelector, a_switch_is_counted_and_a_forgotten_slot_has_none) {
    const std::vector<LodChain> chains{usual_chain(1000, 4, 0.01f)};
    LodSelector selector(chains);
    std::vector<LodObject> objects{{3, 0, 1000.0, 1.0, {}}, {9, 0, 1000.0, 1.0, {}}};
    LodSelection selection;
    selector.select(objects, {}, selection);
    EXPECT_EQ(selection.switches, 0u);
    for (LodObject& object : objects) object.pixels_per_unit = 0.1;
    selector.forget(9);
    selector.forget(1000);
    selector.select(objects, {}, selection);
    EXPECT_EQ(selection.switches, 1u);
    selector.select(objects, {}, selection);
    EXPECT_EQ(selection.switches, 0u);
}

TEST(LodSelector, what_is_seen_again_has_the_level_that_it_left_with) {
    const std::vector<LodChain> chains{usual_chain(1000, 4, 0.01f)};
    LodSelector selector(chains);
    // At 95 the next coarser level would do, but does not undercut the bound enough to be switched to.
    EXPECT_EQ(level_at(selector, 101.0, {}), 0u);
    LodSelection selection;
    selector.select({}, {}, selection);
    EXPECT_EQ(selection.max_error_px, 0.0);
    EXPECT_EQ(level_at(selector, 95.0, {}), 0u);
    LodSelector fresh(chains);
    EXPECT_EQ(level_at(fresh, 95.0, {}), 1u);
}

TEST(LodSelector, by_fragments_no_object_has_more_triangles_than_were_seen) {
    const std::vector<LodChain> chains{
        usual_chain(64'000, 6, 0.01f)};  // 64,000, 16,000, 4,000, 1,000, 250, 62
    const auto level = [&](std::optional<std::uint64_t> fragments, double pixels_per_unit,
                           double per_fragment) {
        LodSelector selector(chains);
        const LodObject object{0, 0, pixels_per_unit, 1e4, fragments};
        LodSelection selection;
        selector.select({&object, 1},
                        {.policy = LodPolicy::Fragments, .triangles_per_fragment = per_fragment}, selection);
        return selection.levels[0];
    };
    EXPECT_EQ(level(5000, 1e6, 1.0), 2u);
    EXPECT_EQ(level(4000, 1e6, 1.0), 2u);
    EXPECT_EQ(level(3999, 1e6, 1.0), 3u);
    EXPECT_EQ(level(3999, 1e6, 2.0), 2u);
    EXPECT_EQ(level(0, 1e6, 1.0), 5u);
    EXPECT_EQ(level(std::nullopt, 1e6, 1.0), 0u) << "what was not seen is not guessed";
    EXPECT_EQ(level(5000, 10.0, 1.0), 4u) << "distance allows less than the fragments do";
}

TEST(LodSelector, by_fragments_the_bound_may_break_and_the_error_says_so) {
    const std::vector<LodChain> chains{usual_chain(64'000, 6, 0.01f)};
    LodSelector selector(chains);
    const LodObject object{0, 0, 1000.0, 1e4, 300};
    LodSelection selection;
    selector.select({&object, 1}, {.policy = LodPolicy::Fragments}, selection);
    EXPECT_EQ(selection.levels[0], 4u);
    EXPECT_NEAR(selection.max_error_px, 80.0, 1e-4);
    EXPECT_FALSE(selection.bound_met);
}

TEST(LodSelector, fragments_that_tremble_switch_once_at_most) {
    const std::vector<LodChain> chains{usual_chain(64'000, 6, 0.01f)};
    Uniform uniform(6);
    for (int round = 0; round < 200; ++round) {
        LodSelector selector(chains);
        const double centre = chains[0].levels[1 + static_cast<std::size_t>(round) % 5].index_count / 3.0;
        std::uint32_t before = ~0u;
        int switches = -1;
        for (int frame = 0; frame < 100; ++frame) {
            const auto fragments = static_cast<std::uint64_t>(centre * uniform(0.94, 1.06));
            const LodObject object{0, 0, 1e6, 1e4, fragments};
            LodSelection selection;
            selector.select({&object, 1}, {.policy = LodPolicy::Fragments}, selection);
            switches += selection.levels[0] != before ? 1 : 0;
            before = selection.levels[0];
        }
        ASSERT_LE(switches, 1) << round;
    }
}

TEST(LodSelector, equal_inputs_give_equal_levels_and_a_warm_selector_allocates_nothing) {
    Uniform uniform(7);
    std::vector<LodChain> chains;
    for (int i = 0; i < 5; ++i) chains.push_back(random_chain(uniform, 6));
    std::vector<LodObject> objects;
    for (std::uint32_t i = 0; i < 300; ++i)
        objects.push_back({i, i % 5, uniform.log(0.1, 100), uniform.log(1, 1e5), {}});
    LodSelector first(chains), second(chains);
    LodSelection a, b;
    const LodCosts costs{1.0, 10.0, 500.0};
    for (int frame = 0; frame < 60; ++frame) {
        for (LodObject& object : objects) object.pixels_per_unit *= uniform(0.9, 1.1);
        const LodSelectionOptions options{.budget_ns = frame % 3 == 0 ? kInfinity : uniform(1e5, 1e6),
                                          .costs = costs};
        first.select(objects, options, a);
        const long before = allocations();
        second.select(objects, options, b);
        const long made = allocations() - before;
        EXPECT_TRUE(frame < 3 || made == 0) << frame << ": " << made;
        ASSERT_EQ(a.levels, b.levels);
        ASSERT_EQ(a.cost_ns, b.cost_ns);
    }
}

}  // namespace
}  // namespace rhview
