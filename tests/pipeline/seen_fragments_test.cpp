// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/seen_fragments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "fake_gpu.h"
#include "lod_fixture.h"
#include "rhview/pipeline/object_levels.h"
#include "rhview/pipeline/rhview_planner.h"

namespace rhview {
namespace {

FramePlan asking(std::uint64_t first_ticket, std::initializer_list<std::uint32_t> objects) {
    FramePlan plan;
    for (const std::uint32_t object : objects) {
        plan.counted_objects.push_back({ObjectId{object}, static_cast<std::uint32_t>(plan.queries.size())});
        plan.queries.push_back({first_ticket + plan.queries.size(), 0, 1, QueryWay::HardwareQuery, true});
    }
    return plan;
}

TEST(SeenFragments, are_those_of_the_last_answer_whatever_the_order) {
    SeenFragments seen;
    EXPECT_FALSE(seen.of(ObjectId{3}));
    seen.expect(asking(10, {3, 1}));
    seen.expect(asking(12, {1}));
    seen.absorb(std::vector<QueryAnswer>{{11, true, 70}, {99, true, 5}, {10, true, 30}});
    EXPECT_EQ(seen.of(ObjectId{3}), 30u);
    EXPECT_EQ(seen.of(ObjectId{1}), 70u);
    seen.absorb(std::vector<QueryAnswer>{{12, true, 7}, {12, true, 8}, {10, true, 9}});
    EXPECT_EQ(seen.of(ObjectId{1}), 7u) << "an answer that comes twice is heard once";
    EXPECT_EQ(seen.of(ObjectId{3}), 30u);
}

TEST(SeenFragments, are_not_known_of_what_was_hidden_forgotten_given_up_or_lost) {
    SeenFragments seen;
    seen.expect(asking(1, {0, 1, 2}));
    seen.forget(ObjectId{2});
    seen.absorb(std::vector<QueryAnswer>{{1, true, 40}, {2, true, 0}, {3, true, 50}});
    EXPECT_EQ(seen.of(ObjectId{0}), 40u);
    EXPECT_FALSE(seen.of(ObjectId{1})) << "given up: visible, and no number";
    EXPECT_FALSE(seen.of(ObjectId{2})) << "the answer was on its way when the object went";
    seen.expect(asking(4, {0}));
    seen.absorb(std::vector<QueryAnswer>{{4, false, 0}});
    EXPECT_FALSE(seen.of(ObjectId{0})) << "hidden";
    seen.expect(asking(5, {0}));
    for (int frame = 0; frame < 100; ++frame) seen.expect({});
    seen.absorb(std::vector<QueryAnswer>{{5, true, 40}});
    EXPECT_FALSE(seen.of(ObjectId{0})) << "long lost";
}

/// Eight things in a row that are dear enough to be asked about, seen through a slit: of each `samples`.
struct SlitWorld {
    SlitWorld() {
        chains = {usual_chain(4096, 6, 0.04f)};
        for (std::uint32_t i = 0; i < 8; ++i) {
            const glm::vec3 centre(4.0f * static_cast<float>(i) - 14.0f, 0.0f, -40.0f);
            boxes.push_back({centre - 1.0f, centre + 1.0f});
            objects.push_back({0, 1.0f});
        }
    }

    /// The levels after some frames, in which the device answers a frame late.
    std::vector<std::uint8_t> levels_after(LodPolicy policy, std::uint64_t samples) {
        const std::vector<std::uint32_t> indices(boxes.size(), 3 * 4096);
        OcclusionOptions occlusion;
        occlusion.costs = {{.query_ns = 300.0, .box_ns = 30.0, .pixel_ns = 1e-3, .draw_ns = 80.0},
                           {.query_ns = 10.0, .box_ns = 90.0, .pixel_ns = 1e-3, .draw_ns = 60.0}};
        occlusion.object_indices = indices;
        occlusion.counts_samples = policy == LodPolicy::Fragments;
        RhviewPlanner planner(octree, DrawCosts{1.0, 60.0, 0.0}, occlusion);
        ObjectLevels levels(chains, objects);
        FakeGpu gpu({.latency = 2});
        LevelOptions options;
        options.max_error_px = 1.0;
        options.policy = policy;
        FramePlan plan;
        for (int frame = 0; frame < 40; ++frame) {
            const auto answers = gpu.next_frame();
            planner.absorb(answers);
            levels.absorb(answers);
            FrameInput input;
            input.culling_view = {look_along({0, 0, 0}, {0, 0, -1}, {0, 1, 0}),
                                  perspective(1.0, 16.0 / 9.0, 0.1, 1000.0, ClipDepth::ReversedZeroToOne),
                                  ClipDepth::ReversedZeroToOne};
            input.object_boxes = boxes;
            planner.plan(input, plan);
            levels.choose(input, options, plan);
            for (const PlannedQuery& query : plan.queries) {
                EXPECT_EQ(query.counts_samples, occlusion.counts_samples);
                gpu.ask({query.ticket, true, query.counts_samples ? samples : 0});
            }
            asked += plan.counted_objects.size();
        }
        return {levels.levels().begin(), levels.levels().end()};
    }

    RhOctree octree = build_octree({}, {}).value();
    std::vector<LodChain> chains;
    std::vector<Aabb> boxes;
    std::vector<LevelledObject> objects;
    std::size_t asked = 0;
};

TEST(SeenFragments, make_levels_coarser_down_to_a_triangle_for_each) {
    SlitWorld world;
    const std::vector<std::uint8_t> by_error = world.levels_after(LodPolicy::ErrorBound, 0);
    EXPECT_EQ(world.asked, 0u) << "nothing counts unless it is asked for";
    const std::vector<std::uint8_t> many = world.levels_after(LodPolicy::Fragments, 1'000'000);
    EXPECT_GT(world.asked, 8u);
    EXPECT_EQ(many, by_error) << "where much is seen the bound decides";
    const std::vector<std::uint8_t> few = world.levels_after(LodPolicy::Fragments, 300);
    for (std::size_t i = 0; i < few.size(); ++i) {
        EXPECT_GT(few[i], by_error[i]);
        EXPECT_LE(world.chains[0].levels[few[i]].index_count / 3, 300u);
        EXPECT_GT(world.chains[0].levels[few[i] - 1u].index_count / 3, 300u);
    }
}

}  // namespace
}  // namespace rhview
