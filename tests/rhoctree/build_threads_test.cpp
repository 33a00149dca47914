// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The build on several threads, its progress, and stopping it.

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <bit>

#include "random_geometry.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {
namespace {

/// FNV-1a over every value of the octree.
std::uint64_t hash_of(const RhOctree& octree) {
    std::uint64_t hash = 0xcbf29ce484222325ull;
    const auto add = [&](std::uint64_t value) { hash = (hash ^ value) * 0x100000001b3ull; };
    const auto add_vector = [&](const glm::vec3& v) {
        for (glm::length_t i = 0; i < 3; ++i) add(std::bit_cast<std::uint32_t>(v[i]));
    };
    for (std::uint32_t i = 0; i < octree.nodes().size(); ++i) {
        const OctreeNode& node = octree.nodes()[i];
        add_vector(node.bounds.min);
        add_vector(node.bounds.max);
        for (const std::uint32_t value : {node.end, node.triangle_count, node.first_piece, node.piece_end,
                                          node.first_replica, node.replica_end})
            add(value);
        for (const DrawRange& range : octree.ranges(NodeId{i}))
            for (const std::size_t value :
                 {index_of(range.batch), std::size_t{range.first_index}, std::size_t{range.index_count}})
                add(value);
    }
    for (const OctreePiece& piece : octree.pieces()) {
        add_vector(piece.bounds.min);
        add_vector(piece.bounds.max);
        for (const std::uint32_t value :
             {piece.first_index, piece.index_count, piece.first_cluster, piece.cluster_count})
            add(value);
    }
    for (const OctreeReplica& replica : octree.replicas())
        for (const std::uint32_t value : {static_cast<std::uint32_t>(replica.node), replica.first_index,
                                          replica.index_count, replica.first_cluster, replica.cluster_count})
            add(value);
    for (const NormalCluster& cluster : octree.clusters()) {
        add_vector(cluster.facing.apex);
        add_vector(cluster.facing.axis);
        add(std::bit_cast<std::uint32_t>(cluster.facing.cutoff));
        add(std::bit_cast<std::uint32_t>(cluster.facing.reach));
        add(cluster.index_count);
    }
    for (const std::uint32_t index : octree.indices()) add(index);
    return hash;
}

/// Many batches with many triangles in one place and a few far away: buckets of very different sizes.
RandomGeometry uneven_geometry() {
    RandomGeometry geometry(21, 7, 20'000);
    for (std::size_t i = 0; i < geometry.positions.size(); ++i)
        if (i % 50'000 > 300) geometry.positions[i] *= 0.01f;
    return geometry;
}

TEST(OctreeBuildThreads, any_number_of_threads_builds_the_same_octree) {
    const RandomGeometry geometry = uneven_geometry();
    const std::vector<TriangleBatch> batches = geometry.batches();
    const tbb::global_control more_than_cores(tbb::global_control::max_allowed_parallelism, 8);
    std::vector<OctreeOptions> options{{.max_leaf_triangles = 1}, {.max_leaf_triangles = 300}};
    options.push_back(choose_octree_options({.index_ns = 1.0, .draw_ns = 2000.0}, 420'000, 7));
    options.back().count_leaf_per_batch = true;
    for (const OctreeOptions& option : options) {
        std::vector<std::uint64_t> hashes;
        for (const int threads : {1, 2, 3, 8}) {
            tbb::task_arena arena(threads);
            arena.execute([&] { hashes.push_back(hash_of(build_octree(batches, option).value())); });
        }
        for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes[0]);
    }
}

TEST(OctreeBuildThreads, errors_name_the_first_bad_triangle_whatever_the_number_of_threads) {
    RandomGeometry geometry(22, 2, 100'000);
    geometry.indices[1][3 * 90'000 + 1] = 0xffffffffu;
    geometry.indices[1][3 * 70'001] = 600'000;
    geometry.indices[1][3 * 99'999 + 2] = 0xffffffffu;
    const tbb::global_control more_than_cores(tbb::global_control::max_allowed_parallelism, 3);
    for (const int threads : {1, 3}) {
        tbb::task_arena arena(threads);
        arena.execute([&] {
            EXPECT_EQ(build_octree(geometry.batches()).error().message,
                      "batch 1, triangle 70001: index 600000 is out of range (600000 vertices)");
        });
    }
}

TEST(OctreeBuildThreads, progress_rises_from_0_to_1) {
    const RandomGeometry geometry = uneven_geometry();
    std::vector<double> told;
    OctreeOptions options{.max_leaf_triangles = 100};
    options.replica_budget = 1.0;
    options.progress = [&](double done) {
        told.push_back(done);
        return true;
    };
    ASSERT_TRUE(build_octree(geometry.batches(), options).ok());
    ASSERT_GT(told.size(), 20u);
    EXPECT_EQ(told.front(), 0.0);
    EXPECT_NEAR(told.back(), 1.0, 1e-9);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
}

TEST(OctreeBuildThreads, a_stopped_build_returns_an_error_from_wherever_it_is) {
    const RandomGeometry geometry = uneven_geometry();
    for (const double stop : {0.0, 0.1, 0.3, 0.5, 0.7, 0.85}) {
        OctreeOptions options{.max_leaf_triangles = 100};
        options.replica_budget = 1.0;
        int asked_after = 0;
        bool stopped = false;
        options.progress = [&](double done) {
            asked_after += stopped ? 1 : 0;
            stopped = stopped || done >= stop;
            return !stopped;
        };
        const Result<RhOctree> octree = build_octree(geometry.batches(), options);
        ASSERT_FALSE(octree.ok()) << stop;
        EXPECT_EQ(octree.error().message, "the build was stopped before it was done");
        EXPECT_EQ(asked_after, 0);
    }
}

}  // namespace
}  // namespace rhview
