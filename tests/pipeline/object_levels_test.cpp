// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/object_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "allocations.h"
#include "lod_fixture.h"
#include "rhview/lod/projected_error.h"
#include "uniform.h"

namespace rhview {
namespace {

constexpr std::uint32_t kObjects = 200;

FrameInput looking_ahead(double z = 0.0) {
    FrameInput input;
    input.culling_view = {look_along({0, 0, z}, {0, 0, -1}, {0, 1, 0}),
                          perspective(1.0, 16.0 / 9.0, 0.1, 1000.0, ClipDepth::ReversedZeroToOne),
                          ClipDepth::ReversedZeroToOne};
    return input;
}

/// Objects of two chains and of none, ahead of the eye and all about it, in three groups.
struct World {
    World() {
        chains = {usual_chain(4096, 5, 0.02f), usual_chain(1000, 3, 0.1f), usual_chain(50, 1, 0.0f)};
        Uniform uniform(3);
        for (std::uint32_t i = 0; i < kObjects; ++i) {
            const glm::dvec3 centre(uniform(-40, 40), uniform(-20, 20), uniform(-200, 40));
            boxes.push_back({glm::vec3(centre - 0.5), glm::vec3(centre + 0.5)});
            groups.push_back(i % 4);
            objects.push_back({i % 4 == 3 ? LevelledObject::kNoChain : i % 4, i % 2 == 0 ? 1.0f : 0.5f});
        }
    }

    [[nodiscard]] FrameInput input(double z = 0.0) const {
        FrameInput input = looking_ahead(z);
        input.object_boxes = boxes;
        input.object_groups = groups;
        return input;
    }

    /// What a planner makes of it, a third of it on two queries.
    [[nodiscard]] FramePlan plan(const FrameInput& input) const {
        FramePlan plan;
        std::vector<ObjectId> seen;
        append_visible_objects(make_frustum(input.culling_view, input.scene_origin), boxes, seen);
        plan.queries.resize(2);
        for (const ObjectId object : seen) {
            const auto id = static_cast<std::uint32_t>(object);
            if (id % 3 == 0)
                plan.conditional_objects.push_back({object, id % 2});
            else
                plan.objects.push_back(object);
        }
        ObjectSorter().sort(groups, plan);
        return plan;
    }

    [[nodiscard]] double error_px(const FrameInput& input, ObjectId object, std::uint32_t level) const {
        const LevelledObject& levelled = objects[index_of(object)];
        BoundingSphere sphere = sphere_of(boxes[index_of(object)]);
        sphere.centre -= input.culling_view.eye();
        const double pixels =
            pixels_per_unit(input.culling_view.clip_from_eye_relative(), sphere, 1280.0, 720.0);
        return projected_error_px(chains[levelled.chain].levels[level].error, levelled.scale * pixels);
    }

    std::vector<LodChain> chains;
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> groups;
    std::vector<LevelledObject> objects;
};

TEST(ObjectLevels, no_object_of_a_plan_is_wrong_by_more_than_the_bound_and_none_is_finer_than_it_must) {
    const World world;
    ObjectLevels levels(world.chains, world.objects);
    for (const double bound : {0.3, 1.0, 4.0}) {
        const FrameInput input = world.input();
        FramePlan plan = world.plan(input);
        LevelOptions options;
        options.max_error_px = bound;
        const LevelSummary summary = ObjectLevels(world.chains, world.objects).choose(input, options, plan);
        ASSERT_EQ(plan.object_levels.size(), plan.objects.size());
        double most = 0.0;
        std::size_t coarse = 0;
        const auto check = [&](ObjectId object, std::uint32_t level) {
            const LevelledObject& levelled = world.objects[index_of(object)];
            if (levelled.chain == LevelledObject::kNoChain) {
                EXPECT_EQ(level, 0u);
                return;
            }
            EXPECT_LE(world.error_px(input, object, level), bound);
            if (level + 1 < world.chains[levelled.chain].levels.size()) {
                EXPECT_GT(world.error_px(input, object, level + 1), bound);
            }
            coarse += level > 0;
        };
        for (std::size_t i = 0; i < plan.objects.size(); ++i) {
            check(plan.objects[i], plan.object_levels[i]);
            if (world.objects[index_of(plan.objects[i])].chain != LevelledObject::kNoChain)
                most = std::max(most, world.error_px(input, plan.objects[i], plan.object_levels[i]));
        }
        for (const ConditionalObject& object : plan.conditional_objects) check(object.object, object.level);
        EXPECT_DOUBLE_EQ(summary.max_error_px, most);
        EXPECT_TRUE(summary.bound_met);
        EXPECT_GT(coarse, 10u);
    }
}

TEST(ObjectLevels, a_plan_keeps_its_objects_by_group_level_and_number) {
    const World world;
    ObjectLevels levels(world.chains, world.objects);
    const FrameInput input = world.input();
    FramePlan plan = world.plan(input);
    std::vector<ObjectId> before = plan.objects;
    levels.choose(input, {}, plan);
    const auto key = [&](std::size_t i) {
        return std::tuple(world.groups[index_of(plan.objects[i])], plan.object_levels[i],
                          index_of(plan.objects[i]));
    };
    for (std::size_t i = 1; i < plan.objects.size(); ++i) EXPECT_LT(key(i - 1), key(i));
    for (std::size_t i = 0; i < plan.objects.size(); ++i) {
        EXPECT_EQ(levels.levels()[index_of(plan.objects[i])], plan.object_levels[i]);
        EXPECT_EQ(levels.indices(plan.objects[i], 150u),
                  world.objects[index_of(plan.objects[i])].chain == LevelledObject::kNoChain
                      ? 150u
                      : world.chains[world.objects[index_of(plan.objects[i])].chain]
                            .levels[plan.object_levels[i]]
                            .index_count);
    }
    std::ranges::sort(before);
    std::ranges::sort(plan.objects);
    EXPECT_EQ(plan.objects, before);
}

TEST(ObjectLevels, a_bound_of_nothing_leaves_the_plan_as_it_is) {
    const World world;
    ObjectLevels levels(world.chains, world.objects);
    const FrameInput input = world.input();
    FramePlan plan = world.plan(input);
    const std::uint64_t hash = plan_hash(plan);
    LevelOptions options;
    options.max_error_px = 0.0;
    EXPECT_EQ(levels.choose(input, options, plan).max_error_px, 0.0);
    EXPECT_EQ(plan_hash(plan), hash);
    EXPECT_TRUE(plan.object_levels.empty());
}

TEST(ObjectLevels, a_budget_holds_for_what_is_drawn_at_once_and_the_rest_is_no_finer) {
    const World world;
    const FrameInput input = world.input();
    LevelOptions options;
    options.max_error_px = 0.05;
    options.costs = {1.0, 0.0, 100.0};
    FramePlan plan = world.plan(input);
    const LevelSummary free = ObjectLevels(world.chains, world.objects).choose(input, options, plan);
    for (const double share : {0.9, 0.4, 0.1, 1e-6}) {
        plan = world.plan(input);
        options.budget_ns = share * free.cost_ns;
        ObjectLevels levels(world.chains, world.objects);
        const LevelSummary held = levels.choose(input, options, plan);
        EXPECT_EQ(held.budget_met, share > 0.01);
        if (held.budget_met) {
            EXPECT_LE(held.cost_ns, options.budget_ns);
        }
        EXPECT_GT(held.max_error_px, free.max_error_px);
        EXPECT_FALSE(held.bound_met);
        if (!std::isfinite(held.max_error_px)) continue;
        for (const ConditionalObject& object : plan.conditional_objects) {
            const LevelledObject& levelled = world.objects[index_of(object.object)];
            if (levelled.chain == LevelledObject::kNoChain) continue;
            if (object.level + std::size_t{1} < world.chains[levelled.chain].levels.size()) {
                EXPECT_GT(world.error_px(input, object.object, object.level + 1u), held.max_error_px);
            }
        }
    }
}

TEST(ObjectLevels, what_draws_as_it_finds_gets_the_same_levels_ahead) {
    const World world;
    const FrameInput input = world.input();
    FramePlan plan = world.plan(input);
    ObjectLevels ahead(world.chains, world.objects), after(world.chains, world.objects);
    after.choose(input, {}, plan);
    ahead.choose(input, {});
    for (const ObjectId object : plan.objects)
        EXPECT_EQ(ahead.levels()[index_of(object)], after.levels()[index_of(object)]);
    for (const ConditionalObject& object : plan.conditional_objects)
        EXPECT_EQ(ahead.levels()[index_of(object.object)], object.level);
}

TEST(ObjectLevels, completed_levels_are_the_plans_own_and_the_bounds_for_the_rest) {
    const World world;
    const FrameInput input = world.input();
    FramePlan plan = world.plan(input);
    ObjectLevels levels(world.chains, world.objects);
    levels.choose(input, {}, plan);
    // Something else than the bound would choose.
    plan.object_levels.assign(plan.objects.size(), 0);
    std::vector<std::uint8_t> all;
    levels.complete(input, {}, plan, all);
    ASSERT_EQ(all.size(), kObjects);
    std::vector<bool> planned(kObjects);
    for (const ObjectId object : plan.objects) {
        planned[index_of(object)] = true;
        EXPECT_EQ(all[index_of(object)], 0);
    }
    for (const ConditionalObject& object : plan.conditional_objects) {
        planned[index_of(object.object)] = true;
        EXPECT_EQ(all[index_of(object.object)], object.level);
    }
    std::size_t coarse = 0;
    for (std::uint32_t i = 0; i < kObjects; ++i) {
        if (planned[i] || world.objects[i].chain == LevelledObject::kNoChain) continue;
        EXPECT_LE(world.error_px(input, ObjectId{i}, all[i]), 1.0);
        coarse += all[i] > 0;
    }
    EXPECT_GT(coarse, 5u);
}

TEST(ObjectLevels, a_new_object_under_an_old_number_is_not_held_back_by_what_was_known_of_the_old) {
    World world;
    const double far = 60.0;
    world.objects.assign(1, {0, 1.0f});
    world.boxes.assign(1, {glm::vec3(-0.5f, -0.5f, -far - 0.5f), glm::vec3(0.5f, 0.5f, -far + 0.5f)});
    world.groups.assign(1, 0);
    const auto level_at = [&](ObjectLevels& levels, double z, bool is_new) {
        FrameInput input = world.input(z);
        const ObjectId number{0};
        if (is_new) input.new_objects = {&number, 1};
        FramePlan plan;
        plan.objects = {number};
        LevelOptions options;
        levels.choose(input, options, plan);
        return plan.level_of_object(0);
    };
    // From where it is a little too near for the next level to where it is just far enough for it: an old
    // object stays at its level until the bound is undercut clearly.
    double z = 0.0;
    ObjectLevels levels(world.chains, world.objects);
    const std::uint8_t before = level_at(levels, z, true);
    while (level_at(levels, z += 0.5, true) == before) ASSERT_LT(z, 500.0);
    ObjectLevels old(world.chains, world.objects), fresh(world.chains, world.objects);
    EXPECT_EQ(level_at(old, z - 0.5, true), before);
    EXPECT_EQ(level_at(old, z, false), before);
    EXPECT_EQ(level_at(fresh, z - 0.5, true), before);
    EXPECT_EQ(level_at(fresh, z, true), before + 1);
}

TEST(ObjectLevels, late_levels_are_those_of_the_bound_and_stand_in_order_whoever_was_named_before) {
    const World world;
    ObjectLevels levels(world.chains, world.objects);
    LevelOptions options;
    std::size_t named = 0;
    for (unsigned frame = 0; frame < 12; ++frame) {
        const FrameInput input = world.input(static_cast<double>(frame));
        FramePlan plan = world.plan(input), whole = plan;
        const LevelSummary summary = levels.choose_at_once(input, options, plan);
        ObjectLevels fresh(world.chains, world.objects);
        fresh.choose(input, options, whole);
        EXPECT_EQ(summary.budget_met, true);
        std::vector<std::uint32_t> places;
        for (std::uint32_t i = 0; i < plan.conditional_objects.size(); ++i)
            if (i % (1 + frame % 3) == 0) places.push_back(i);
        std::vector<std::uint32_t> ordered = places;
        levels.choose_late(input, plan, ordered);
        for (const ConditionalObject& object : plan.conditional_objects) {
            const auto place = static_cast<std::uint32_t>(&object - plan.conditional_objects.data());
            const bool was_named = std::ranges::binary_search(places, place);
            const auto same =
                std::ranges::find(whole.conditional_objects, object.object, &ConditionalObject::object);
            EXPECT_EQ(object.level, was_named ? same->level : 0) << frame;
            if (!was_named) continue;
            EXPECT_EQ(levels.levels()[index_of(object.object)], object.level);
            EXPECT_EQ(levels.level_by_bound(input, object.object), object.level);
            named += object.level > 0;
        }
        const auto key_of = [&](std::uint32_t place) {
            const ConditionalObject& object = plan.conditional_objects[place];
            return std::tuple(world.groups[index_of(object.object)], object.level, object.query,
                              object.object);
        };
        EXPECT_TRUE(std::ranges::is_sorted(ordered, {}, key_of));
        std::ranges::sort(ordered);
        EXPECT_EQ(ordered, places);
    }
    EXPECT_GT(named, 50u);
}

TEST(ObjectLevels, warm_it_allocates_nothing) {
    const World world;
    ObjectLevels levels(world.chains, world.objects);
    LevelOptions options;
    options.costs = {1.0, 0.0, 100.0};
    std::vector<FramePlan> plans;
    for (int frame = 0; frame < 20; ++frame) plans.push_back(world.plan(world.input(frame)));
    std::vector<FramePlan> again = plans;
    std::vector<std::uint32_t> places(kObjects);
    const auto choose = [&](std::vector<FramePlan>& of) {
        for (std::size_t frame = 0; frame < of.size(); ++frame) {
            options.budget_ns = frame % 2 == 0 ? 1e5 : std::numeric_limits<double>::infinity();
            FrameInput input = world.input(static_cast<double>(frame));
            levels.choose(input, options, of[frame]);
            levels.choose_at_once(input, options, of[frame]);
            places.resize(of[frame].conditional_objects.size());
            std::iota(places.begin(), places.end(), 0u);
            levels.choose_late(input, of[frame], places);
        }
    };
    for (FramePlan& plan : again) plan.object_levels.reserve(kObjects);
    choose(plans);
    choose(plans);
    const long before = allocations();
    choose(again);
    EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace rhview
