// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "rhview/baselines/cull_tree.h"

namespace rhview {
namespace {

class ObjectTreeBuilder {
  public:
    ObjectTreeBuilder(std::span<const StaticObject> objects, std::span<const TriangleBatch> batches,
                      std::uint32_t leaf_triangles)
        : objects_(objects), batches_(batches), leaf_indices_(3 * std::uint64_t{leaf_triangles}) {}

    OrderedTree build() {
        std::vector<Aabb> boxes;
        boxes.reserve(objects_.size());
        for (const StaticObject& object : objects_) boxes.push_back(object.bounds);
        hierarchy_ = BoxHierarchy(boxes, {HierarchySplit::SurfaceArea, 2, 1});
        order_indices();
        if (!hierarchy_.nodes().empty()) add(0);
        return {CullTree::of_nodes(std::move(nodes_), std::move(ranges_)), std::move(indices_)};
    }

  private:
    /// Batch after batch, each in the hierarchy's order.
    void order_indices() {
        std::vector<std::uint32_t> batch_first, next;
        std::uint32_t count = 0;
        for (const TriangleBatch& batch : batches_) {
            batch_first.push_back(count);
            count += static_cast<std::uint32_t>(batch.indices.size());
        }
        next = batch_first;
        indices_.resize(count);
        std::uint64_t before = 0;
        for (const ObjectId id : hierarchy_.order()) {
            const DrawRange& source = objects_[index_of(id)].range;
            const std::size_t b = index_of(source.batch);
            const std::span<const std::uint32_t> from =
                batches_[b].indices.subspan(source.first_index - batch_first[b], source.index_count);
            std::ranges::copy(from, indices_.begin() + next[b]);
            placed_.push_back({source.batch, next[b], source.index_count});
            next[b] += source.index_count;
            indices_before_.push_back(before);
            before += source.index_count;
        }
        indices_before_.push_back(before);
    }

    /// Recursion is as deep as the hierarchy: 64 levels at most.
    void add(std::uint32_t source) {
        const HierarchyNode& node = hierarchy_.nodes()[source];
        const std::size_t added = nodes_.size();
        nodes_.push_back({node.bounds});
        const std::uint64_t indices = indices_before_[node.first + node.count] - indices_before_[node.first];
        if (node.escape == source + 1 || indices <= leaf_indices_) {
            nodes_[added].first_range = static_cast<std::uint32_t>(ranges_.size());
            append_ranges(node);
            nodes_[added].range_count =
                static_cast<std::uint32_t>(ranges_.size()) - nodes_[added].first_range;
        } else {
            for (std::uint32_t c = source + 1; c < node.escape; c = hierarchy_.nodes()[c].escape) add(c);
        }
        nodes_[added].end = static_cast<std::uint32_t>(nodes_.size());
    }

    /// One range per batch: a subtree's objects of a batch lie next to one another.
    void append_ranges(const HierarchyNode& node) {
        const std::size_t first = ranges_.size();
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const DrawRange& range = placed_[i];
            const auto same =
                std::find_if(ranges_.begin() + static_cast<std::ptrdiff_t>(first), ranges_.end(),
                             [&](const DrawRange& other) { return other.batch == range.batch; });
            if (same != ranges_.end())
                same->index_count += range.index_count;
            else if (range.index_count > 0)
                ranges_.push_back(range);
        }
        std::sort(ranges_.begin() + static_cast<std::ptrdiff_t>(first), ranges_.end(),
                  [](const DrawRange& a, const DrawRange& b) { return a.batch < b.batch; });
    }

    std::span<const StaticObject> objects_;
    std::span<const TriangleBatch> batches_;
    std::uint64_t leaf_indices_;
    BoxHierarchy hierarchy_;
    std::vector<DrawRange> placed_;              ///< by place in the hierarchy's order
    std::vector<std::uint64_t> indices_before_;  ///< likewise, and one more
    std::vector<std::uint32_t> indices_;
    std::vector<CullNode> nodes_;
    std::vector<DrawRange> ranges_;
};

}  // namespace

OrderedTree make_object_tree(std::span<const StaticObject> objects, std::span<const TriangleBatch> batches,
                             std::uint32_t leaf_triangles) {
    return ObjectTreeBuilder(objects, batches, leaf_triangles).build();
}

}  // namespace rhview
