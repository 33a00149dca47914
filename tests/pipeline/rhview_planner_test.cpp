// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/rhview_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "allocations.h"
#include "balls.h"
#include "rhview/pipeline/seed_planner.h"

namespace rhview {
namespace {

constexpr DrawCosts kCosts{0.25, 60.0, 0.0};

FrameInput input_at(double angle, std::span<const Aabb> boxes = {}) {
    return {{look_along({5 * std::sin(3 * angle), 0, 20 * angle}, {std::cos(angle), 0, std::sin(angle)},
                        {0, 1, 0}),
             perspective(1.0, 1.5, 0.1, 500.0, ClipDepth::ReversedZeroToOne), ClipDepth::ReversedZeroToOne},
            glm::dvec3(0.0),
            boxes};
}

RhOctree octree_of(const Balls& balls) {
    OctreeOptions options;
    options.max_leaf_triangles = 40;
    options.replica_budget = 1.0;
    options.costs = kCosts;
    return build_octree(balls.batches(), options).value();
}

double price(const FramePlan& plan, const DrawCosts& costs) {
    double total_ns = 0.0;
    for (std::size_t i = 0; i < plan.opaque.size(); ++i) {
        total_ns += costs.draw_ns + costs.index_ns * plan.opaque[i].index_count;
        if (i == 0 || plan.opaque[i].batch != plan.opaque[i - 1].batch) total_ns += costs.call_ns;
    }
    return total_ns;
}

TEST(RhviewPlanner, plans_for_less_than_the_seeds_rule_and_says_for_how_much) {
    const Balls balls(121, 4, 60, 200);
    const RhOctree octree = octree_of(balls);
    RhviewPlanner planner(octree, kCosts);
    SeedPlanner seed(octree);
    FramePlan plan, seed_plan;
    for (int i = 0; i < 40; ++i) {
        planner.plan(input_at(0.2 * i), plan);
        seed.plan(input_at(0.2 * i), seed_plan);
        EXPECT_LE(price(plan, kCosts), price(seed_plan, kCosts) * (1.0 + 1e-12));
        ASSERT_TRUE(plan.predicted_ns.has_value());
        EXPECT_NEAR(*plan.predicted_ns, price(plan, kCosts), 1e-9 * *plan.predicted_ns);
        EXPECT_FALSE(seed_plan.predicted_ns.has_value());
        EXPECT_GT(plan.nodes_visited, 0u);
        for (const std::uint32_t node : plan.chosen)
            EXPECT_EQ(planner.bounds_of(node), octree.node(NodeId{node}).bounds);
    }
}

TEST(RhviewPlanner, dear_draws_make_few_and_free_draws_make_many) {
    const Balls balls(122, 3, 60, 200);
    const RhOctree octree = octree_of(balls);
    RhviewPlanner planner(octree, {1.0, 0.0, 0.0});
    FramePlan plan;
    planner.plan(input_at(0.3), plan);
    const std::size_t many = plan.opaque.size();
    planner.set_costs({1.0, 1e9, 0.0});
    planner.plan(input_at(0.3), plan);
    EXPECT_EQ(plan.opaque.size(), 3u);  // one per batch
    EXPECT_GT(many, 20u);
}

TEST(RhviewPlanner, a_multi_draw_pays_its_call_once_per_batch) {
    const Balls balls(123, 3, 60, 200);
    const RhOctree octree = octree_of(balls);
    RhviewPlanner plain(octree, kCosts);
    RhviewPlanner multi(octree, {kCosts.index_ns, kCosts.draw_ns, 5000.0});
    FramePlan a, b;
    plain.plan(input_at(0.3), a);
    multi.plan(input_at(0.3), b);
    EXPECT_TRUE(std::ranges::is_sorted(b.opaque, {}, &DrawRange::batch));
    std::ranges::stable_sort(a.opaque, {}, &DrawRange::batch);  // drawn near to far, else
    EXPECT_EQ(a.opaque, b.opaque);
    EXPECT_NEAR(*b.predicted_ns - *a.predicted_ns, 3 * 5000.0, 1e-6);
}

TEST(RhviewPlanner, equal_inputs_give_equal_plans) {
    const Balls balls(124, 3, 60, 200);
    const RhOctree octree = octree_of(balls);
    RhviewPlanner one(octree, kCosts), two(octree, kCosts);
    FramePlan a, b;
    for (int i = 0; i < 20; ++i) {
        one.plan(input_at(0.3 * i), a);
        two.plan(input_at(0.3 * i), b);
        EXPECT_EQ(plan_hash(a), plan_hash(b));
        two.plan(input_at(0.3 * i), b);
        EXPECT_EQ(plan_hash(a), plan_hash(b));
    }
}

TEST(RhviewPlanner, dynamic_objects_are_drawn_unless_outside) {
    const RhOctree nothing;
    RhviewPlanner planner(nothing, kCosts);
    FramePlan plan;
    const std::vector<Aabb> boxes{{glm::vec3(9, -1, -1), glm::vec3(11, 1, 1)},
                                  {glm::vec3(-11, -1, -1), glm::vec3(-9, 1, 1)}};
    planner.plan(input_at(0.0, boxes), plan);
    EXPECT_EQ(plan.objects, (std::vector<ObjectId>{ObjectId{0}}));
    EXPECT_TRUE(plan.opaque.empty());
    EXPECT_EQ(plan.predicted_ns, 0.0);
}

TEST(RhviewPlanner, warm_planner_allocates_nothing) {
    const Balls balls(125, 4, 80, 200);
    const RhOctree octree = octree_of(balls);
    const std::vector<Aabb> boxes(50, Aabb{glm::vec3(9, -1, -1), glm::vec3(11, 1, 1)});
    RhviewPlanner planner(octree, kCosts);
    FramePlan plan;
    for (int i = 0; i < 60; ++i) planner.plan(input_at(0.1 * i, boxes), plan);
    const long before = allocations();
    std::uint32_t replicas = 0;
    for (int i = 0; i < 60; ++i) {
        planner.plan(input_at(0.1 * i, boxes), plan);
        replicas += planner.draw_list().replicas_drawn;
    }
    EXPECT_EQ(allocations() - before, 0);
    EXPECT_FALSE(plan.opaque.empty());
}

}  // namespace
}  // namespace rhview
