// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A bounding volume hierarchy over many boxes, culled without a stack.
///
/// The hierarchy puts the boxes in an order in which every subtree is contiguous: what is visible comes out
/// as ranges of that order, a subtree inside the frustum as one of them. An engine that keeps its objects in
/// this order draws from the ranges as they are. The visible boxes are those of `cull_boxes`, exactly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/ids.h"
#include "rhview/frustum/box_batch.h"

namespace rhview {

/// Where a node's boxes are divided.
enum class HierarchySplit {
    Mean,         ///< at the mean of their centres, on the axis on which these spread most
    Median,       ///< half of them on each side, on that axis
    SurfaceArea,  ///< where surface times boxes is least, of 16 places on each axis
};

/// The shape of the tree; any gives the same answers.
struct HierarchyOptions {
    HierarchySplit split = HierarchySplit::SurfaceArea;
    std::uint32_t width = 2;            ///< children of a node, at most; 2 to 8
    std::uint32_t max_leaf_boxes = 64;  ///< 1 to 64: tested by one call of the vector loop
};

/// Boxes [first, first + count) of `BoxHierarchy::order`.
struct OrderRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;

    friend bool operator==(const OrderRange&, const OrderRange&) = default;
};

/// Nodes stand in depth-first order: a node's first child follows it, and what follows its subtree stands at
/// `escape`.
struct HierarchyNode {
    Aabb bounds;
    std::uint32_t escape = 0;
    std::uint32_t first = 0;  ///< of the order
    std::uint32_t count = 0;
    std::uint32_t depth = 0;  ///< below 64
};

/// What a culling cost.
struct HierarchyVisits {
    std::uint64_t nodes = 0;
    std::uint64_t boxes = 0;  ///< tested one by one, in leaves
};

/// A tree over boxes, culled from the root down; built once, refitted when boxes move.
class BoxHierarchy {
  public:
    BoxHierarchy() = default;
    /// Box i is `ObjectId{i}`. Deterministic: ties by id. Boxes with NaN, without end or with min > max are
    /// held too; they make every node above them endless. Cost: O(n log n), about 0.5 µs per box.
    explicit BoxHierarchy(std::span<const Aabb> boxes, const HierarchyOptions& options = {});

    /// Box of place i of the order: `boxes` there.
    [[nodiscard]] std::span<const ObjectId> order() const { return order_; }
    [[nodiscard]] std::span<const HierarchyNode> nodes() const { return nodes_; }
    [[nodiscard]] BoxSpans boxes() const { return boxes_.spans(); }  ///< in the order

    /// Takes new boxes of the same objects, by id, and keeps the tree: right whatever moved, slower where
    /// neighbours parted. Cost: all boxes are compared in a row, with those that are held; what moved, and
    /// the nodes above it, is taken. No allocation.
    void refit(std::span<const Aabb> boxes);

    /// Replaces `visible` by the ranges that are not outside, in order, with gaps between them. A plane that
    /// a node is inside of is not tested below. No allocation after warm-up. Thread-safe. Source: Smits,
    /// "Efficiency issues for ray tracing", 1998 (escape indices); Assarsson & Möller 2000.
    HierarchyVisits cull(const Frustum& frustum, std::vector<OrderRange>& visible) const;

  private:
    friend class HierarchyBuilder;

    void find_places();
    bool take_moved(std::span<const Aabb> boxes);
    void take(std::size_t object, const Aabb& box);
    void refit_marked();

    std::vector<HierarchyNode> nodes_;
    std::vector<ObjectId> order_;
    BoxArrays boxes_;
    std::vector<Aabb> known_;           ///< by id: what the tree holds
    std::vector<std::uint32_t> place_;  ///< by id, in the order
    std::vector<std::uint32_t> leaf_;   ///< by id, its node
    std::vector<std::uint8_t> marked_;  ///< by node: has to be refitted
};

}  // namespace rhview
