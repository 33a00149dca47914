// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "random_geometry.h"
#include "rhview/baselines/draw_everything.h"
#include "rhview/baselines/frustum_objects.h"
#include "rhview/baselines/octree_leaves.h"

namespace rhview {
namespace {

FrameInput looking_along_x(std::span<const Aabb> boxes = {}) {
    return {{look_along({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
             perspective(1.0, 1.5, 0.1, 500.0, ClipDepth::NegativeOneToOne), ClipDepth::NegativeOneToOne},
            glm::dvec3(0.0),
            boxes};
}

const Aabb kAhead{glm::vec3(9, -1, -1), glm::vec3(11, 1, 1)};
const Aabb kBehind{glm::vec3(-11, -1, -1), glm::vec3(-9, 1, 1)};

TEST(DrawEverything, draws_each_batch_with_one_call_and_every_object) {
    const std::vector<std::uint32_t> counts{6, 0, 9};
    DrawEverything planner(counts, kAhead);
    FramePlan plan;
    const std::vector<Aabb> boxes{kBehind, kAhead};
    planner.plan(looking_along_x(boxes), plan);
    EXPECT_EQ(plan.opaque, (std::vector<DrawRange>{{BatchId{0}, 0, 6}, {BatchId{2}, 6, 9}}));
    EXPECT_EQ(plan.objects.size(), 2u);
    EXPECT_EQ(planner.bounds_of(plan.chosen.at(0)), kAhead);
}

TEST(FrustumObjects, draws_each_object_that_may_be_visible_on_its_own) {
    const DrawRange first{BatchId{0}, 0, 3}, second{BatchId{0}, 3, 3}, third{BatchId{1}, 6, 3};
    FrustumObjects planner({{first, kAhead}, {second, kBehind}, {third, kAhead}});
    FramePlan plan;
    planner.plan(looking_along_x(), plan);
    EXPECT_EQ(plan.opaque, (std::vector<DrawRange>{first, third}));
    EXPECT_EQ(plan.chosen, (std::vector<std::uint32_t>{0, 2}));
    EXPECT_EQ(plan.nodes_visited, 3u);
    EXPECT_EQ(planner.bounds_of(1), kBehind);
}

TEST(OctreeLeaves, draws_the_same_triangles_as_the_seeds_rule_with_more_calls) {
    const RandomGeometry geometry(31, 2, 4000);
    const RhOctree octree = build_octree(geometry.batches(), {20}).value();
    OctreeLeaves leaves(octree);
    SeedPlanner seed(octree);
    FramePlan a, b;
    leaves.plan(looking_along_x(), a);
    seed.plan(looking_along_x(), b);
    const auto indices_of = [&](const FramePlan& plan) {
        std::vector<std::uint32_t> drawn;
        for (const DrawRange& range : plan.opaque)
            for (std::uint32_t i = 0; i < range.index_count; ++i) drawn.push_back(range.first_index + i);
        return drawn;
    };
    EXPECT_EQ(indices_of(a), indices_of(b));
    EXPECT_GT(a.opaque.size(), b.opaque.size() + 100);
    for (const std::uint32_t node : a.chosen) EXPECT_TRUE(octree.is_leaf(NodeId{node}));
}

}  // namespace
}  // namespace rhview
