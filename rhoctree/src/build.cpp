// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <limits>
#include <utility>

#include "morton_sort.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// Cuts the Morton order into nodes. Invariant: when a node is done, its triangles' indices stand in the
/// index buffer of each batch right after those of the nodes before it, so children of one parent are
/// contiguous.
class OctreeBuilder {
  public:
    OctreeBuilder(std::span<const TriangleBatch> batches, std::span<MortonTriangle> triangles,
                  const OctreeOptions& options)
        : batches_(batches), triangles_(triangles), max_leaf_(std::max(options.max_leaf_triangles, 1u)) {
        std::size_t first = 0;
        for (const TriangleBatch& batch : batches) {
            next_index_.push_back(static_cast<std::uint32_t>(first));
            first += batch.indices.size();
        }
        octree_.indices_.resize(first);
        octree_.batch_count_ = batches.size();
        slot_of_batch_.assign(batches.size(), kNoSlot);
    }

    RhOctree build() {
        if (!triangles_.empty()) add_node(0, triangles_.size(), 0);
        return std::move(octree_);
    }

  private:
    static constexpr std::uint32_t kNoSlot = std::numeric_limits<std::uint32_t>::max();

    void add_node(std::size_t begin, std::size_t end, int level) {
        const auto id = static_cast<std::uint32_t>(octree_.nodes_.size());
        octree_.nodes_.emplace_back();
        octree_.nodes_[id].triangle_count = static_cast<std::uint32_t>(end - begin);
        // Levels that keep all triangles together make no node.
        while (level < kMortonLevels && octant(begin, level) == octant(end - 1, level)) ++level;
        if (end - begin <= max_leaf_ || level == kMortonLevels) {
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
        // A leaf is drawn whole, so its order is free: the source's keeps neighbours that share vertices
        // together.
        std::ranges::sort(triangles_.subspan(begin, end - begin), {},
                          [](const MortonTriangle& t) { return std::pair(t.batch, t.triangle); });
        Aabb bounds;
        for (std::size_t i = begin; i < end; ++i) {
            const MortonTriangle& t = triangles_[i];
            const TriangleBatch& batch = batches_[t.batch];
            std::uint32_t& next = next_index_[t.batch];
            add_to_range({BatchId{t.batch}, next, 3});
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t index = batch.indices[3 * std::size_t{t.triangle} + corner];
                bounds.grow(batch.positions[index]);
                octree_.indices_[next++] = index;
            }
        }
        ++octree_.leaf_count_;
        finish_node(id, bounds);
    }

    void make_inner(std::uint32_t id) {
        Aabb bounds;
        const auto end = static_cast<std::uint32_t>(octree_.nodes_.size());
        for (std::uint32_t child = id + 1; child < end; child = octree_.nodes_[child].end) {
            bounds.grow(octree_.nodes_[child].bounds);
            for (const DrawRange& range : octree_.ranges(NodeId{child})) add_to_range(range);
        }
        finish_node(id, bounds);
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
        OctreeNode& node = octree_.nodes_[id];
        node.bounds = bounds;
        node.end = static_cast<std::uint32_t>(octree_.nodes_.size());
        node.first_range = static_cast<std::uint32_t>(octree_.ranges_.size());
        node.range_count = static_cast<std::uint32_t>(node_ranges_.size());
        octree_.ranges_.insert(octree_.ranges_.end(), node_ranges_.begin(), node_ranges_.end());
        node_ranges_.clear();
    }

    std::span<const TriangleBatch> batches_;
    std::span<MortonTriangle> triangles_;
    std::size_t max_leaf_;
    RhOctree octree_;
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
