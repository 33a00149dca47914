// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "replicas.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "normal_order.h"
#include "sample_views.h"
#include "vertex_cache_order.h"
#include "vertex_reuse.h"

namespace rhview {
namespace {

constexpr std::size_t kSampleViews = 96;

// In draws' worth of indices. Less than one: a gap within isn't worth a draw. More than 256: hardly ever
// inside a frustum, and the eye as often among its planes as behind them.
constexpr double kLeastDraws = 1.0;
constexpr double kMostDraws = 256.0;
constexpr double kMostIndices = 3e6;  // of a candidate, where draws cost next to nothing or everything

// A candidate's cones are only for choosing: so many triangles of each cluster are enough.
constexpr std::uint32_t kSampledTriangles = 48;

constexpr std::size_t kViewsTogether = 16;
constexpr double kSavingsShare = 0.1;  // of the build's time, and what writing replicas takes of it
constexpr double kEmitShare = 0.1;

}  // namespace

void ReplicaBuilder::build() {
    add_candidates();
    if (!octree_.replicas_.own().empty()) {
        measure_savings();
        keep_outer_or_inner();
        keep_within_budget();
        drop_unchosen();
    }
    count_nodes_replicas();
    emit_indices();
}

void ReplicaBuilder::add_candidates() {
    const double draw_indices =
        options_.costs.index_ns > 0.0 ? options_.costs.draw_ns / options_.costs.index_ns : kMostIndices;
    const double least = kLeastDraws * draw_indices;
    const double most = std::min(kMostDraws * std::max(draw_indices, 1000.0), kMostIndices);
    // Per batch: the end of the subtree that a piece stands for; below it there is nothing to gain.
    std::vector<std::uint32_t> piece_until(batches_.size(), 0);
    for (std::uint32_t id = 0; id < octree_.nodes_.own().size(); ++id) {
        const OctreeNode& node = octree_.nodes_.own()[id];
        if (octree_.is_leaf(NodeId{id})) continue;
        for (std::uint32_t p = node.first_piece; p < octree_.nodes_.own()[id + 1].first_piece; ++p)
            piece_until[index_of(octree_.pieces_.own()[p].batch)] = node.end;
        for (const DrawRange& range : octree_.ranges(NodeId{id})) {
            const auto b = index_of(range.batch);
            if (id >= piece_until[b] && !batches_[b].two_sided && range.index_count >= least &&
                range.index_count <= most)
                octree_.replicas_.own().push_back(
                    {NodeId{id}, range.batch, range.first_index, range.index_count, 0, 0});
        }
    }
    bound_candidates();
    count_nodes_replicas();
}

void ReplicaBuilder::bound_candidates() {
    std::vector<OctreeReplica>& replicas = octree_.replicas_.own();
    std::vector<std::vector<NormalCluster>> clusters(replicas.size());
    tbb::parallel_for(std::size_t{0}, replicas.size(), [&](std::size_t r) {
        if (!progress_.stopped()) bound_candidate(replicas[r], clusters[r]);
    });
    append(clusters);
}

void ReplicaBuilder::append(const std::vector<std::vector<NormalCluster>>& clusters_of_replica) {
    std::vector<NormalCluster>& clusters = octree_.clusters_.own();
    for (std::size_t r = 0; r < clusters_of_replica.size(); ++r) {
        OctreeReplica& replica = octree_.replicas_.own()[r];
        replica.first_cluster = static_cast<std::uint32_t>(clusters.size());
        replica.cluster_count = static_cast<std::uint32_t>(clusters_of_replica[r].size());
        clusters.insert(clusters.end(), clusters_of_replica[r].begin(), clusters_of_replica[r].end());
    }
}

void ReplicaBuilder::bound_candidate(const OctreeReplica& range, std::vector<NormalCluster>& clusters) const {
    const std::span<const std::uint8_t> cluster_of =
        cluster_of_triangle_.subspan(range.first_index / 3, range.index_count / 3);
    std::array<std::uint32_t, 256> count{};
    for (const std::uint8_t cluster : cluster_of) ++count[cluster];
    std::array<std::vector<std::uint32_t>, 256> sampled;
    std::array<std::uint32_t, 256> met{};
    std::array<VertexCache, 256> caches;
    std::size_t shaded = 0;
    for (std::size_t t = 0; t < cluster_of.size(); ++t) {
        const std::uint8_t cluster = cluster_of[t];
        const std::uint32_t* corners = octree_.indices().data() + range.first_index + 3 * t;
        for (std::size_t corner = 0; corner < 3; ++corner) shaded += caches[cluster].misses(corners[corner]);
        const std::uint32_t stride = 1 + count[cluster] / kSampledTriangles;
        if (met[cluster]++ % stride == 0)
            for (std::size_t corner = 0; corner < 3; ++corner) sampled[cluster].push_back(corners[corner]);
    }
    // What is dearer by index in the replica counts as more indices: only for choosing.
    const std::size_t in_base =
        shaded_vertices(octree_.indices().subspan(range.first_index, range.index_count));
    const double dearer = std::max(1.0, static_cast<double>(shaded) / static_cast<double>(in_base));
    std::uint32_t joined = 0, left = range.index_count;
    std::vector<std::uint32_t> sample;
    for (std::size_t cluster = 0; cluster < count.size(); ++cluster) {
        joined += 3 * count[cluster];
        left -= 3 * count[cluster];
        sample.insert(sample.end(), sampled[cluster].begin(), sampled[cluster].end());
        if (joined == 0 ||
            (left > 0 && (joined < options_.min_record_indices || left < options_.min_record_indices)))
            continue;
        clusters.push_back({bound_facing(batches_[index_of(range.batch)].positions, sample),
                            static_cast<std::uint32_t>(dearer * joined)});
        joined = 0;
        sample.clear();
    }
}

void ReplicaBuilder::count_nodes_replicas() {
    std::uint32_t next = 0;
    for (std::uint32_t id = 0; id < octree_.nodes_.own().size(); ++id) {
        octree_.nodes_.own()[id].first_replica = next;
        while (next < octree_.replicas_.own().size() && index_of(octree_.replicas_.own()[next].node) == id)
            ++next;
    }
    for (OctreeNode& node : octree_.nodes_.own())
        node.replica_end =
            node.end < octree_.nodes_.own().size() ? octree_.nodes_.own()[node.end].first_replica : next;
}

void ReplicaBuilder::measure_savings() {
    std::vector<View> views(options_.sample_views.begin(), options_.sample_views.end());
    const glm::dvec3 origin = views.empty() ? glm::dvec3(0.0) : options_.scene_origin;
    if (views.empty()) views = sample_views(batches_, octree_.nodes_.own().front().bounds, kSampleViews);
    saving_ns_.assign(octree_.replicas_.own().size(), 0.0);
    progress_.begin_phase(kSavingsShare, views.size());
    // A few views at a time, each with sums of its own, which are added in the views' order: the same total
    // whatever the number of threads.
    std::vector<std::vector<double>> saving_of_view(kViewsTogether);
    for (std::size_t first = 0; first < views.size(); first += kViewsTogether) {
        const std::size_t count = std::min(kViewsTogether, views.size() - first);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t v) {
            saving_of_view[v].assign(saving_ns_.size(), 0.0);
            if (progress_.stopped()) return;
            const View& view = views[first + v];
            DrawListSolver solver;
            DrawList list;
            solver.add_savings(octree_, make_frustum(view, origin), make_viewpoint(view, origin),
                               options_.costs, list, saving_of_view[v]);
            progress_.advance(1);
        });
        for (std::size_t v = 0; v < count; ++v)
            for (std::size_t r = 0; r < saving_ns_.size(); ++r) saving_ns_[r] += saving_of_view[v][r];
    }
    for (std::size_t r = 0; r < saving_ns_.size(); ++r)
        saving_ns_[r] /= static_cast<double>(std::max<std::size_t>(views.size(), 1));
}

void ReplicaBuilder::keep_outer_or_inner() {
    const std::size_t count = octree_.replicas_.own().size();
    chosen_.assign(count, false);
    // Backwards: descendants come before their ancestors. `below` gathers, per candidate, the best total of
    // the candidates of its batch right below it.
    std::vector<double> below(count, 0.0);
    std::vector<std::uint32_t> parent(count, static_cast<std::uint32_t>(count));
    std::vector<std::vector<std::uint32_t>> open(batches_.size());
    for (std::uint32_t r = 0; r < count; ++r) {
        const OctreeReplica& replica = octree_.replicas_.own()[r];
        std::vector<std::uint32_t>& stack = open[index_of(replica.batch)];
        while (!stack.empty() &&
               octree_.node(octree_.replicas_.own()[stack.back()].node).end <= index_of(replica.node))
            stack.pop_back();
        if (!stack.empty()) parent[r] = stack.back();
        stack.push_back(r);
    }
    for (std::size_t r = count; r-- > 0;) {
        chosen_[r] = saving_ns_[r] > 0.0 && saving_ns_[r] >= below[r];
        if (parent[r] < count) below[parent[r]] += chosen_[r] ? saving_ns_[r] : below[r];
    }
    // An outer one that is chosen closes all that is below it.
    std::vector<bool> closed(count, false);
    for (std::uint32_t r = 0; r < count; ++r) {
        closed[r] = parent[r] < count && (chosen_[parent[r]] || closed[parent[r]]);
        if (closed[r]) chosen_[r] = false;
    }
}

void ReplicaBuilder::keep_within_budget() {
    std::vector<std::uint32_t> order;
    for (std::uint32_t r = 0; r < chosen_.size(); ++r)
        if (chosen_[r]) order.push_back(r);
    const auto worth = [&](std::uint32_t r) {
        return saving_ns_[r] / octree_.replicas_.own()[r].index_count;
    };
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return worth(a) > worth(b); });
    double left = options_.replica_budget * static_cast<double>(octree_.base_index_count_);
    // Base and replicas are addressed by 32 bits together.
    left = std::min(left, 4294967295.0 - static_cast<double>(octree_.base_index_count_));
    for (const std::uint32_t r : order) {
        chosen_[r] = octree_.replicas_.own()[r].index_count <= left;
        if (chosen_[r]) left -= octree_.replicas_.own()[r].index_count;
    }
}

void ReplicaBuilder::drop_unchosen() {
    std::vector<OctreeReplica> kept;
    for (std::size_t r = 0; r < chosen_.size(); ++r)
        if (chosen_[r]) kept.push_back(octree_.replicas_.own()[r]);
    octree_.clusters_.own().resize(octree_.replicas_.own().front().first_cluster);
    octree_.replicas_.own() = std::move(kept);
}

void ReplicaBuilder::emit_indices() {
    std::vector<OctreeReplica>& replicas = octree_.replicas_.own();
    std::size_t next = octree_.base_index_count_;
    for (OctreeReplica& replica : replicas) {
        replica.first_index = static_cast<std::uint32_t>(next);
        next += replica.index_count;
    }
    octree_.indices_.own().resize(next);
    progress_.begin_phase(kEmitShare, replicas.size());
    std::vector<std::vector<NormalCluster>> clusters(replicas.size());
    tbb::parallel_for(std::size_t{0}, replicas.size(), [&](std::size_t r) {
        if (!progress_.stopped()) emit_replica(replicas[r], clusters[r]);
        progress_.advance(1);
    });
    append(clusters);
}

void ReplicaBuilder::emit_replica(const OctreeReplica& replica, std::vector<NormalCluster>& clusters) {
    const std::span<const DrawRange> ranges = octree_.ranges(replica.node);
    const auto base = std::ranges::lower_bound(ranges, replica.batch, {}, &DrawRange::batch);
    const std::span<std::uint32_t> all(octree_.indices_.own());
    const std::span<std::uint32_t> indices = all.subspan(replica.first_index, replica.index_count);
    std::ranges::copy(all.subspan(base->first_index, replica.index_count), indices.begin());
    const std::span<const std::uint8_t> source =
        cluster_of_triangle_.subspan(base->first_index / 3, replica.index_count / 3);
    std::vector<std::uint8_t> cluster_of(source.begin(), source.end());
    ClusterSorter().sort(indices, cluster_of);
    append_clusters(batches_[index_of(replica.batch)].positions, indices, cluster_of,
                    options_.min_record_indices, clusters);
    VertexCacheOrder order;
    std::size_t first = 0;
    for (const NormalCluster& cluster : clusters) {
        order.apply(indices.subspan(first, cluster.index_count), {});
        first += cluster.index_count;
    }
}

}  // namespace rhview
