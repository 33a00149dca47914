// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/plan_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <vector>

#include "allocations.h"
#include "balls.h"
#include "job_system.h"
#include "rhview/pipeline/rhview_planner.h"

namespace rhview {
namespace {

constexpr DrawCosts kCosts{1.0, 60.0, 0.0};

/// A camera and shadow cascades of one frame.
struct Views {
    Views(const RhOctree& octree, std::size_t count) : inputs(count), plans(count) {
        for (std::size_t i = 0; i < count; ++i) {
            const double angle = 0.7 * static_cast<double>(i);
            inputs[i].culling_view.camera_from_world =
                look_along({0, 0, 0}, {std::cos(angle), 0, std::sin(angle)}, {0, 1, 0});
            inputs[i].culling_view.clip_from_camera =
                perspective(1.0, 1.5, 0.1, 100.0 + 50.0 * angle, ClipDepth::NegativeOneToOne);
            planners.emplace_back(octree, kCosts);
            to_plan.push_back({&planners[i], &inputs[i], &plans[i]});
        }
    }

    std::vector<FrameInput> inputs;
    std::vector<FramePlan> plans;
    std::deque<RhviewPlanner> planners;
    std::vector<ViewToPlan> to_plan;
};

RhOctree octree_of(const Balls& balls) {
    return build_octree(balls.batches(), {.max_leaf_triangles = 40, .costs = kCosts}).value();
}

TEST(PlanViews, plans_are_those_of_planning_one_after_the_other_on_any_threads) {
    const Balls balls(411, 3, 60, 200);
    const RhOctree octree = octree_of(balls);
    Views alone(octree, 6);
    for (const ViewToPlan& view : alone.to_plan) view.planner->plan(*view.input, *view.plan);
    JobSystem jobs, in_turn{.in_turn = true};
    for (const Workers& workers : {Workers{}, Workers{.thread_count = 3},
                                   Workers{.thread_count = 3, .run = JobSystem::run, .user = &jobs},
                                   Workers{.thread_count = 3, .run = JobSystem::run, .user = &in_turn}}) {
        Views together(octree, 6);
        plan_views(together.to_plan, workers);
        for (std::size_t i = 0; i < 6; ++i) {
            EXPECT_FALSE(together.plans[i].opaque.empty());
            EXPECT_EQ(together.plans[i].opaque, alone.plans[i].opaque);
        }
    }
    EXPECT_EQ(jobs.given.size(), 6u);
}

TEST(PlanViews, no_view_is_no_work) {
    EXPECT_NO_FATAL_FAILURE(plan_views({}));
}

TEST(PlanViews, warm_planners_on_the_calling_thread_allocate_nothing) {
    const Balls balls(412, 3, 60, 200);
    const RhOctree octree = octree_of(balls);
    Views views(octree, 4);
    plan_views(views.to_plan);
    const long before = allocations();
    plan_views(views.to_plan);
    EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace rhview
