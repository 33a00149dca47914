// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The hierarchies that CHC, CHC++ and the nested grid cull, in one form: an octree, a bounding volume
/// hierarchy of the scene's objects, or nested grids; and beside it the moving objects and instances.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/triangle_batch.h"
#include "rhview/baselines/frustum_objects.h"
#include "rhview/frustum/box_hierarchy.h"
#include "rhview/pipeline/occlusion_device.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// Nodes stand in depth-first order: a node's first child follows it, its subtree ends before `end`.
struct CullNode {
    Aabb bounds;
    std::uint32_t end = 0;
    std::uint32_t parent = 0;                          ///< of the root: itself
    std::uint32_t first_range = 0, range_count = 0;    ///< of a leaf: what is drawn
    std::uint32_t first_object = 0, object_count = 0;  ///< likewise
    std::uint32_t first_tight = 0, tight_count = 0;
};

/// Boxes of descendants that are asked about instead of a node's: down to `depth`, while their areas sum up
/// to no more than `area` times the node's. Source: Mattausch, Bittner & Wimmer 2008, section 6: 3 and 1.4.
struct TightBounds {
    std::uint32_t depth = 3;
    double area = 1.4;
    std::uint32_t most_boxes = 16;
};

/// Nodes in depth-first order over static triangles, with the moving objects beside.
class CullTree {
  public:
    /// The octree's nodes; only leaves are drawn. The octree may go afterwards.
    static CullTree of_octree(const RhOctree& octree);
    /// From nodes made by others, whose `first_range` points into `ranges`; bounds, `end` and ranges of
    /// leaves are set.
    static CullTree of_nodes(std::vector<CullNode> nodes, std::vector<DrawRange> ranges);

    /// Of all nodes, and of the objects' that follow. Until then a node has none.
    void find_tight_bounds(const TightBounds& options);
    /// Takes the boxes of moving objects and instances, by `ObjectId`: leaves of a bounding volume hierarchy
    /// of their own beside the static nodes, built when their number changes and refitted otherwise. Cost:
    /// linear in the objects. `alive`: a bit each, as `FrameInput::object_alive`; read until the next call.
    void set_objects(std::span<const Aabb> boxes, std::span<const std::uint64_t> alive = {});

    /// Node 0 is the root: of the static nodes, which follow it, and of the objects'.
    [[nodiscard]] std::span<const CullNode> nodes() const { return nodes_; }
    [[nodiscard]] bool is_leaf(std::uint32_t node) const { return nodes_[node].end == node + 1; }
    /// What drawing a leaf takes, by batch.
    [[nodiscard]] std::span<const DrawRange> ranges(std::uint32_t leaf) const {
        return std::span(ranges_).subspan(nodes_[leaf].first_range, nodes_[leaf].range_count);
    }
    /// One at most: a leaf whose object is not alive has none.
    [[nodiscard]] std::span<const ObjectId> objects(std::uint32_t leaf) const {
        const CullNode& node = nodes_[leaf];
        const auto all = std::span(objects_.order()).subspan(node.first_object, node.object_count);
        if (all.empty() || alive_.empty()) return all;
        const std::size_t object = index_of(all.front());
        return all.first((alive_[object / 64] >> (object % 64) & 1u) != 0 ? 1 : 0);
    }
    /// Nodes whose boxes together hold what the node holds.
    [[nodiscard]] std::span<const std::uint32_t> tight(std::uint32_t node) const {
        return std::span(tight_).subspan(nodes_[node].first_tight, nodes_[node].tight_count);
    }
    /// Of the static part.
    [[nodiscard]] std::uint64_t leaf_count() const;

  private:
    void add_object_nodes();
    void set_parents(std::uint32_t first);
    void append_tight(std::uint32_t first);

    std::vector<CullNode> nodes_;
    std::span<const std::uint64_t> alive_;  ///< empty: all are
    std::vector<DrawRange> ranges_;
    std::vector<std::uint32_t> tight_;
    std::uint32_t static_nodes_ = 0;  ///< with the root
    Aabb static_bounds_;
    TightBounds tight_bounds_;
    BoxHierarchy objects_;
};

/// A tree with the order of the static indices that its ranges are in: batch after batch.
struct OrderedTree {
    CullTree tree;
    std::vector<std::uint32_t> indices;
};

/// A binary hierarchy by surface area over static objects. Objects are joined to leaves of at most
/// `leaf_triangles`, which are one range per batch: the indices are put in the hierarchy's order. An object
/// is never divided. `objects` cover the indices of `batches`, in the order of these.
OrderedTree make_object_tree(std::span<const StaticObject> objects, std::span<const TriangleBatch> batches,
                             std::uint32_t leaf_triangles);

}  // namespace rhview
