// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// The scheduler against a device that knows the truth: what is decided, and whether anything visible is
// missing.

#include "fake_gpu.h"

#include <gtest/gtest.h>

#include <cmath>

#include "allocations.h"
#include "flat_world.h"

namespace rhview {
namespace {

struct Habits {
    const char* name;
    FakeGpuHabits habits;
};

const Habits kHabits[] = {
    {"at once", {}},
    {"three frames late", {.latency = 3}},
    {"late and out of order", {.latency = 1, .latency_spread = 6, .shuffled = true, .seed = 3}},
    {"one in ten lost", {.latency = 2, .lost = 0.1, .seed = 4}},
    {"one in five twice",
     {.latency = 1, .latency_spread = 3, .duplicated = 0.2, .shuffled = true, .seed = 5}},
    {"all lost", {.lost = 1.0}},
    {"later than given up", {.latency = 40}},
};

/// Objects come, go, teleport; the eye walks and sometimes jumps.
void live(FlatWorld& world, int frame, Uniform& random) {
    world.eye = stroll(frame);
    if (frame % 97 == 0) world.eye.heading += 2.0;
    for (int i = 0; i < 8; ++i) {
        const auto item = static_cast<std::size_t>(random(0, static_cast<double>(world.discs.size())));
        FlatWorld::Disc& disc = world.discs[item];
        if (i < 5) disc.exists = !disc.exists;
        if (i >= 5) disc.x += random(-20, 20);
    }
}

TEST(ExactMode, everything_visible_is_drawn_at_once_or_hangs_on_a_query_of_this_frame_that_sees_it) {
    for (const Habits& habits : kHabits) {
        for (const OcclusionPolicy policy : {OcclusionPolicy::Model, OcclusionPolicy::Paper}) {
            SCOPED_TRACE(habits.name);
            FlatWorld world = forest(4000, 11, 1.5);
            FlatView view({.policy = policy}, software_costs(), habits.habits);
            Uniform random(5);
            std::size_t missing = 0, skipped = 0;
            for (int frame = 0; frame < 1000; ++frame) {
                live(world, frame, random);
                missing += view.frame(world).missing;
                for (const OcclusionDecision& decision : view.decided.decisions) {
                    skipped += decision.action == OcclusionAction::Skip ? 1 : 0;
                }
                ASSERT_TRUE(view.is_consistent()) << "frame " << frame;
            }
            EXPECT_EQ(missing, 0u);
            EXPECT_EQ(skipped, 0u);
            EXPECT_GT(view.gpu.asked(), 1000u);
        }
    }
}

TEST(ExactMode, late_lost_and_double_answers_are_counted) {
    FlatWorld world = forest(4000, 12, 1.5);
    FlatView view({.lost_after_frames = 4}, software_costs(),
                  {.latency = 1, .lost = 0.1, .duplicated = 0.1, .seed = 9});
    for (int frame = 0; frame < 200; ++frame) view.frame(world);
    const std::uint64_t lost = view.gpu.lost(), twice = view.gpu.duplicated();
    EXPECT_GT(lost, 100u);
    const OcclusionScheduler::Counters& counters = view.scheduler.counters();
    // The last frames' answers are still on their way.
    EXPECT_LE(counters.lost, lost);
    EXPECT_GE(counters.lost, lost * 9 / 10);
    EXPECT_LE(counters.unknown_tickets, twice);
    EXPECT_GE(counters.unknown_tickets, twice * 9 / 10);
    EXPECT_GT(counters.hidden, counters.answers / 2);
}

TEST(ExactMode, warm_scheduler_allocates_nothing) {
    FlatWorld world = forest(4000, 13, 1.5);
    FlatView view({}, software_costs(), {.latency = 2, .latency_spread = 2, .shuffled = true});
    for (int frame = 0; frame < 50; ++frame) {
        world.eye = {-250, 0, 0};  // sees the most
        view.frame(world);
    }
    const long before = allocations();
    long outside = 0;
    for (int frame = 0; frame < 300; ++frame) {
        world.eye = stroll(frame);
        outside += view.frame(world).allocations_of_test;
    }
    EXPECT_EQ(allocations() - before - outside, 0);
}

TEST(ExactMode, equal_inputs_give_equal_decisions) {
    const auto hash_of_walk = [](std::uint64_t seed) {
        FlatWorld world = forest(2000, 14, 2.0);
        FlatView view({.seed = seed}, software_costs(),
                      {.latency = 2, .latency_spread = 2, .shuffled = true});
        std::uint64_t hash = 0;
        for (int frame = 0; frame < 300; ++frame) {
            world.eye = stroll(3 * frame);
            hash = hash * 31 + view.frame(world).hash;
        }
        return hash;
    };
    EXPECT_EQ(hash_of_walk(1), hash_of_walk(1));
    EXPECT_NE(hash_of_walk(1), hash_of_walk(2));
}

}  // namespace
}  // namespace rhview
