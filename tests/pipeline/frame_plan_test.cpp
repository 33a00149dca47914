// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/frame_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

namespace rhview {
namespace {

TEST(FramePlan, hash_is_the_published_one_and_tells_plans_apart) {
    // FNV-1a of four zero bytes: the number of ranges of an empty plan.
    EXPECT_EQ(plan_hash({}), 0x4d25767f9dce13f5ull);
    FramePlan plan;
    plan.opaque = {{BatchId{0}, 0, 3}, {BatchId{0}, 6, 3}};
    FramePlan swapped = plan;
    std::swap(swapped.opaque[0], swapped.opaque[1]);
    FramePlan with_object = plan;
    with_object.objects = {ObjectId{0}};
    EXPECT_NE(plan_hash(plan), plan_hash({}));
    EXPECT_NE(plan_hash(plan), plan_hash(swapped));
    EXPECT_NE(plan_hash(plan), plan_hash(with_object));
    FramePlan other_counts = plan;
    other_counts.chosen = {1, 2, 3};
    other_counts.nodes_visited = 9;
    EXPECT_EQ(plan_hash(plan), plan_hash(other_counts));
    EXPECT_NE(plan_hash(plan, plan_hash(plan)), plan_hash(plan));
}

TEST(FramePlan, hash_covers_levels_of_detail) {
    FramePlan plan;
    plan.objects = {ObjectId{0}, ObjectId{1}};
    plan.conditional_objects = {{ObjectId{2}, 0, 0}};
    FramePlan coarse = plan, conditional = plan;
    coarse.object_levels = {0, 1};
    conditional.conditional_objects[0].level = 1;
    EXPECT_NE(plan_hash(plan), plan_hash(coarse));
    EXPECT_NE(plan_hash(plan), plan_hash(conditional));
    EXPECT_EQ(plan.level_of_object(1), 0);
    EXPECT_EQ(coarse.level_of_object(1), 1);
    coarse.clear();
    EXPECT_TRUE(coarse.object_levels.empty());
}

TEST(ObjectSorter, sorts_by_group_and_level_and_keeps_ids_in_order_within) {
    std::mt19937 random(8);
    ObjectSorter sorter;
    std::vector<std::uint32_t> groups(500);
    for (std::uint32_t& group : groups)
        group = random() % 7 == 0 ? 1000u : static_cast<std::uint32_t>(random() % 5);
    FramePlan plan;
    for (std::uint32_t i = 0; i < 600; ++i) {
        if (random() % 3 == 0) {
            plan.conditional_objects.push_back({ObjectId{i}, static_cast<std::uint32_t>(random() % 9),
                                                static_cast<std::uint8_t>(random() % 4)});
            continue;
        }
        plan.objects.push_back(ObjectId{i});
        plan.object_levels.push_back(static_cast<std::uint8_t>(random() % 4));
    }
    const auto group_of = [&](ObjectId id) {
        return index_of(id) < groups.size() ? groups[index_of(id)] : 0u;
    };
    using Key = std::tuple<std::uint32_t, std::uint8_t, ObjectId>;
    std::vector<Key> expected;
    for (std::size_t i = 0; i < plan.objects.size(); ++i)
        expected.emplace_back(group_of(plan.objects[i]), plan.object_levels[i], plan.objects[i]);
    std::ranges::sort(expected);
    std::vector<ConditionalObject> conditional = plan.conditional_objects;
    std::ranges::sort(conditional, {}, [&](const ConditionalObject& object) {
        return Key(group_of(object.object), object.level, object.object);
    });
    sorter.sort(groups, plan);
    std::vector<Key> sorted;
    for (std::size_t i = 0; i < plan.objects.size(); ++i)
        sorted.emplace_back(group_of(plan.objects[i]), plan.object_levels[i], plan.objects[i]);
    EXPECT_EQ(sorted, expected);
    EXPECT_EQ(plan.conditional_objects, conditional);
    FramePlan ids;
    ids.objects = {ObjectId{3}, ObjectId{1}};
    sorter.sort({}, ids);
    EXPECT_EQ(ids.objects, (std::vector{ObjectId{3}, ObjectId{1}}));
    EXPECT_TRUE(ids.object_levels.empty());
}

TEST(BatchSorter, sorts_by_batch_and_keeps_the_order_within) {
    std::mt19937 random(3);
    BatchSorter sorter;
    for (const std::size_t batch_count : {1u, 2u, 84u}) {
        std::vector<DrawRange> ranges;
        for (std::uint32_t i = 0; i < 1000; ++i)
            ranges.push_back({BatchId{static_cast<std::uint32_t>(random() % batch_count)}, i, 3});
        std::vector<DrawRange> expected = ranges;
        std::ranges::stable_sort(expected, {}, &DrawRange::batch);
        sorter.sort(ranges, batch_count);
        EXPECT_EQ(ranges, expected);
    }
    std::vector<DrawRange> none;
    sorter.sort(none, 5);
    EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace rhview
