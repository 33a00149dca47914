// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The replicated octree over static triangles: an order of the indices in which every node is one contiguous
/// range per batch, and second copies of some nodes' indices, ordered by normal.
///
/// Every triangle belongs to exactly one leaf, by its centroid, or by the middle of its object's box where
/// `TriangleBatch::objects` names one that fits into a leaf, which then is not divided. Node boxes are
/// refitted to their triangles, so they may overlap. Vertices stay where the engine has them. Shared and
/// const once built: any number of views may read it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "rhview/base/aabb.h"
#include "rhview/base/ids.h"
#include "rhview/base/mappable_array.h"
#include "rhview/base/result.h"
#include "rhview/base/triangle_batch.h"
#include "rhview/base/view.h"
#include "rhview/rhoctree/draw_costs.h"
#include "rhview/rhoctree/facing.h"

namespace rhview {

/// How fine, and with how many second copies. `choose_octree_options` fills it from prices.
struct OctreeOptions {
    /// A node with more triangles is split, unless all their centroids share one cell of the finest grid. 0
    /// counts as 1.
    std::uint32_t max_leaf_triangles = 4096;
    /// Leaves are bounded by the triangles of one batch instead of all together: what a draw call can hold.
    bool count_leaf_per_batch = false;
    /// Order a leaf's triangles by normal, so that those turned away are skipped or cut off. Never those of
    /// two-sided batches.
    bool normal_order = true;
    /// Records (pieces and normal clusters) of fewer indices are joined to their neighbours where that can
    /// be.
    std::uint32_t min_record_indices = 0;
    /// Replicas' bytes, as a multiple of the base order's. 0: none.
    double replica_budget = 0.0;
    /// What replicas are chosen by.
    DrawCosts costs{};
    /// The cameras that replicas are chosen for, of a scene whose zero is at `scene_origin`; empty: some in
    /// front of random triangles.
    std::span<const View> sample_views{};
    glm::dvec3 scene_origin{0.0};
    /// Called now and then with the share of the build that is done, 0 to 1 and never falling, by any of the
    /// build's threads but one at a time. False stops the build, which then returns an error.
    std::function<bool(double)> progress{};
};

/// Part of the octree's index buffer that one batch draws.
struct DrawRange {
    BatchId batch{};
    std::uint32_t first_index = 0;  ///< into `RhOctree::indices`
    std::uint32_t index_count = 0;

    friend bool operator==(const DrawRange&, const DrawRange&) = default;
};

/// Triangles of one batch whose normals are alike, next to one another in the index buffer.
struct NormalCluster {
    FacingCone facing;
    std::uint32_t index_count = 0;
};

/// The finest part of the base order that draw lists tell apart: one batch's triangles in a leaf, or in an
/// inner node where they are too few to be divided further. The pieces of a batch stand in base order and
/// cover it.
struct OctreePiece {
    Aabb bounds;  ///< of its triangles
    BatchId batch{};
    std::uint32_t first_index = 0;  ///< into `RhOctree::indices`
    std::uint32_t index_count = 0;
    std::uint32_t first_cluster = 0;  ///< its clusters follow one another in the index buffer and cover it
    std::uint32_t cluster_count = 0;  ///< at least one
};

/// A second copy of a node's indices of one batch, ordered by normal over the whole node. Stands behind the
/// base order. No replica of a batch lies below another one's node.
struct OctreeReplica {
    NodeId node{};
    BatchId batch{};
    std::uint32_t first_index = 0;  ///< into `RhOctree::indices`
    std::uint32_t index_count = 0;
    std::uint32_t first_cluster = 0;
    std::uint32_t cluster_count = 0;
};

/// Nodes stand in depth-first order: a node's first child follows it, its subtree ends before `end`.
/// Pieces and replicas stand in the order of their nodes, so a subtree's are contiguous, the node's own
/// first.
struct OctreeNode {
    Aabb bounds;  ///< of its triangles
    std::uint32_t end = 0;
    std::uint32_t first_range = 0;
    std::uint32_t range_count = 0;  ///< one per batch that has triangles here
    std::uint32_t triangle_count = 0;
    std::uint32_t first_piece = 0;
    std::uint32_t piece_end = 0;  ///< of the subtree
    std::uint32_t first_replica = 0;
    std::uint32_t replica_end = 0;  ///< of the subtree
};

/// What `build_octree` gives. Copying copies the arrays, unless they lie in a mapped file.
class RhOctree {
  public:
    [[nodiscard]] std::span<const OctreeNode> nodes() const { return nodes_.span(); }
    [[nodiscard]] const OctreeNode& node(NodeId id) const { return nodes_[index_of(id)]; }
    [[nodiscard]] bool is_leaf(NodeId id) const { return nodes_[index_of(id)].end == index_of(id) + 1; }
    /// The node's triangles, one contiguous range per batch, by batch id.
    [[nodiscard]] std::span<const DrawRange> ranges(NodeId id) const {
        return ranges_.span().subspan(node(id).first_range, node(id).range_count);
    }
    /// Those of all nodes: `OctreeNode::first_range` counts in them.
    [[nodiscard]] std::span<const DrawRange> all_ranges() const { return ranges_.span(); }
    /// The index buffer to draw from. In base order first: batch after batch, leaves in depth-first order;
    /// then the replicas. Index values are the batch's own, into its `positions`. A triangle's three indices
    /// keep their order, so that depths agree to the last bit with the source's.
    [[nodiscard]] std::span<const std::uint32_t> indices() const { return indices_.span(); }
    /// Those of the base order: as many as the batches have.
    [[nodiscard]] std::size_t base_index_count() const { return base_index_count_; }
    [[nodiscard]] std::span<const OctreePiece> pieces() const { return pieces_.span(); }
    [[nodiscard]] std::span<const OctreeReplica> replicas() const { return replicas_.span(); }
    [[nodiscard]] std::span<const NormalCluster> clusters() const { return clusters_.span(); }
    [[nodiscard]] std::size_t batch_count() const { return batch_count_; }
    [[nodiscard]] std::size_t leaf_count() const { return leaf_count_; }
    /// Of the index buffer, what replicas take.
    [[nodiscard]] std::size_t replica_bytes() const {
        return (indices_.size() - base_index_count_) * sizeof(std::uint32_t);
    }

  private:
    friend class OctreeBuilder;
    friend class OctreeFile;
    friend class ReplicaBuilder;

    MappableArray<OctreeNode> nodes_;
    MappableArray<DrawRange> ranges_;
    MappableArray<OctreePiece> pieces_;
    MappableArray<OctreeReplica> replicas_;
    MappableArray<NormalCluster> clusters_;
    MappableArray<std::uint32_t> indices_;
    std::size_t base_index_count_ = 0;
    std::size_t batch_count_ = 0;
    std::size_t leaf_count_ = 0;
};

/// Options for the cheapest draw lists (`DrawListSolver`) at these costs, for `batch_count` batches with
/// `index_count` indices in all. Leaves are as fine as what they cut off is worth their planning, and hold
/// half a draw's worth of indices at least; records are joined up to an eighth of a draw; replicas may take
/// as much memory as the base order. Derivation: src/choose_options.cpp.
OctreeOptions choose_octree_options(const DrawCosts& costs, std::uint64_t index_count,
                                    std::size_t batch_count);

/// Builds the octree of `batches`; batch i is `BatchId{i}`. No batch, or batches without triangles, give no
/// node. Deterministic. Errors name the batch and triangle: an index out of range, a corner that is not
/// finite, an index count that is no multiple of three, objects that overlap or have no box, more than
/// 2^32 - 1 indices, or a build that was stopped. Threads: oneTBB's, as many as the caller's arena has; the
/// octree is the same with any number. Cost: O(n) in triangles (radix sort), 32 bytes of scratch per
/// triangle; with replicas O(n log n), see docs/draw-list.md.
Result<RhOctree> build_octree(std::span<const TriangleBatch> batches, const OctreeOptions& options = {});

}  // namespace rhview
