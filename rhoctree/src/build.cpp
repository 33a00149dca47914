// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <limits>
#include <utility>

#include "morton_sort.h"
#include "normal_order.h"
#include "replicas.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// Cuts the Morton order into nodes. Invariant: when a node is done, its triangles' indices stand in the
/// index buffer of each batch right after those of the nodes before it, so children of one parent are
/// contiguous.
class OctreeBuilder {
  public:
    OctreeBuilder(std::span<const TriangleBatch> batches, std::span<MortonTriangle> triangles,
                  const OctreeOptions& options)
        : batches_(batches),
          triangles_(triangles),
          options_(options),
          max_leaf_(std::max(options.max_leaf_triangles, 1u)) {
        std::size_t first = 0;
        for (const TriangleBatch& batch : batches) {
            scheme_.push_back(choose_scheme(batch.positions, batch.indices));
            next_index_.push_back(static_cast<std::uint32_t>(first));
            first += batch.indices.size();
        }
        octree_.indices_.own().resize(first);
        octree_.base_index_count_ = first;
        cluster_of_triangle_.resize(first / 3);
        octree_.batch_count_ = batches.size();
        slot_of_batch_.assign(batches.size(), kNoSlot);
    }

    RhOctree build() {
        if (!triangles_.empty()) add_node(0, triangles_.size(), 0);
        add_pieces();
        if (options_.replica_budget > 0.0 && options_.normal_order && !octree_.nodes_.own().empty())
            ReplicaBuilder(batches_, options_, cluster_of_triangle_, octree_).build();
        return std::move(octree_);
    }

  private:
    static constexpr std::uint32_t kNoSlot = std::numeric_limits<std::uint32_t>::max();

    void add_node(std::size_t begin, std::size_t end, int level) {
        const auto id = static_cast<std::uint32_t>(octree_.nodes_.own().size());
        octree_.nodes_.own().emplace_back();
        octree_.nodes_.own()[id].triangle_count = static_cast<std::uint32_t>(end - begin);
        // Levels that keep all triangles together make no node.
        while (level < kMortonLevels && octant(begin, level) == octant(end - 1, level)) ++level;
        if (level == kMortonLevels || is_small(begin, end)) {
            make_leaf(id, begin, end);
        } else {
            while (begin < end) {
                const std::size_t next = end_of_octant(begin, end, level);
                add_node(begin, next, level + 1);
                begin = next;
            }
            make_inner(id);
        }
    }

    /// Whether the triangles fit one leaf.
    [[nodiscard]] bool is_small(std::size_t begin, std::size_t end) {
        if (end - begin <= max_leaf_) return true;
        if (!options_.count_leaf_per_batch) return false;
        triangles_of_batch_.assign(batches_.size(), 0);
        for (const MortonTriangle& t : triangles_.subspan(begin, end - begin))
            if (++triangles_of_batch_[t.batch] > max_leaf_) return false;
        return true;
    }

    [[nodiscard]] std::uint64_t octant(std::size_t triangle, int level) const {
        return triangles_[triangle].code >> (3 * (kMortonLevels - 1 - level));
    }

    [[nodiscard]] std::size_t end_of_octant(std::size_t begin, std::size_t end, int level) const {
        const std::uint64_t value = octant(begin, level);
        const int shift = 3 * (kMortonLevels - 1 - level);
        const auto first = triangles_.begin();
        const auto found = std::partition_point(
            first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end),
            [&](const MortonTriangle& t) { return t.code >> shift == value; });
        return static_cast<std::size_t>(found - first);
    }

    void make_leaf(std::uint32_t id, std::size_t begin, std::size_t end) {
        // A leaf's order is free: the source's keeps neighbours that share vertices together, the clusters'
        // comes first where there are any.
        std::ranges::sort(triangles_.subspan(begin, end - begin), {},
                          [](const MortonTriangle& t) { return std::pair(t.batch, t.triangle); });
        Aabb bounds;
        while (begin < end) {
            std::size_t next = begin + 1;
            while (next < end && triangles_[next].batch == triangles_[begin].batch) ++next;
            add_leaf_part(triangles_.subspan(begin, next - begin), bounds);
            begin = next;
        }
        ++octree_.leaf_count_;
        finish_node(id, bounds);
    }

    /// Triangles of one batch that share a leaf, in source order.
    void add_leaf_part(std::span<const MortonTriangle> part, Aabb& bounds) {
        const std::uint32_t batch_index = part.front().batch;
        const TriangleBatch& batch = batches_[batch_index];
        std::uint32_t& next = next_index_[batch_index];
        const auto count = static_cast<std::uint32_t>(3 * part.size());
        node_ranges_.push_back({BatchId{batch_index}, next, count});
        const std::span<std::uint32_t> indices = std::span(octree_.indices_.own()).subspan(next, count);
        std::uint32_t* to = indices.data();
        for (const MortonTriangle& t : part)
            for (std::uint32_t corner = 0; corner < 3; ++corner)
                bounds.grow(batch.positions[*to++ = batch.indices[3 * std::size_t{t.triangle} + corner]]);
        if (options_.normal_order && !batch.two_sided) {
            const std::span<std::uint8_t> clusters =
                std::span(cluster_of_triangle_).subspan(next / 3, part.size());
            classify_normals(scheme_[batch_index], batch.positions, indices, clusters);
            sorter_.sort(indices, clusters);
        }
        next += count;
    }

    void make_inner(std::uint32_t id) {
        Aabb bounds;
        const auto end = static_cast<std::uint32_t>(octree_.nodes_.own().size());
        for (std::uint32_t child = id + 1; child < end; child = octree_.nodes_.own()[child].end) {
            bounds.grow(octree_.nodes_.own()[child].bounds);
            for (const DrawRange& range : octree_.ranges(NodeId{child})) add_to_range(range);
        }
        finish_node(id, bounds);
    }

    /// Hands every batch's base order out to the nodes, in pieces.
    void add_pieces() {
        // Per batch: the end of the subtree that its last piece stands for.
        std::vector<std::uint32_t> covered_until(batches_.size(), 0);
        for (std::uint32_t id = 0; id < octree_.nodes_.own().size(); ++id) {
            octree_.nodes_.own()[id].first_piece = static_cast<std::uint32_t>(octree_.pieces_.own().size());
            const bool leaf = octree_.is_leaf(NodeId{id});
            for (const DrawRange& range : octree_.ranges(NodeId{id})) {
                std::uint32_t& covered = covered_until[index_of(range.batch)];
                if (id < covered || (!leaf && range.index_count > options_.min_record_indices)) continue;
                covered = octree_.nodes_.own()[id].end;
                add_piece(id, range);
            }
        }
        for (OctreeNode& node : octree_.nodes_.own())
            node.piece_end = node.end < octree_.nodes_.own().size()
                                 ? octree_.nodes_.own()[node.end].first_piece
                                 : static_cast<std::uint32_t>(octree_.pieces_.own().size());
    }

    void add_piece(std::uint32_t id, const DrawRange& range) {
        const TriangleBatch& batch = batches_[index_of(range.batch)];
        const std::span<const std::uint32_t> indices =
            octree_.indices().subspan(range.first_index, range.index_count);
        OctreePiece piece;
        piece.bounds = octree_.nodes_.own()[id].bounds;
        if (octree_.nodes_.own()[id].range_count > 1) {
            piece.bounds = {};
            for (const std::uint32_t index : indices) piece.bounds.grow(batch.positions[index]);
        }
        piece.batch = range.batch;
        piece.first_index = range.first_index;
        piece.index_count = range.index_count;
        piece.first_cluster = static_cast<std::uint32_t>(octree_.clusters_.own().size());
        if (batch.two_sided || !options_.normal_order) {
            octree_.clusters_.own().push_back({FacingCone(), range.index_count});
        } else {
            // Over several leaves the order starts anew in each: clusters would be met again and again.
            const bool ordered = octree_.is_leaf(NodeId{id});
            append_clusters(batch.positions, indices,
                            ordered ? std::span<const std::uint8_t>(cluster_of_triangle_)
                                          .subspan(range.first_index / 3, range.index_count / 3)
                                    : std::span<const std::uint8_t>(),
                            options_.min_record_indices, octree_.clusters_.own());
        }
        piece.cluster_count =
            static_cast<std::uint32_t>(octree_.clusters_.own().size()) - piece.first_cluster;
        octree_.pieces_.own().push_back(piece);
    }

    /// Joins `range` to what the current node already has of that batch; it follows it without a gap.
    void add_to_range(const DrawRange& range) {
        std::uint32_t& slot = slot_of_batch_[index_of(range.batch)];
        if (slot == kNoSlot) {
            slot = static_cast<std::uint32_t>(node_ranges_.size());
            node_ranges_.push_back(range);
        } else {
            node_ranges_[slot].index_count += range.index_count;
        }
    }

    void finish_node(std::uint32_t id, const Aabb& bounds) {
        std::ranges::sort(node_ranges_, {}, &DrawRange::batch);
        for (const DrawRange& range : node_ranges_) slot_of_batch_[index_of(range.batch)] = kNoSlot;
        OctreeNode& node = octree_.nodes_.own()[id];
        node.bounds = bounds;
        node.end = static_cast<std::uint32_t>(octree_.nodes_.own().size());
        node.first_range = static_cast<std::uint32_t>(octree_.ranges_.own().size());
        node.range_count = static_cast<std::uint32_t>(node_ranges_.size());
        octree_.ranges_.own().insert(octree_.ranges_.own().end(), node_ranges_.begin(), node_ranges_.end());
        node_ranges_.clear();
    }

    std::span<const TriangleBatch> batches_;
    std::span<MortonTriangle> triangles_;
    OctreeOptions options_;
    std::size_t max_leaf_;
    RhOctree octree_;
    std::vector<ClusterScheme> scheme_;  ///< of each batch
    ClusterSorter sorter_;
    std::vector<std::uint8_t> cluster_of_triangle_;  ///< in base order
    std::vector<std::uint32_t> triangles_of_batch_;
    std::vector<std::uint32_t> next_index_;     ///< per batch: where its next triangle goes
    std::vector<DrawRange> node_ranges_;        ///< of the node being finished
    std::vector<std::uint32_t> slot_of_batch_;  ///< place in `node_ranges_`
};

Result<RhOctree> build_octree(std::span<const TriangleBatch> batches, const OctreeOptions& options) {
    Result<std::vector<MortonTriangle>> triangles = sort_by_morton_code(batches);
    if (!triangles) return triangles.error();
    return OctreeBuilder(batches, *triangles, options).build();
}

}  // namespace rhview
