// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What to draw of an octree for a view: the cheapest draw list, and the simple rules that it is compared
/// with.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/frustum/frustum.h"
#include "rhview/rhoctree/draw_costs.h"
#include "rhview/rhoctree/facing.h"
#include "rhview/rhoctree/range_route.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// A node, or a piece of a leaf, that may be shown in another way than by the draw list, as by draws that
/// hang on a query: each of its batches then takes one range, for `draw_ns + index_ns·(its indices)`.
struct NodeAlternative {
    static constexpr std::uint32_t kWhole = 0xffffffffu;

    NodeId node{};
    std::uint32_t piece = kWhole;  ///< into `RhOctree::pieces`: of this leaf
    double index_ns = 0.0;
    double draw_ns = 0.0;
};

/// A batch's range of a node or piece that the draw list leaves to the node's alternative.
struct AlternativeRange {
    DrawRange range;
    std::uint32_t alternative = 0;  ///< into those given

    friend bool operator==(const AlternativeRange&, const AlternativeRange&) = default;
};

/// What a traversal of the same frustum found out before: by node, the planes left to test below it
/// (`classify`). Those are not tested again. Empty: nothing.
struct KnownContainment {
    static constexpr PlaneMask kOutside = 0x80;
    static constexpr PlaneMask kUnknown = 0xff;

    std::span<const PlaneMask> by_node{};
};

/// What `DrawListSolver` found. Reuse it: clearing keeps the memory.
struct DrawList {
    std::vector<DrawRange> ranges;               ///< by batch; within a batch along the base order
    std::vector<AlternativeRange> alternatives;  ///< those taken, in the order of `ranges`
    std::vector<NodeId> nodes;  ///< whose pieces were looked at, as one where the whole node is inside
    double predicted_ns = 0.0;  ///< what `ranges` and `alternatives` cost by the model
    std::uint64_t nodes_visited = 0;
    std::uint64_t pieces_visited = 0;
    std::uint32_t replicas_drawn = 0;
};

/// The cheapest draw list: the least c1·V + c3·N over every way of joining what may be visible to ranges,
/// over gaps or not, and of drawing replicas instead. One solver per view and thread; it keeps its memory.
///
/// Shown is every triangle of a piece that is not outside the frustum, except those of clusters that face
/// away. The minimum is exact for these pieces and clusters, up to the rounding of sums of doubles; ranges
/// that join one replica to another are not looked for. Cost: linear in the nodes not outside, their pieces
/// and clusters. A subtree inside the frustum is a loop over its pieces; a piece too short for a gap that
/// pays is looked at from its ends only. Source: docs/draw-list.md.
class DrawListSolver {
  public:
    ///
    /// `alternatives`: in the order of their nodes and pieces, none within another's; not outside the
    /// frustum. Such a node is not entered: per batch, it is one range of the draw list or one of its
    /// alternative, whichever makes the whole cheaper (a gap that is bridged anyway may cover it). What a
    /// piece of a node above holds is shown with that.
    void solve(const RhOctree& octree, const Frustum& frustum, const Viewpoint& viewpoint,
               const DrawCosts& costs, DrawList& list, std::span<const NodeAlternative> alternatives = {},
               const KnownContainment& known = {});

    /// For each replica that the view meets, adds to `saving_ns` what drawing it would save against the base
    /// order at its place, less the planning that it takes. No replica is drawn, `list` is the base order's.
    void add_savings(const RhOctree& octree, const Frustum& frustum, const Viewpoint& viewpoint,
                     const DrawCosts& costs, DrawList& list, std::span<double> saving_ns);

  private:
    struct OpenReplica {
        RangeRoute::ReplicaEntry entry;
        std::uint32_t replica = 0;
    };

    void walk(const RhOctree& octree, const Frustum& frustum, const Viewpoint& viewpoint,
              const DrawCosts& costs, DrawList& list, std::span<const NodeAlternative> alternatives,
              const KnownContainment& known, std::span<double> saving_ns);

    std::vector<RangeRoute> routes_;         ///< by batch
    std::vector<std::uint32_t> told_until_;  ///< by batch: where the last piece of an inner node ends
    RangeLog log_;
    std::vector<AlternativeRange> offered_;   ///< of the alternatives met
    std::vector<OpenReplica> open_replicas_;  ///< a stack: replicas are nested or apart

    friend class DrawListWalk;
};

/// Appends, in base order per node, what a draw list of this view must show: the pieces that are not outside
/// without their clusters that face away. For pictures and tests.
void append_ranges_to_show(const RhOctree& octree, const Frustum& frustum, const Viewpoint& viewpoint,
                           std::vector<DrawRange>& ranges);

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
