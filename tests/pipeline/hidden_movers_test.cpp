// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// How many of many hidden movers the application has to move.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fake_gpu.h"
#include "rhview/pipeline/moving_objects.h"
#include "rhview/pipeline/rhview_planner.h"
#include "seen_before_wall.h"
#include "uniform.h"

namespace rhview {
namespace {

Aabb box_at(const glm::dvec3& centre, double half = 0.5) {
    return {glm::vec3(centre - half), glm::vec3(centre + half)};
}

/// A street that is seen, and walkers on a square beyond x = 20 where nothing is.
class WalledSquare {
  public:
    WalledSquare(std::uint32_t hidden, bool ranges)
        : planner_(octree_, DrawCosts{1.0, 60.0, 0.0}, options()) {
        Uniform random(3);
        for (std::uint32_t i = 0; i < kSeen + hidden; ++i) {
            const double x = i < kSeen ? random(8, 15) : random(30, 80);
            centres_.emplace_back(x, random(-1, 1), i < kSeen ? random(-8, 8) : random(-20, 20));
            const MotionPromise promise{1.5, ranges ? box_at(centres_.back(), 3.0) : Aabb{}};
            objects_.add(box_at(centres_.back()), i % 4, promise);
        }
    }

    /// How many objects the application has to move per frame, once it is used to the scene.
    double touched_per_frame() {
        std::size_t touched = 0;
        for (int frame = 0; frame < kFrames; ++frame) {
            const double time = frame / 60.0;
            objects_.begin_frame(time);
            if (frame >= kFrames / 2) touched += objects_.due().size();
            due_.assign(objects_.due().begin(), objects_.due().end());
            for (const ObjectId object : due_)
                objects_.move(object,
                              box_at(centres_[index_of(object)] + 0.9 * glm::dvec3(std::sin(time), 0, 0)));
            FrameInput input;
            input.culling_view = {look_along({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                  perspective(1.6, 1.5, 0.1, 500.0, ClipDepth::ReversedZeroToOne),
                                  ClipDepth::ReversedZeroToOne};
            objects_.describe(input);
            planner_.absorb(gpu_.next_frame());
            planner_.plan(input, plan_);
            ask_before_wall(plan_, gpu_);
            objects_.end_frame(plan_);
        }
        return static_cast<double>(touched) / (kFrames - kFrames / 2);
    }

  private:
    static OcclusionOptions options() {
        OcclusionOptions options;
        options.costs = {{.query_ns = 300.0, .box_ns = 30.0, .pixel_ns = 1e-3, .draw_ns = 80.0},
                         {.query_ns = 10.0, .box_ns = 90.0, .pixel_ns = 1e-3, .draw_ns = 60.0}};
        static const std::vector<std::uint32_t> indices(20'000, 90);
        options.object_indices = indices;
        return options;
    }

    static constexpr std::uint32_t kSeen = 40;
    static constexpr int kFrames = 600;

    RhOctree octree_ = build_octree({}, {}).value();
    RhviewPlanner planner_;
    MovingObjects objects_;
    FakeGpu gpu_;
    FramePlan plan_;
    std::vector<glm::dvec3> centres_;
    std::vector<ObjectId> due_;
};

TEST(HiddenMovers, ten_times_as_many_that_are_hidden_with_their_ranges_are_not_touched_more) {
    const double few = WalledSquare(1'000, true).touched_per_frame();
    const double many = WalledSquare(10'000, true).touched_per_frame();
    EXPECT_GE(few, 40.0) << "those in the street are seen";
    EXPECT_LE(few, 42.0);
    EXPECT_LT(many, 1.05 * few);
}

TEST(HiddenMovers, without_ranges_they_are_touched_about_once_a_second) {
    const double few = WalledSquare(1'000, false).touched_per_frame();
    const double many = WalledSquare(10'000, false).touched_per_frame();
    EXPECT_GT(few, 40.0 + 0.8 * 1'000 / 60.0);
    EXPECT_LT(few, 40.0 + 1.2 * 1'000 / 60.0);
    EXPECT_LT(many, 40.0 + 1.2 * 10'000 / 60.0);
}

}  // namespace
}  // namespace rhview
