// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/cull_tree.h"

#include <algorithm>

namespace rhview {
namespace {

float area_of(const Aabb& box) {
    const glm::vec3 e = box.max - box.min;
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

}  // namespace

CullTree CullTree::of_octree(const RhOctree& octree) {
    std::vector<CullNode> nodes;
    nodes.reserve(octree.nodes().size());
    for (std::uint32_t i = 0; i < octree.nodes().size(); ++i) {
        const OctreeNode& node = octree.nodes()[i];
        const bool leaf = octree.is_leaf(NodeId{i});
        nodes.push_back({node.bounds, node.end, 0, node.first_range, leaf ? node.range_count : 0});
    }
    const std::span<const DrawRange> ranges = octree.all_ranges();
    return of_nodes(std::move(nodes), {ranges.begin(), ranges.end()});
}

CullTree CullTree::of_nodes(std::vector<CullNode> nodes, std::vector<DrawRange> ranges) {
    CullTree tree;
    tree.ranges_ = std::move(ranges);
    tree.nodes_ = std::move(nodes);
    tree.nodes_.insert(tree.nodes_.begin(), CullNode());
    tree.static_nodes_ = static_cast<std::uint32_t>(tree.nodes_.size());
    for (std::uint32_t i = 1; i < tree.static_nodes_; ++i) {
        ++tree.nodes_[i].end;
        if (tree.is_leaf(i) && tree.nodes_[i].range_count > 0)
            tree.static_bounds_.grow(tree.nodes_[i].bounds);
    }
    tree.nodes_[0].end = tree.static_nodes_;
    tree.nodes_[0].bounds = tree.static_bounds_;
    tree.set_parents(0);
    return tree;
}

void CullTree::set_parents(std::uint32_t first) {
    for (std::uint32_t i = first; i < nodes_.size(); ++i)
        for (std::uint32_t c = i + 1; c < nodes_[i].end; c = nodes_[c].end) nodes_[c].parent = i;
}

void CullTree::find_tight_bounds(const TightBounds& options) {
    tight_bounds_ = options;
    tight_.clear();
    append_tight(0);
}

/// Of all nodes from `first` on.
void CullTree::append_tight(std::uint32_t first) {
    std::vector<std::uint32_t> parts, finer;
    for (std::uint32_t i = first; i < nodes_.size(); ++i) {
        const double limit = tight_bounds_.area * area_of(nodes_[i].bounds);
        parts.assign(1, i);
        for (std::uint32_t depth = 0; depth < tight_bounds_.depth; ++depth) {
            finer.clear();
            double area = 0.0;
            for (const std::uint32_t part : parts) {
                if (is_leaf(part)) finer.push_back(part);
                for (std::uint32_t c = part + 1; c < nodes_[part].end; c = nodes_[c].end) finer.push_back(c);
            }
            for (const std::uint32_t part : finer) area += area_of(nodes_[part].bounds);
            if (finer.size() == parts.size() || finer.size() > tight_bounds_.most_boxes || !(area <= limit))
                break;
            parts.swap(finer);
        }
        nodes_[i].first_tight = static_cast<std::uint32_t>(tight_.size());
        nodes_[i].tight_count = static_cast<std::uint32_t>(parts.size());
        tight_.insert(tight_.end(), parts.begin(), parts.end());
    }
}

void CullTree::set_objects(std::span<const Aabb> boxes, std::span<const std::uint64_t> alive) {
    alive_ = alive;
    if (boxes.size() == objects_.order().size()) {
        if (boxes.empty()) return;
        objects_.refit(boxes);
        for (std::uint32_t i = 0; i < objects_.nodes().size(); ++i)
            nodes_[static_nodes_ + i].bounds = objects_.nodes()[i].bounds;
    } else {
        objects_ = BoxHierarchy(boxes, {HierarchySplit::SurfaceArea, 2, 1});
        add_object_nodes();
    }
    nodes_[0].bounds = static_bounds_;
    if (!objects_.nodes().empty()) nodes_[0].bounds.grow(objects_.nodes()[0].bounds);
}

void CullTree::add_object_nodes() {
    nodes_.resize(static_nodes_);
    for (const HierarchyNode& node : objects_.nodes()) {
        CullNode& added = nodes_.emplace_back();
        added.bounds = node.bounds;
        added.end = static_nodes_ + node.escape;
        if (added.end != nodes_.size()) continue;
        added.first_object = node.first;
        added.object_count = node.count;
    }
    nodes_[0].end = static_cast<std::uint32_t>(nodes_.size());
    set_parents(static_nodes_);
    // Places of boxes that have gone stay behind: the number of objects seldom changes.
    if (!tight_.empty()) append_tight(static_nodes_);
}

std::uint64_t CullTree::leaf_count() const {
    std::uint64_t leaves = 0;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) leaves += is_leaf(i) ? 1 : 0;
    return leaves;
}

}  // namespace rhview
