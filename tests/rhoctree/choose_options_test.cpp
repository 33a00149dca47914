// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "rhview/rhoctree/rhoctree.h"

namespace rhview {
namespace {

constexpr std::uint64_t kIndices = 20'000'000;

TEST(ChooseOptions, dear_draws_make_coarse_leaves_and_records) {
    std::uint32_t leaf = 0, record = 0;
    for (const double draw_ns : {0.0, 10.0, 1000.0, 10'000.0, 100'000.0, 1e9}) {
        const OctreeOptions options = choose_octree_options({1.0, draw_ns, 0.0}, kIndices, 1);
        EXPECT_GE(options.max_leaf_triangles, leaf);
        EXPECT_GE(options.min_record_indices, record);
        // A leaf can hold several records.
        EXPECT_LT(options.min_record_indices, 3 * options.max_leaf_triangles / 2);
        leaf = options.max_leaf_triangles;
        record = options.min_record_indices;
    }
    EXPECT_EQ(leaf, 16384u);
    EXPECT_EQ(record, 6144u);
}

TEST(ChooseOptions, cheap_indices_and_large_batches_make_coarse_leaves) {
    const auto leaf = [](double index_ns, std::size_t batches) {
        return choose_octree_options({index_ns, 0.0, 0.0}, kIndices, batches).max_leaf_triangles;
    };
    EXPECT_GT(leaf(0.1, 1), leaf(0.25, 1));
    EXPECT_GT(leaf(0.1, 1), leaf(0.1, 100));
    EXPECT_EQ(leaf(100.0, 1), 2048u);
    EXPECT_EQ(leaf(100.0, 0), 2048u);
}

TEST(ChooseOptions, free_indices_and_free_draws_are_answered_too) {
    for (const DrawCosts& costs : {DrawCosts{0, 1, 0}, DrawCosts{0, 0, 0}}) {
        const OctreeOptions options = choose_octree_options(costs, kIndices, 1);
        EXPECT_EQ(options.max_leaf_triangles, 16384u);
        EXPECT_EQ(options.min_record_indices, 6144u);
    }
    const OctreeOptions options = choose_octree_options({0.25, 2000, 7}, 0, 0);
    EXPECT_EQ(options.costs, (DrawCosts{0.25, 2000, 7}));
    EXPECT_EQ(options.replica_budget, 1.0);
    EXPECT_TRUE(options.normal_order);
}

}  // namespace
}  // namespace rhview
