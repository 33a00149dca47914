// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/frame_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

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
