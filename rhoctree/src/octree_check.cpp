// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Whoever plans with an octree follows its links without looking: from here on they are known to stay inside
// and to end. Each check may rely on those before it.

#include <algorithm>
#include <cmath>
#include <limits>

#include "morton_sort.h"
#include "octree_file.h"
#include "rhview/base/index_check.h"

namespace rhview {
namespace {

// The root, and a node a level; recursion is bounded by it.
constexpr std::size_t kMaxDepth = kMortonLevels + 1;

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_box(const Aabb& box) {
    return !box.is_empty() && is_finite(box.min) && is_finite(box.max);
}

bool is_inside(const Aabb& inner, const Aabb& outer) {
    return glm::min(inner.min, outer.min) == outer.min && glm::max(inner.max, outer.max) == outer.max;
}

class OctreeCheck {
  public:
    OctreeCheck(const RhoFile& file, const RhOctree& octree, std::span<const DrawRange> ranges,
                std::span<const OctreeBatchRecord> batches)
        : file_(file),
          octree_(octree),
          nodes_(octree.nodes()),
          ranges_(ranges),
          pieces_(octree.pieces()),
          replicas_(octree.replicas()),
          clusters_(octree.clusters()),
          batches_(batches),
          next_(batches.size()) {}

    Status run() {
        for (const auto check :
             {&OctreeCheck::check_batches, &OctreeCheck::check_links, &OctreeCheck::check_ranges,
              &OctreeCheck::check_children, &OctreeCheck::check_pieces, &OctreeCheck::check_replicas,
              &OctreeCheck::check_cones, &OctreeCheck::check_indices})
            if (Status status = (this->*check)(); !status) return status;
        return success();
    }

  private:
    [[nodiscard]] Error wrong(SectionTag tag, const char* record, std::size_t number,
                              const char* what) const {
        return file_.error(tag, std::string(record) + " " + std::to_string(number) + ": " + what);
    }
    [[nodiscard]] Error wrong_node(std::size_t node, const char* what) const {
        return wrong(kOctreeNodes, "node", node, what);
    }

    /// Batches share the base order out among themselves, without gaps.
    Status check_batches() {
        std::uint64_t next = 0;
        for (std::size_t b = 0; b < batches_.size(); ++b) {
            if (batches_[b].first_index != next) return wrong(kOctreeBatches, "batch", b, "it leaves a gap");
            if (batches_[b].index_count % 3 != 0)
                return wrong(kOctreeBatches, "batch", b, "its index count is no multiple of three");
            next += batches_[b].index_count;
        }
        if (next != octree_.base_index_count())
            return file_.error(kOctreeBatches, "the batches don't make up the base order");
        if (octree_.indices().size() < next ||
            octree_.indices().size() > std::numeric_limits<std::uint32_t>::max())
            return file_.error(kOctreeIndices, "it is shorter than the base order, or has 2^32 indices");
        if (nodes_.empty() != (next == 0) || nodes_.size() > std::numeric_limits<std::uint32_t>::max())
            return file_.error(kOctreeNodes, "there are triangles without nodes, or nodes without triangles");
        return success();
    }

    /// Subtrees are nested, not deeper than levels; boxes are finite and inside their parent's.
    Status check_links() {
        std::vector<std::uint32_t> open;  // ancestors of the node
        std::size_t leaves = 0;
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            const OctreeNode& node = nodes_[i];
            while (!open.empty() && nodes_[open.back()].end == i) open.pop_back();
            if (open.empty() && i > 0) return wrong_node(i, "it belongs to no subtree");
            if (node.end <= i) return wrong_node(i, "its subtree ends before it begins");
            if (node.end > (open.empty() ? nodes_.size() : nodes_[open.back()].end))
                return wrong_node(i, "its subtree leaves its parent's");
            if (!is_box(node.bounds)) return wrong_node(i, "its box is none");
            if (!open.empty() && !is_inside(node.bounds, nodes_[open.back()].bounds))
                return wrong_node(i, "its box leaves its parent's");
            leaves += node.end == i + 1;
            open.push_back(i);
            if (open.size() > kMaxDepth) return wrong_node(i, "it is deeper than an octree can be");
        }
        if (leaves != octree_.leaf_count())
            return file_.error(kOctreeNodes, "it holds another number of leaves than section OINF says");
        return success();
    }

    /// Ranges are there, by batch, inside their batch, and as many as the node's triangles.
    Status check_ranges() {
        std::uint64_t used = 0;
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            const OctreeNode& node = nodes_[i];
            if (node.range_count == 0 || node.first_range > ranges_.size() ||
                node.range_count > ranges_.size() - node.first_range)
                return wrong_node(i, "its ranges are not in section ORNG");
            std::uint64_t indices = 0;
            for (std::uint32_t r = node.first_range; r < node.first_range + node.range_count; ++r) {
                const DrawRange& range = ranges_[r];
                if (index_of(range.batch) >= batches_.size() ||
                    (r > node.first_range && ranges_[r - 1].batch >= range.batch))
                    return wrong(kOctreeRanges, "range", r, "its batch is not in the list, or out of order");
                const OctreeBatchRecord& batch = batches_[index_of(range.batch)];
                if (range.index_count == 0 || range.index_count % 3 != 0 ||
                    range.first_index < batch.first_index ||
                    std::uint64_t{range.first_index} + range.index_count >
                        std::uint64_t{batch.first_index} + batch.index_count)
                    return wrong(kOctreeRanges, "range", r, "it leaves its batch or is no whole triangles");
                indices += range.index_count;
            }
            if (indices != std::uint64_t{3} * node.triangle_count)
                return wrong_node(i, "its ranges hold another number of triangles");
            used += node.range_count;
        }
        if (used != ranges_.size())
            return file_.error(kOctreeRanges, "a range belongs to two nodes, or to none");
        return success();
    }

    [[nodiscard]] std::span<const DrawRange> ranges_of(std::uint32_t node) const {
        return ranges_.subspan(nodes_[node].first_range, nodes_[node].range_count);
    }

    /// The root's ranges are whole batches, an inner node's those of its children one after the other.
    Status check_children() {
        std::uint64_t covered = 0;
        if (!nodes_.empty())
            for (const DrawRange& range : ranges_of(0)) covered += range.index_count;
        if (covered != octree_.base_index_count()) return wrong_node(0, "it does not hold all triangles");
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            if (nodes_[i].end == i + 1) continue;
            for (const DrawRange& range : ranges_of(i)) next_[index_of(range.batch)] = range.first_index;
            std::uint64_t triangles = 0;
            for (std::uint32_t child = i + 1; child < nodes_[i].end; child = nodes_[child].end) {
                for (const DrawRange& range : ranges_of(child)) {
                    if (range.first_index != next_[index_of(range.batch)])
                        return wrong_node(child, "its ranges don't follow its siblings'");
                    next_[index_of(range.batch)] += range.index_count;
                }
                triangles += nodes_[child].triangle_count;
            }
            // Every range begins where the one before ends: equal sums leave no room for a gap at the end ...
            if (triangles != nodes_[i].triangle_count) return wrong_node(i, "its children don't make it up");
            // ... unless one batch has more where another has less.
            for (const DrawRange& range : ranges_of(i))
                if (next_[index_of(range.batch)] != range.first_index + range.index_count)
                    return wrong_node(i, "its children don't make it up");
        }
        return success();
    }

    /// The node's own range of a batch; null if it has none.
    [[nodiscard]] const DrawRange* range_of(std::uint32_t node, BatchId batch) const {
        const std::span<const DrawRange> ranges = ranges_of(node);
        const auto found = std::ranges::lower_bound(ranges, batch, {}, &DrawRange::batch);
        return found != ranges.end() && found->batch == batch ? &*found : nullptr;
    }

    /// The clusters [first, first + count) are there and make up `index_count` indices.
    [[nodiscard]] const char* problem_of_clusters(std::uint32_t first, std::uint32_t count,
                                                  std::uint32_t index_count) const {
        if (count == 0 || first > clusters_.size() || count > clusters_.size() - first)
            return "its clusters are not in section OCLU";
        std::uint64_t sum = 0;
        for (const NormalCluster& cluster : clusters_.subspan(first, count)) {
            if (cluster.index_count % 3 != 0) return "a cluster of it is no whole triangles";
            sum += cluster.index_count;
        }
        return sum == index_count ? nullptr : "its clusters don't make it up";
    }

    /// A subtree's pieces are contiguous, its node's own first; each is its node's range of a batch, and a
    /// batch's pieces cover it in order.
    Status check_pieces() {
        for (std::size_t b = 0; b < batches_.size(); ++b) next_[b] = batches_[b].first_index;
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            const OctreeNode& node = nodes_[i];
            if (const char* problem = problem_of_subtree(i, node.first_piece, node.piece_end,
                                                         &OctreeNode::first_piece, pieces_.size()))
                return wrong_node(i, problem);
            for (std::uint32_t p = node.first_piece; p < own_end(i, &OctreeNode::first_piece, node.piece_end);
                 ++p)
                if (const char* problem = problem_of_piece(i, pieces_[p]))
                    return wrong(kOctreePieces, "piece", p, problem);
        }
        for (std::size_t b = 0; b < batches_.size(); ++b)
            if (next_[b] != batches_[b].first_index + batches_[b].index_count)
                return wrong(kOctreePieces, "batch", b, "its pieces don't cover it");
        return !nodes_.empty() || pieces_.empty()
                   ? success()
                   : file_.error(kOctreePieces, "there are pieces without nodes");
    }

    const char* problem_of_piece(std::uint32_t node, const OctreePiece& piece) {
        const DrawRange* const range = range_of(node, piece.batch);
        if (range == nullptr || range->first_index != piece.first_index ||
            range->index_count != piece.index_count)
            return "it is not its node's range of a batch";
        std::uint32_t& next = next_[index_of(piece.batch)];
        if (piece.first_index != next) return "it does not follow the piece before it";
        next += piece.index_count;
        if (!is_box(piece.bounds) || !is_inside(piece.bounds, nodes_[node].bounds))
            return "its box leaves its node's";
        return problem_of_clusters(piece.first_cluster, piece.cluster_count, piece.index_count);
    }

    /// Pieces and replicas alike: `first` of the node's own, `end` of the subtree's.
    [[nodiscard]] const char* problem_of_subtree(std::uint32_t node, std::uint32_t first, std::uint32_t end,
                                                 std::uint32_t OctreeNode::*first_of,
                                                 std::size_t count) const {
        const std::uint32_t after = nodes_[node].end;
        const std::size_t expected = after < nodes_.size() ? nodes_[after].*first_of : count;
        if (first > count || end != expected || first > end) return "its pieces or replicas are out of order";
        if (node == 0 && first != 0) return "pieces or replicas before it belong to no node";
        if (node + 1 < nodes_.size() &&
            (nodes_[node + 1].*first_of < first || nodes_[node + 1].*first_of > count))
            return "its pieces or replicas are out of order";
        return nullptr;
    }

    /// Where the node's own pieces or replicas end: its first child's begin there.
    [[nodiscard]] std::uint32_t own_end(std::uint32_t node, std::uint32_t OctreeNode::*first_of,
                                        std::uint32_t subtree_end) const {
        return nodes_[node].end > node + 1 ? nodes_[node + 1].*first_of : subtree_end;
    }

    /// A subtree's replicas are contiguous, its node's own first; they stand one after the other behind the
    /// base order, each as long as its node's range, and no replica of a batch is below another.
    Status check_replicas() {
        std::uint64_t next = octree_.base_index_count();
        std::vector<std::uint32_t> covered_until(batches_.size(), 0);
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            const OctreeNode& node = nodes_[i];
            if (const char* problem = problem_of_subtree(i, node.first_replica, node.replica_end,
                                                         &OctreeNode::first_replica, replicas_.size()))
                return wrong_node(i, problem);
            const std::uint32_t end = own_end(i, &OctreeNode::first_replica, node.replica_end);
            for (std::uint32_t r = node.first_replica; r < end; ++r) {
                const OctreeReplica& replica = replicas_[r];
                const DrawRange* const range = range_of(i, replica.batch);
                if (index_of(replica.node) != i || range == nullptr ||
                    range->index_count != replica.index_count)
                    return wrong(kOctreeReplicas, "replica", r, "it is not of its node's range of a batch");
                if (replica.first_index != next || next + replica.index_count > octree_.indices().size())
                    return wrong(kOctreeReplicas, "replica", r, "it does not follow the replica before it");
                next += replica.index_count;
                if (i < covered_until[index_of(replica.batch)])
                    return wrong(kOctreeReplicas, "replica", r, "it is below another one of its batch");
                covered_until[index_of(replica.batch)] = node.end;
                if (const char* problem = problem_of_clusters(replica.first_cluster, replica.cluster_count,
                                                              replica.index_count))
                    return wrong(kOctreeReplicas, "replica", r, problem);
            }
        }
        if (nodes_.empty() && !replicas_.empty())
            return file_.error(kOctreeReplicas, "there are replicas without nodes");
        if (next != octree_.indices().size())
            return file_.error(kOctreeIndices, "indices behind the last replica belong to nobody");
        return success();
    }

    Status check_cones() {
        for (std::size_t c = 0; c < clusters_.size(); ++c) {
            const FacingCone& cone = clusters_[c].facing;
            if (!is_finite(cone.apex) || !is_finite(cone.axis) || !std::isfinite(cone.reach) ||
                !std::isfinite(cone.cutoff))
                return wrong(kOctreeClusters, "cluster", c, "its cone is not finite");
        }
        return success();
    }

    /// Every index has its vertex, in the base order and in replicas.
    Status check_indices() {
        const std::span<const std::uint32_t> indices = octree_.indices();
        for (std::size_t b = 0; b < batches_.size(); ++b)
            if (!all_below(indices.subspan(batches_[b].first_index, batches_[b].index_count),
                           batches_[b].vertex_count))
                return wrong(kOctreeIndices, "batch", b, "an index is not below its number of vertices");
        for (std::size_t r = 0; r < replicas_.size(); ++r)
            if (!all_below(indices.subspan(replicas_[r].first_index, replicas_[r].index_count),
                           batches_[index_of(replicas_[r].batch)].vertex_count))
                return wrong(kOctreeIndices, "replica", r, "an index is not below its number of vertices");
        return success();
    }

    const RhoFile& file_;
    const RhOctree& octree_;
    std::span<const OctreeNode> nodes_;
    std::span<const DrawRange> ranges_;
    std::span<const OctreePiece> pieces_;
    std::span<const OctreeReplica> replicas_;
    std::span<const NormalCluster> clusters_;
    std::span<const OctreeBatchRecord> batches_;
    std::vector<std::uint32_t> next_;  ///< per batch: where the next range must begin
};

}  // namespace

Status check_octree(const RhoFile& file, const RhOctree& octree, std::span<const DrawRange> ranges,
                    std::span<const OctreeBatchRecord> batches) {
    return OctreeCheck(file, octree, ranges, batches).run();
}

}  // namespace rhview
