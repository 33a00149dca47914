// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Which nodes of an octree to draw for a frustum. Every triangle of every leaf that may be visible is
/// covered, once.
#pragma once

#include <cstdint>
#include <vector>

#include "rhview/frustum/frustum.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// Nodes to draw, in depth-first order. Reuse it: clearing keeps the memory.
struct NodeList {
    std::vector<NodeId> nodes;
    std::uint64_t nodes_visited = 0;  ///< nodes the traversal touched
};

/// The paper's rule: a node that is completely visible (all its children are, so its box is inside the
/// frustum) is drawn itself and its children are skipped; else its children are looked at, down to the leaves
/// that may be visible. Gaps are never bridged, not even empty ones. Cost: linear in the nodes visited; a
/// subtree outside is not entered, one inside is one node. Source: Serpa & Rodrigues 2018, section 3 ("Caso
/// um nó esteja totalmente visível, é renderizado").
void seed_draw_list(const RhOctree& octree, const Frustum& frustum, NodeList& list);

/// The plain octree's rule: every leaf that may be visible, on its own.
void leaf_draw_list(const RhOctree& octree, const Frustum& frustum, NodeList& list);

/// Appends the ranges of `list`, node after node, batch after batch, to `ranges`.
void append_ranges(const RhOctree& octree, const NodeList& list, std::vector<DrawRange>& ranges);

}  // namespace rhview
