// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// A shortest path per batch (range_route.h) along the depth-first order, all batches in one traversal.

#include <algorithm>
#include <limits>

#include "rhview/base/assert.h"
#include "rhview/rhoctree/draw_list.h"

namespace rhview {
namespace {

// What a replica costs a frame that meets it: its place in the walk, and the test of a cluster. Measured on
// one core at 2 to 3 GHz; they only keep out replicas that save next to nothing.
constexpr double kReplicaVisitNs = 20.0;
constexpr double kClusterTestNs = 3.0;

constexpr std::uint32_t kWhole = NodeAlternative::kWhole;

/// The ranges of what is left of `clusters`, the first of which begins at index `first`: a gap is bridged
/// where that costs no more than a draw. `add(first, count)` is called for each; their cost, ns.
template <class Add>
double cover_clusters(std::span<const NormalCluster> clusters, std::uint32_t first,
                      const Viewpoint& viewpoint, const DrawCosts& costs, const Add& add) {
    double cost_ns = 0.0;
    std::uint32_t begin = 0, end = 0;  // the range being made; empty: none
    for (const NormalCluster& cluster : clusters) {
        const std::uint32_t next = first + cluster.index_count;
        if (!faces_away(cluster.facing, viewpoint)) {
            const double bridge_ns = costs.index_ns * (first - end);
            if (begin != end && bridge_ns <= costs.draw_ns) {
                cost_ns += bridge_ns;
            } else {
                if (begin != end) add(begin, end - begin);
                begin = first;
                cost_ns += costs.draw_ns;
            }
            cost_ns += costs.index_ns * cluster.index_count;
            end = next;
        }
        first = next;
    }
    if (begin != end) add(begin, end - begin);
    return cost_ns;
}

}  // namespace

/// Recursion is as deep as the octree: 21 levels at most.
class DrawListWalk {
  public:
    DrawListWalk(DrawListSolver& solver, const RhOctree& octree, const Frustum& frustum,
                 const Viewpoint& viewpoint, const DrawCosts& costs, DrawList& list,
                 std::span<const NodeAlternative> alternatives, const KnownContainment& known,
                 std::span<double> saving_ns)
        : solver_(solver),
          nodes_(octree.nodes()),
          pieces_(octree.pieces()),
          replicas_(octree.replicas()),
          clusters_(octree.clusters()),
          ranges_(octree.all_ranges()),
          frustum_(frustum),
          viewpoint_(viewpoint),
          costs_(costs),
          list_(list),
          alternatives_(alternatives),
          known_(known.by_node),
          saving_ns_(saving_ns) {}

    void visit(std::uint32_t index, PlaneMask mask) {
        ++list_.nodes_visited;
        const OctreeNode& node = nodes_[index];
        while (next_alternative_node() < index) ++next_alternative_;
        if (next_alternative_node() == index && alternatives_[next_alternative_].piece == kWhole)
            return offer_node(index);
        if (is_outside(index, mask)) return;
        if (mask == 0 && next_alternative_node() >= node.end) return show_all(index);
        const bool leaf = node.end == index + 1;
        const std::uint32_t piece_end = leaf ? node.piece_end : nodes_[index + 1].first_piece;
        const std::uint32_t replica_end = leaf ? node.replica_end : nodes_[index + 1].first_replica;
        for (std::uint32_t r = node.first_replica; r < replica_end; ++r) enter(r);
        if (node.first_piece < piece_end) list_.nodes.push_back(NodeId{index});
        for (std::uint32_t p = node.first_piece; p < piece_end; ++p) {
            if (!leaf) solver_.told_until_[index_of(pieces_[p].batch)] = end_of(pieces_[p]);
            if (next_alternative_node() == index && alternatives_[next_alternative_].piece == p) {
                offer({pieces_[p].batch, pieces_[p].first_index, pieces_[p].index_count});
                ++next_alternative_;
                continue;
            }
            PlaneMask piece_mask = mask;
            // A node of one batch has its piece's box.
            if (node.range_count == 1 ||
                classify(frustum_, pieces_[p].bounds, piece_mask) != Containment::Outside)
                show(pieces_[p]);
        }
        if (piece_end < node.piece_end)
            for (std::uint32_t child = index + 1; child < node.end; child = nodes_[child].end)
                visit(child, mask);
        for (std::uint32_t r = node.first_replica; r < replica_end; ++r) leave();
    }

    /// Writes down the cheapest lists; the routes are at their end.
    void finish() {
        for (std::uint32_t b = 0; b < solver_.routes_.size(); ++b) {
            RangeRoute& route = solver_.routes_[b];
            const std::size_t first = list_.ranges.size();
            const std::size_t first_taken = list_.alternatives.size();
            for (std::uint32_t place = route.finish(solver_.log_); place != RangeLog::kNone;) {
                const RangeLog::Entry& entry = solver_.log_[place];
                if (entry.is_replica() && entry.end < replicas_.size())
                    draw_replica(replicas_[entry.end]);
                else if (entry.is_replica())
                    list_.alternatives.push_back(solver_.offered_[entry.end - replicas_.size()]);
                else
                    list_.ranges.push_back({BatchId{b}, entry.first, entry.end - entry.first});
                place = entry.previous;
            }
            list_.predicted_ns += route.cost_ns();
            // The log leads from the last entry to the first.
            std::reverse(list_.alternatives.begin() + static_cast<std::ptrdiff_t>(first_taken),
                         list_.alternatives.end());
            if (list_.ranges.size() == first) continue;
            std::reverse(list_.ranges.begin() + static_cast<std::ptrdiff_t>(first), list_.ranges.end());
            list_.predicted_ns += costs_.call_ns;
        }
    }

  private:
    /// Leaves the planes to test below it in `mask`.
    [[nodiscard]] bool is_outside(std::uint32_t index, PlaneMask& mask) const {
        if (known_.empty() || known_[index] == KnownContainment::kUnknown)
            return classify(frustum_, nodes_[index].bounds, mask) == Containment::Outside;
        mask = known_[index];
        return mask == KnownContainment::kOutside;
    }

    /// The whole subtree is inside: its pieces without its nodes.
    void show_all(std::uint32_t index) {
        const OctreeNode& node = nodes_[index];
        if (node.first_piece < node.piece_end) list_.nodes.push_back(NodeId{index});
        const std::size_t outer = solver_.open_replicas_.size();
        std::uint32_t replica = node.first_replica;
        for (std::uint32_t p = node.first_piece; p < node.piece_end;) {
            while (replica < node.replica_end && first_piece_of(replica) == p) enter(replica++);
            std::uint32_t stop = replica < node.replica_end ? first_piece_of(replica) : node.piece_end;
            if (solver_.open_replicas_.size() > outer) stop = std::min(stop, end_of_open_replica());
            for (; p < stop; ++p) show(pieces_[p]);
            while (solver_.open_replicas_.size() > outer && end_of_open_replica() == p) leave();
        }
    }

    [[nodiscard]] std::uint32_t first_piece_of(std::uint32_t replica) const {
        return nodes_[index_of(replicas_[replica].node)].first_piece;
    }
    [[nodiscard]] std::uint32_t end_of_open_replica() const {
        return nodes_[index_of(replicas_[solver_.open_replicas_.back().replica].node)].piece_end;
    }

    static std::uint32_t end_of(const OctreePiece& piece) { return piece.first_index + piece.index_count; }

    void show(const OctreePiece& piece) {
        ++list_.pieces_visited;
#ifdef RHVIEW_DISHONEST_DROP
        // For the tests that show that the checks can fail: one visible piece in so many is left out.
        if ((&piece - pieces_.data() + 1) % RHVIEW_DISHONEST_DROP == 0) return;
#endif
        RangeRoute& route = solver_.routes_[index_of(piece.batch)];
        const NormalCluster* cluster = clusters_.data() + piece.first_cluster;
        const NormalCluster* end = cluster + piece.cluster_count;
        std::uint32_t first = piece.first_index;
        if (costs_.index_ns * piece.index_count <= costs_.draw_ns) {
            // No gap within is worth a draw: only the ends can be left out.
            for (; cluster != end && faces_away(cluster->facing, viewpoint_); ++cluster)
                first += cluster->index_count;
            if (cluster == end) return;
            std::uint32_t last = end_of(piece);
            for (--end; end != cluster && faces_away(end->facing, viewpoint_); --end)
                last -= end->index_count;
            route.show(first, last - first, costs_, solver_.log_);
            return;
        }
        for (; cluster != end; ++cluster) {
            if (!faces_away(cluster->facing, viewpoint_))
                route.show(first, cluster->index_count, costs_, solver_.log_);
            first += cluster->index_count;
        }
    }

    /// The first node from here on that has an alternative; none: beyond all nodes.
    [[nodiscard]] std::uint32_t next_alternative_node() const {
        return next_alternative_ < alternatives_.size()
                   ? static_cast<std::uint32_t>(alternatives_[next_alternative_].node)
                   : std::numeric_limits<std::uint32_t>::max();
    }

    void offer_node(std::uint32_t index) {
        const std::uint32_t first = nodes_[index].first_range;
        for (std::uint32_t r = first; r < first + nodes_[index].range_count; ++r) {
            const DrawRange& range = ranges_[r];
            // A piece of an inner node above may hold all that the batch has here.
            if (range.first_index >= solver_.told_until_[index_of(range.batch)]) offer(range);
        }
        ++next_alternative_;
    }

    /// `range` is of the next alternative.
    void offer(const DrawRange& range) {
        const NodeAlternative& alternative = alternatives_[next_alternative_];
        RangeRoute& route = solver_.routes_[index_of(range.batch)];
        const RangeRoute::ReplicaEntry entry = route.enter_replica(solver_.log_);
        route.show(range.first_index, range.index_count, costs_, solver_.log_);
        const auto number = static_cast<std::uint32_t>(replicas_.size() + solver_.offered_.size());
        solver_.offered_.push_back({range, next_alternative_});
        route.leave_replica(entry, number, alternative.draw_ns + alternative.index_ns * range.index_count,
                            solver_.log_);
    }

    void enter(std::uint32_t replica) {
        RangeRoute& route = solver_.routes_[index_of(replicas_[replica].batch)];
        solver_.open_replicas_.push_back({route.enter_replica(solver_.log_), replica});
    }

    void leave() {
        const auto [entry, number] = solver_.open_replicas_.back();
        solver_.open_replicas_.pop_back();
        const OctreeReplica& replica = replicas_[number];
        const double cost_ns = cover_clusters(clusters_of(replica), replica.first_index, viewpoint_, costs_,
                                              [](std::uint32_t, std::uint32_t) {});
        RangeRoute& route = solver_.routes_[index_of(replica.batch)];
        if (saving_ns_.empty()) return route.leave_replica(entry, number, cost_ns, solver_.log_);
        saving_ns_[number] += std::max(route.cost_ns() - entry.closed_ns - cost_ns, 0.0) - kReplicaVisitNs -
                              kClusterTestNs * replica.cluster_count;
    }

    void draw_replica(const OctreeReplica& replica) {
        const std::size_t before = list_.ranges.size();
        cover_clusters(clusters_of(replica), replica.first_index, viewpoint_, costs_,
                       [&](std::uint32_t first, std::uint32_t count) {
                           list_.ranges.push_back({replica.batch, first, count});
                       });
        std::reverse(list_.ranges.begin() + static_cast<std::ptrdiff_t>(before), list_.ranges.end());
        ++list_.replicas_drawn;
    }

    [[nodiscard]] std::span<const NormalCluster> clusters_of(const OctreeReplica& replica) const {
        return clusters_.subspan(replica.first_cluster, replica.cluster_count);
    }

    DrawListSolver& solver_;
    std::span<const OctreeNode> nodes_;
    std::span<const OctreePiece> pieces_;
    std::span<const OctreeReplica> replicas_;
    std::span<const NormalCluster> clusters_;
    std::span<const DrawRange> ranges_;
    const Frustum& frustum_;
    const Viewpoint& viewpoint_;
    DrawCosts costs_;
    DrawList& list_;
    std::span<const NodeAlternative> alternatives_;
    std::uint32_t next_alternative_ = 0;  ///< the first that the walk has not come to
    std::span<const PlaneMask> known_;    ///< by node; empty: nothing
    std::span<double> saving_ns_;         ///< by replica; empty: replicas are drawn where they save something
};

void DrawListSolver::walk(const RhOctree& octree, const Frustum& frustum, const Viewpoint& viewpoint,
                          const DrawCosts& costs, DrawList& list,
                          std::span<const NodeAlternative> alternatives, const KnownContainment& known,
                          std::span<double> saving_ns) {
    RHVIEW_ASSERT(known.by_node.empty() || known.by_node.size() == octree.nodes().size());
    list.ranges.clear();
    list.alternatives.clear();
    list.nodes.clear();
    list.predicted_ns = 0.0;
    list.nodes_visited = 0;
    list.pieces_visited = 0;
    list.replicas_drawn = 0;
    log_.clear();
    offered_.clear();
    open_replicas_.clear();
    routes_.assign(octree.batch_count(), RangeRoute());
    told_until_.assign(octree.batch_count(), 0);
    DrawListWalk walk(*this, octree, frustum, viewpoint, costs, list, alternatives, known, saving_ns);
    if (!octree.nodes().empty()) walk.visit(0, frustum.mask);
    walk.finish();
}

void DrawListSolver::solve(const RhOctree& octree, const Frustum& frustum, const Viewpoint& viewpoint,
                           const DrawCosts& costs, DrawList& list,
                           std::span<const NodeAlternative> alternatives, const KnownContainment& known) {
    walk(octree, frustum, viewpoint, costs, list, alternatives, known, {});
}

void DrawListSolver::add_savings(const RhOctree& octree, const Frustum& frustum, const Viewpoint& viewpoint,
                                 const DrawCosts& costs, DrawList& list, std::span<double> saving_ns) {
    RHVIEW_ASSERT(saving_ns.size() == octree.replicas().size());
    walk(octree, frustum, viewpoint, costs, list, {}, {}, saving_ns);
}

}  // namespace rhview
