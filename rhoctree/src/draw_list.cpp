// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/rhoctree/draw_list.h"

namespace rhview {
namespace {

/// Walks the nodes that are not outside. Recursion is as deep as the octree: 21 levels at most.
class Traversal {
  public:
    Traversal(const RhOctree& octree, const Frustum& frustum, NodeList& list)
        : nodes_(octree.nodes()), frustum_(frustum), list_(list) {
        list_.nodes.clear();
        list_.nodes_visited = 0;
    }

    void add_by_seed_rule(std::uint32_t index, PlaneMask mask) {
        ++list_.nodes_visited;
        const Containment containment = classify(frustum_, nodes_[index].bounds, mask);
        if (containment == Containment::Outside) return;
        if (containment == Containment::Inside || nodes_[index].end == index + 1) {
            list_.nodes.push_back(NodeId{index});
            return;
        }
        for (std::uint32_t child = index + 1; child < nodes_[index].end; child = nodes_[child].end)
            add_by_seed_rule(child, mask);
    }

    void add_leaves(std::uint32_t index, PlaneMask mask) {
        ++list_.nodes_visited;
        // An empty mask: inside, so is everything below.
        if (mask != 0 && classify(frustum_, nodes_[index].bounds, mask) == Containment::Outside) return;
        if (nodes_[index].end == index + 1) {
            list_.nodes.push_back(NodeId{index});
            return;
        }
        for (std::uint32_t child = index + 1; child < nodes_[index].end; child = nodes_[child].end)
            add_leaves(child, mask);
    }

  private:
    std::span<const OctreeNode> nodes_;
    const Frustum& frustum_;
    NodeList& list_;
};

}  // namespace

void seed_draw_list(const RhOctree& octree, const Frustum& frustum, NodeList& list) {
    Traversal traversal(octree, frustum, list);
    if (!octree.nodes().empty()) traversal.add_by_seed_rule(0, frustum.mask);
}

void leaf_draw_list(const RhOctree& octree, const Frustum& frustum, NodeList& list) {
    Traversal traversal(octree, frustum, list);
    if (!octree.nodes().empty()) traversal.add_leaves(0, frustum.mask);
}

void append_ranges_to_show(const RhOctree& octree, const Frustum& frustum, const Viewpoint& viewpoint,
                           std::vector<DrawRange>& ranges) {
    const std::span<const OctreeNode> nodes = octree.nodes();
    const auto is_outside = [&](const Aabb& box) {
        PlaneMask mask = frustum.mask;
        return classify(frustum, box, mask) == Containment::Outside;
    };
    for (std::uint32_t i = 0; i < nodes.size();) {
        if (is_outside(nodes[i].bounds)) {
            i = nodes[i].end;
            continue;
        }
        const bool leaf = nodes[i].end == i + 1;
        const std::uint32_t piece_end = leaf ? nodes[i].piece_end : nodes[i + 1].first_piece;
        for (std::uint32_t p = nodes[i].first_piece; p < piece_end; ++p) {
            const OctreePiece& piece = octree.pieces()[p];
            if (is_outside(piece.bounds)) continue;
            std::uint32_t first = piece.first_index;
            for (const NormalCluster& cluster :
                 octree.clusters().subspan(piece.first_cluster, piece.cluster_count)) {
                if (!faces_away(cluster.facing, viewpoint))
                    ranges.push_back({piece.batch, first, cluster.index_count});
                first += cluster.index_count;
            }
        }
        ++i;
    }
}

void append_ranges(const RhOctree& octree, const NodeList& list, std::vector<DrawRange>& ranges) {
    for (const NodeId id : list.nodes) {
        const std::span<const DrawRange> node_ranges = octree.ranges(id);
        ranges.insert(ranges.end(), node_ranges.begin(), node_ranges.end());
    }
}

}  // namespace rhview
