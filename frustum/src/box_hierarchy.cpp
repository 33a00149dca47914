// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Culling is exact with regard to `cull_boxes`: a node's box contains those below it, and each operation of
// the test is monotone in the box's corners, rounded or not, so what is proved of the node holds below.

#include "rhview/frustum/box_hierarchy.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "box_kernels.h"
#include "hierarchy_split.h"
#include "order_ranges.h"
#include "rhview/base/assert.h"

namespace rhview {
namespace {

constexpr std::uint32_t kMaxDepth = 64;
// From here on boxes are halved: 2^32 of them take 32 levels more.
constexpr std::uint32_t kHalveFrom = 31;

/// Boxes that are compared at once: what stands still goes by at the speed of memory.
constexpr std::size_t kCompared = 32;

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
    known_.resize(boxes.size());
    find_places();
    for (std::size_t object = 0; object < boxes.size(); ++object) take(object, boxes[object]);
    refit_marked();
}

void BoxHierarchy::find_places() {
    place_.resize(order_.size());
    leaf_.resize(order_.size());
    marked_.assign(nodes_.size(), 0);
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        if (nodes_[i].escape != i + 1) continue;
        for (std::uint32_t place = nodes_[i].first; place < nodes_[i].first + nodes_[i].count; ++place) {
            place_[index_of(order_[place])] = place;
            leaf_[index_of(order_[place])] = i;
        }
    }
}

void BoxHierarchy::take(std::size_t object, const Aabb& box) {
    known_[object] = box;
    boxes_.set(place_[object], box);
    marked_[leaf_[object]] = 1;
}

/// To the last bit, so that what is not a number can stand still too.
bool BoxHierarchy::take_moved(std::span<const Aabb> boxes) {
    static_assert(sizeof(Aabb) == 6 * sizeof(float));
    const auto same = [&](std::size_t first, std::size_t count) {
        return std::memcmp(&known_[first], &boxes[first], count * sizeof(Aabb)) == 0;
    };
    bool any = false;
    for (std::size_t first = 0; first < known_.size(); first += kCompared) {
        const std::size_t end = std::min(first + kCompared, known_.size());
        if (same(first, end - first)) continue;
        any = true;
        for (std::size_t object = first; object < end; ++object)
            if (!same(object, 1)) take(object, boxes[object]);
    }
    return any;
}

void BoxHierarchy::refit(std::span<const Aabb> boxes) {
    RHVIEW_ASSERT(boxes.size() >= known_.size());
    if (take_moved(boxes)) refit_marked();
}

/// The marked leaves and what is above them. Children stand behind their parents.
void BoxHierarchy::refit_marked() {
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        HierarchyNode& node = nodes_[i];
        const auto first_child = static_cast<std::uint32_t>(i) + 1;
        const bool leaf = node.escape == first_child;
        for (std::uint32_t child = first_child; child < node.escape; child = nodes_[child].escape)
            marked_[i] |= marked_[child];
        if (marked_[i] == 0) continue;
        node.bounds = {};
        for (std::uint32_t child = first_child; child < node.escape; child = nodes_[child].escape)
            node.bounds.grow(nodes_[child].bounds);
        if (!leaf) continue;
        for (std::uint32_t place = node.first; place < node.first + node.count; ++place)
            node.bounds.grow(bounds_for_hierarchy(known_[index_of(order_[place])]));
    }
    std::ranges::fill(marked_, std::uint8_t{0});
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
