// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "morton_sort.h"
#include "rhview/base/build_progress.h"
#include "rhview/rhoctree/normal_clusters.h"
#include "rhview/rhoctree/rhoctree.h"
#include "triangle_ids.h"
#include "vertex_cache_order.h"

namespace rhview {

/// Cuts the Morton order into nodes, step by step. What each step writes depends on nothing but the input:
/// the steps share their work out among oneTBB's threads in pieces that don't touch each other's places.
///
/// Invariant: leaves take their places in each batch's part of the index buffer in depth-first order, so
/// every node is contiguous there.
class OctreeBuilder {
  public:
    /// All outlive the builder; `triangles` are sorted for cells of `max_leaf_triangles`.
    OctreeBuilder(std::span<const TriangleBatch> batches, const TriangleIds& ids,
                  std::span<MortonTriangle> triangles, const OctreeOptions& options, BuildProgress& progress);

    void build();

    /// The octree without replicas. Only once.
    RhOctree take() { return std::move(octree_); }
    /// The normal cluster of each triangle, in base order; of ordered batches.
    [[nodiscard]] std::span<const std::uint8_t> cluster_of_triangle() const { return cluster_of_triangle_; }

  private:
    struct Cell {
        std::size_t begin = 0;  ///< into `triangles_`
        std::size_t end = 0;
    };
    /// Pieces whose clusters were bounded together.
    struct PieceChunk {
        std::vector<NormalCluster> clusters;
    };

    void choose_schemes();
    void add_node(std::size_t begin, std::size_t end, int level);
    [[nodiscard]] bool is_small(std::size_t begin, std::size_t end);
    [[nodiscard]] std::uint64_t octant(std::size_t triangle, int level) const;
    [[nodiscard]] std::size_t end_of_octant(std::size_t begin, std::size_t end, int level) const;

    void sort_leaves();
    void place_leaves();
    void fill_leaves();
    void fill_leaf(std::uint32_t leaf);
    void copy_source(std::uint32_t leaf, BatchId batch, std::span<std::uint32_t> indices) const;
    void restore_source_order(std::uint32_t leaf, BatchId batch);
    void join_children();
    void add_to_range(const DrawRange& range);
    void finish_ranges(OctreeNode& node);

    void hand_out_pieces();
    void bound_pieces();
    void bound_piece(std::uint32_t piece, std::vector<NormalCluster>& clusters);
    void bound_leaf_piece(std::uint32_t leaf, const OctreePiece& piece, std::vector<NormalCluster>& clusters);
    void order_piece(std::uint32_t piece, std::span<const NormalCluster> clusters, VertexCacheOrder& order);

    [[nodiscard]] bool is_ordered(std::uint32_t batch) const {
        return options_.normal_order && !batches_[batch].two_sided;
    }

    std::span<const TriangleBatch> batches_;
    const TriangleIds& ids_;
    std::span<MortonTriangle> triangles_;
    const OctreeOptions& options_;
    BuildProgress& progress_;
    std::size_t max_leaf_;
    RhOctree octree_;
    std::vector<OctreeNode>& nodes_;
    std::vector<DrawRange>& ranges_;
    std::vector<OctreePiece>& pieces_;
    std::vector<NormalCluster>& clusters_;
    std::vector<std::uint32_t>& indices_;
    std::vector<Cell> cells_;            ///< of each node
    std::vector<std::uint32_t> leaves_;  ///< in depth-first order
    std::vector<std::uint32_t> node_of_piece_;
    std::vector<ClusterScheme> schemes_;             ///< of each batch
    std::vector<std::uint8_t> cluster_of_triangle_;  ///< in base order
    std::vector<std::uint32_t> triangles_of_batch_;  ///< scratch
    std::vector<DrawRange> node_ranges_;             ///< of the node being finished
    std::vector<std::uint32_t> slot_of_batch_;       ///< place in `node_ranges_`
};

}  // namespace rhview
