// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Pieces, clusters and replicas as the build leaves them.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "balls.h"
#include "rhview/rhoctree/normal_clusters.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

std::vector<Triangle> sorted_triangles(std::span<const std::uint32_t> indices) {
    std::vector<Triangle> result;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        result.push_back({indices[i], indices[i + 1], indices[i + 2]});
    std::ranges::sort(result);
    return result;
}

DrawRange range_of(const RhOctree& octree, NodeId node, BatchId batch) {
    const auto ranges = octree.ranges(node);
    return *std::ranges::find(ranges, batch, &DrawRange::batch);
}

RhOctree octree_of(const Balls& balls, std::uint32_t leaf, std::uint32_t record, double budget) {
    OctreeOptions options;
    options.max_leaf_triangles = leaf;
    options.min_record_indices = record;
    options.replica_budget = budget;
    options.costs = {100, 30000, 0};
    return build_octree(balls.batches(), options).value();
}

TEST(OctreePieces, cover_each_batch_in_base_order_and_stand_with_their_nodes) {
    const Balls balls(111, 3, 60, 150);
    for (const std::uint32_t record : {0u, 40u, 400u}) {
        const RhOctree octree = octree_of(balls, 25, record, 0.0);
        std::vector<std::uint32_t> next;
        std::uint32_t first = 0;
        for (const auto& indices : balls.indices) {
            next.push_back(first);
            first += static_cast<std::uint32_t>(indices.size());
        }
        for (const OctreePiece& piece : octree.pieces()) {
            std::uint32_t& expected = next[index_of(piece.batch)];
            EXPECT_EQ(piece.first_index, expected);
            expected += piece.index_count;
            std::uint32_t in_clusters = 0;
            for (const NormalCluster& cluster :
                 octree.clusters().subspan(piece.first_cluster, piece.cluster_count))
                in_clusters += cluster.index_count;
            EXPECT_EQ(in_clusters, piece.index_count);
        }
        first = 0;
        for (std::size_t b = 0; b < balls.indices.size(); ++b) {
            first += static_cast<std::uint32_t>(balls.indices[b].size());
            EXPECT_EQ(next[b], first);
        }
        for (std::uint32_t id = 0; id < octree.nodes().size(); ++id) {
            const OctreeNode& node = octree.nodes()[id];
            const bool leaf = octree.is_leaf(NodeId{id});
            const std::uint32_t own_end = leaf ? node.piece_end : octree.nodes()[id + 1].first_piece;
            for (std::uint32_t p = node.first_piece; p < own_end; ++p) {
                const OctreePiece& piece = octree.pieces()[p];
                const DrawRange range = range_of(octree, NodeId{id}, piece.batch);
                EXPECT_EQ(range.first_index, piece.first_index);
                EXPECT_EQ(range.index_count, piece.index_count);
                EXPECT_TRUE(leaf || piece.index_count <= record);
                EXPECT_TRUE(leaf || piece.cluster_count == 1);
            }
            const bool last = node.end == octree.nodes().size();
            EXPECT_EQ(node.piece_end, last ? octree.pieces().size() : octree.nodes()[node.end].first_piece);
        }
    }
}

TEST(OctreePieces, clusters_face_away_only_if_each_of_their_triangles_does) {
    const Balls balls(112, 3, 40, 200);
    const RhOctree octree = octree_of(balls, 60, 30, 1.0);
    const std::vector<TriangleBatch> batches = balls.batches();
    Uniform uniform(113);
    std::size_t away = 0;
    const auto check = [&](BatchId batch, std::uint32_t first, std::uint32_t first_cluster,
                           std::uint32_t cluster_count, const Viewpoint& viewpoint) {
        for (const NormalCluster& cluster : octree.clusters().subspan(first_cluster, cluster_count)) {
            if (faces_away(cluster.facing, viewpoint)) {
                ++away;
                ASSERT_FALSE(batches[index_of(batch)].two_sided);
                for (std::uint32_t i = 0; i < cluster.index_count; i += 3) {
                    const std::uint32_t* corner = octree.indices().data() + first + i;
                    const glm::vec3& a = balls.positions[corner[0]];
                    const glm::dvec3 normal =
                        face_normal(a, balls.positions[corner[1]], balls.positions[corner[2]]);
                    EXPECT_LT(glm::dot(normal, viewpoint.point - glm::dvec3(a)), 0.0);
                }
            }
            first += cluster.index_count;
        }
    };
    for (int i = 0; i < 20; ++i) {
        Viewpoint viewpoint;
        viewpoint.kind = Viewpoint::Kind::Point;
        viewpoint.point = uniform.point(120.0);
        for (const OctreePiece& piece : octree.pieces())
            check(piece.batch, piece.first_index, piece.first_cluster, piece.cluster_count, viewpoint);
        for (const OctreeReplica& replica : octree.replicas())
            check(replica.batch, replica.first_index, replica.first_cluster, replica.cluster_count,
                  viewpoint);
    }
    EXPECT_GT(away, 1000u);
}

TEST(OctreePieces, without_normal_order_a_leaf_keeps_the_sources_order) {
    const Balls balls(114, 2, 20, 200);
    OctreeOptions options;
    options.max_leaf_triangles = 50;
    options.normal_order = false;
    options.replica_budget = 1.0;
    const RhOctree octree = build_octree(balls.batches(), options).value();
    EXPECT_TRUE(octree.replicas().empty());
    for (const OctreePiece& piece : octree.pieces()) {
        ASSERT_EQ(piece.cluster_count, 1u);
        EXPECT_GT(octree.clusters()[piece.first_cluster].facing.cutoff, 1.0f);
        const auto indices = octree.indices().subspan(piece.first_index, piece.index_count);
        EXPECT_TRUE(std::ranges::is_sorted(indices));  // Balls numbers its corners in source order.
    }
}

TEST(OctreeReplicas, hold_their_nodes_triangles_unrotated_and_are_never_nested) {
    const Balls balls(115, 3, 60, 300);
    const RhOctree octree = octree_of(balls, 40, 30, 1.0);
    ASSERT_GT(octree.replicas().size(), 5u);
    std::uint32_t next = static_cast<std::uint32_t>(octree.base_index_count());
    std::vector<std::uint32_t> covered_until(3, 0);
    for (const OctreeReplica& replica : octree.replicas()) {
        EXPECT_EQ(replica.first_index, next);
        next += replica.index_count;
        const DrawRange base = range_of(octree, replica.node, replica.batch);
        EXPECT_EQ(replica.index_count, base.index_count);
        EXPECT_EQ(sorted_triangles(octree.indices().subspan(replica.first_index, replica.index_count)),
                  sorted_triangles(octree.indices().subspan(base.first_index, base.index_count)));
        std::uint32_t& covered = covered_until[index_of(replica.batch)];
        EXPECT_GE(index_of(replica.node), covered);
        covered = octree.node(replica.node).end;
        EXPECT_FALSE(octree.is_leaf(replica.node));
        EXPECT_NE(replica.batch, BatchId{2}) << "the two-sided one";
    }
    EXPECT_EQ(next, octree.indices().size());
    for (std::uint32_t id = 0; id < octree.nodes().size(); ++id) {
        const OctreeNode& node = octree.nodes()[id];
        for (std::uint32_t r = 0; r < octree.replicas().size(); ++r) {
            const bool inside = r >= node.first_replica && r < node.replica_end;
            const std::size_t at = index_of(octree.replicas()[r].node);
            EXPECT_EQ(inside, at >= id && at < node.end);
        }
    }
}

TEST(OctreeReplicas, keep_within_their_budget_and_save_the_most_first) {
    const Balls balls(116, 2, 60, 300);
    std::size_t before = 0;
    for (const double budget : {0.0, 0.1, 0.3, 1.0, 5.0}) {
        const RhOctree octree = octree_of(balls, 40, 30, budget);
        const auto limit = budget * static_cast<double>(octree.base_index_count() * sizeof(std::uint32_t));
        EXPECT_LE(static_cast<double>(octree.replica_bytes()), limit);
        EXPECT_GE(octree.replica_bytes(), before);
        // A triangle has at most one replica, whatever the budget.
        EXPECT_LE(octree.replica_bytes(), octree.base_index_count() * sizeof(std::uint32_t));
        before = octree.replica_bytes();
    }
    EXPECT_GT(before, 0u);
}

TEST(OctreeReplicas, are_chosen_for_the_views_that_the_engine_names) {
    const Balls balls(117, 1, 60, 300);
    OctreeOptions options;
    options.max_leaf_triangles = 40;
    options.replica_budget = 1.0;
    options.costs = {100, 30000, 0};
    const View away{look_along({0, 500, 0}, {0, 1, 0}, {1, 0, 0}),
                    perspective(1.0, 1.0, 1.0, 5000.0, ClipDepth::ZeroToOne), ClipDepth::ZeroToOne};
    View above = away;
    above.camera_from_world = look_along({0, 500, 0}, {0, -1, 0}, {1, 0, 0});
    options.sample_views = {&away, 1};
    EXPECT_TRUE(build_octree(balls.batches(), options).value().replicas().empty());
    options.sample_views = {&above, 1};
    EXPECT_FALSE(build_octree(balls.batches(), options).value().replicas().empty());
    // The same camera over a scene that lies elsewhere.
    options.scene_origin = {1e6, 0, 0};
    EXPECT_TRUE(build_octree(balls.batches(), options).value().replicas().empty());
}

}  // namespace
}  // namespace rhview
