// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/seed_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "allocations.h"
#include "random_geometry.h"

namespace rhview {
namespace {

FrameInput input_at(double angle, std::span<const Aabb> boxes = {}) {
    return {{look_along({0, 0, 0}, {std::cos(angle), 0, std::sin(angle)}, {0, 1, 0}),
             perspective(1.0, 1.5, 0.1, 500.0, ClipDepth::ReversedZeroToOne), ClipDepth::ReversedZeroToOne},
            glm::dvec3(0.0),
            boxes};
}

TEST(SeedPlanner, ranges_are_grouped_by_batch_and_ordered_within) {
    const RandomGeometry geometry(21, 5, 2000);
    const RhOctree octree = build_octree(geometry.batches(), {50}).value();
    SeedPlanner planner(octree);
    FramePlan plan;
    planner.plan(input_at(0.4), plan);
    ASSERT_GT(plan.opaque.size(), 20u);
    EXPECT_TRUE(std::ranges::is_sorted(plan.opaque, {},
                                       [](const DrawRange& r) { return std::pair(r.batch, r.first_index); }));
    std::size_t ranges = 0;
    for (const std::uint32_t node : plan.chosen) {
        ranges += octree.ranges(NodeId{node}).size();
        EXPECT_EQ(planner.bounds_of(node), octree.node(NodeId{node}).bounds);
    }
    EXPECT_EQ(ranges, plan.opaque.size());
    EXPECT_GT(plan.nodes_visited, 0u);
}

TEST(SeedPlanner, equal_inputs_give_equal_plans) {
    const RandomGeometry geometry(22, 3, 2000);
    const RhOctree octree = build_octree(geometry.batches(), {50}).value();
    SeedPlanner one(octree), two(octree);
    FramePlan a, b;
    for (int i = 0; i < 20; ++i) {
        one.plan(input_at(0.3 * i), a);
        two.plan(input_at(0.3 * i), b);
        EXPECT_EQ(plan_hash(a), plan_hash(b));
        two.plan(input_at(0.3 * i), b);
        EXPECT_EQ(plan_hash(a), plan_hash(b));
    }
}

TEST(SeedPlanner, dynamic_objects_are_drawn_unless_outside) {
    const RhOctree nothing;
    SeedPlanner planner(nothing);
    FramePlan plan;
    const std::vector<Aabb> boxes{{glm::vec3(9, -1, -1), glm::vec3(11, 1, 1)},
                                  {glm::vec3(-11, -1, -1), glm::vec3(-9, 1, 1)},
                                  {glm::vec3(-1, -1, -1), glm::vec3(1, 1, 1)}};
    planner.plan(input_at(0.0, boxes), plan);
    EXPECT_EQ(plan.objects, (std::vector<ObjectId>{ObjectId{0}, ObjectId{2}}));
    EXPECT_TRUE(plan.opaque.empty());
}

TEST(SeedPlanner, warm_planner_allocates_nothing) {
    const RandomGeometry geometry(23, 4, 3000);
    const RhOctree octree = build_octree(geometry.batches(), {30}).value();
    const std::vector<Aabb> boxes(50, Aabb{glm::vec3(9, -1, -1), glm::vec3(11, 1, 1)});
    SeedPlanner planner(octree);
    FramePlan plan;
    for (int i = 0; i < 60; ++i) planner.plan(input_at(0.1 * i, boxes), plan);
    const long before = allocations();
    for (int i = 0; i < 60; ++i) planner.plan(input_at(0.1 * i, boxes), plan);
    EXPECT_EQ(allocations() - before, 0);
    EXPECT_FALSE(plan.opaque.empty());
}

}  // namespace
}  // namespace rhview
