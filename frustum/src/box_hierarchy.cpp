// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Culling is exact with regard to `cull_boxes`: a node's box contains those below it, and each operation of
// the test is monotone in the box's corners, rounded or not, so what is proved of the node holds below.

#include "rhview/frustum/box_hierarchy.h"

#include <algorithm>
#include <array>

#include "box_kernels.h"
#include "hierarchy_split.h"
#include "order_ranges.h"
#include "rhview/base/assert.h"
#include "rhview/base/prefetch.h"

namespace rhview {
namespace {

constexpr std::uint32_t kMaxDepth = 64;
// From here on boxes are halved: 2^32 of them take 32 levels more.
constexpr std::uint32_t kHalveFrom = 31;

/// Without a branch per coordinate.
bool are_same(const Aabb& a, const Aabb& b) {
    bool same = true;
    for (int axis = 0; axis < 3; ++axis) same &= (a.min[axis] == b.min[axis]) & (a.max[axis] == b.max[axis]);
    return same;
}

}  // namespace

/// Recursion is as deep as the tree: 64 levels at most.
class HierarchyBuilder {
  public:
    HierarchyBuilder(BoxHierarchy& tree, std::span<const Aabb> boxes, const HierarchyOptions& options)
        : tree_(tree),
          splitter_(boxes, options.split),
          ids_(boxes.size()),
          width_(std::clamp(options.width, 2u, 8u)),
          max_leaf_boxes_(std::clamp(options.max_leaf_boxes, 1u, 64u)) {
        for (std::uint32_t i = 0; i < ids_.size(); ++i) ids_[i] = i;
    }

    void build() {
        if (!ids_.empty()) add({0, static_cast<std::uint32_t>(ids_.size())}, 0);
        for (const std::uint32_t id : ids_) tree_.order_.push_back(ObjectId{id});
    }

  private:
    void add(OrderRange range, std::uint32_t depth) {
        const std::size_t index = tree_.nodes_.size();
        tree_.nodes_.push_back({{}, 0, range.first, range.count, depth});
        if (range.count > max_leaf_boxes_) {
            const auto [parts, count] = divide(range, depth);
            for (std::uint32_t i = 0; i < count; ++i) add(parts[i], depth + 1);
        }
        tree_.nodes_[index].escape = static_cast<std::uint32_t>(tree_.nodes_.size());
    }

    struct Parts {
        std::array<OrderRange, 8> parts;
        std::uint32_t count = 1;
    };
    /// The part with most boxes is divided until there are enough.
    Parts divide(OrderRange range, std::uint32_t depth) {
        Parts result;
        result.parts[0] = range;
        while (result.count < width_) {
            const auto end = result.parts.begin() + result.count;
            const auto largest =
                std::max_element(result.parts.begin(), end,
                                 [](const OrderRange& a, const OrderRange& b) { return a.count < b.count; });
            if (largest->count <= max_leaf_boxes_) break;
            const std::span<std::uint32_t> ids = std::span(ids_).subspan(largest->first, largest->count);
            const auto first = static_cast<std::uint32_t>(
                depth >= kHalveFrom ? splitter_.divide(ids, HierarchySplit::Median) : splitter_.divide(ids));
            std::copy_backward(largest, end, end + 1);
            largest[0].count = first;
            largest[1] = {largest[1].first + first, largest[1].count - first};
            ++result.count;
        }
        return result;
    }

    BoxHierarchy& tree_;
    HierarchySplitter splitter_;
    std::vector<std::uint32_t> ids_;
    std::uint32_t width_;
    std::uint32_t max_leaf_boxes_;
};

BoxHierarchy::BoxHierarchy(std::span<const Aabb> boxes, const HierarchyOptions& options) {
    RHVIEW_ASSERT(options.width >= 2 && options.width <= 8);
    RHVIEW_ASSERT(options.max_leaf_boxes >= 1 && options.max_leaf_boxes <= 64);
    HierarchyBuilder(*this, boxes, options).build();
    boxes_.resize(boxes.size());
    refit(boxes, true);
}

void BoxHierarchy::refit(std::span<const Aabb> boxes) {
    refit(boxes, false);
}

/// Where few boxes move, most leaves only have theirs compared.
void BoxHierarchy::refit_leaf(HierarchyNode& leaf, std::span<const Aabb> boxes, bool all) {
    const BoxSpans before = boxes_.spans();
    bool changed = all;
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
        if (i + kPrefetchSteps < order_.size()) prefetch(&boxes[index_of(order_[i + kPrefetchSteps])]);
        const Aabb& box = boxes[index_of(order_[i])];
        if (are_same(before[i], box)) continue;
        boxes_.set(i, box);
        changed = true;
    }
    if (!changed) return;
    leaf.bounds = {};
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
        leaf.bounds.grow(bounds_for_hierarchy(boxes[index_of(order_[i])]));
}

void BoxHierarchy::refit(std::span<const Aabb> boxes, bool all) {
    // Children stand behind their parents.
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        HierarchyNode& node = nodes_[i];
        if (node.escape == i + 1) {
            refit_leaf(node, boxes, all);
            continue;
        }
        node.bounds = {};
        for (std::uint32_t child = static_cast<std::uint32_t>(i) + 1; child < node.escape;
             child = nodes_[child].escape)
            node.bounds.grow(nodes_[child].bounds);
    }
}

HierarchyVisits BoxHierarchy::cull(const Frustum& frustum, std::vector<OrderRange>& visible) const {
    visible.clear();
    HierarchyVisits visits;
    const BoxSpans boxes = boxes_.spans();
    // The planes still to be tested below a node, by depth: what a stack would hold, without its pushes.
    std::array<PlaneMask, kMaxDepth + 1> masks;
    masks[0] = frustum.mask;
    PlaneMask kernel_mask = 0;
    KernelPlanes planes;
    for (std::uint32_t i = 0; i < nodes_.size();) {
        const HierarchyNode& node = nodes_[i];
        PlaneMask mask = masks[node.depth];
        ++visits.nodes;
        const Containment containment = classify(frustum, node.bounds, mask);
        if (containment == Containment::Intersecting && node.escape != i + 1) {
            masks[node.depth + 1] = mask;
            ++i;
            continue;
        }
        i = node.escape;
        if (containment == Containment::Outside) continue;
        if (containment == Containment::Inside) {
            append_range(visible, node.first, node.count);
            continue;
        }
        if (mask != kernel_mask) planes = kernel_planes(frustum, kernel_mask = mask);
        visits.boxes += node.count;
        append_bits(visible, node.first, cull_word(planes, boxes.subspan(node.first, node.count)));
    }
    return visits;
}

}  // namespace rhview
