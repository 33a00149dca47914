// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "octree_builder.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <limits>

#include "normal_order.h"
#include "vertex_reuse.h"

namespace rhview {
namespace {

constexpr std::uint32_t kNoSlot = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kPiecesTogether = 16;

/// Faces along the axes, all of them: each part of a batch can be looked at on its own.
ClusterScheme scheme_of(const TriangleBatch& batch) {
    constexpr std::size_t kGrain = std::size_t{1} << 14;
    const bool cones = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, batch.indices.size() / 3, kGrain), false,
        [&](const tbb::blocked_range<std::size_t>& part, bool found) {
            return found ||
                   choose_scheme(batch.positions, batch.indices.subspan(3 * part.begin(), 3 * part.size())) ==
                       ClusterScheme::Cones;
        },
        [](bool a, bool b) { return a || b; });
    return cones ? ClusterScheme::Cones : ClusterScheme::AxisAligned;
}

}  // namespace

OctreeBuilder::OctreeBuilder(std::span<const TriangleBatch> batches, const TriangleIds& ids,
                             std::span<MortonTriangle> triangles, const OctreeOptions& options,
                             BuildProgress& progress)
    : batches_(batches),
      ids_(ids),
      triangles_(triangles),
      options_(options),
      progress_(progress),
      max_leaf_(std::max(options.max_leaf_triangles, 1u)),
      nodes_(octree_.nodes_.own()),
      ranges_(octree_.ranges_.own()),
      pieces_(octree_.pieces_.own()),
      clusters_(octree_.clusters_.own()),
      indices_(octree_.indices_.own()),
      slot_of_batch_(batches.size(), kNoSlot) {
    octree_.batch_count_ = batches.size();
    octree_.base_index_count_ = std::size_t{3} * ids.count();
}

void OctreeBuilder::build() {
    if (triangles_.empty()) return;
    add_node(0, triangles_.size(), 0);
    octree_.leaf_count_ = leaves_.size();
    progress_.begin_phase(0.1, triangles_.size());
    sort_leaves();
    place_leaves();
    progress_.begin_phase(0.2, triangles_.size());
    indices_.resize(octree_.base_index_count_);
    choose_schemes();
    fill_leaves();
    join_children();
    hand_out_pieces();
    progress_.begin_phase(0.15, pieces_.size());
    bound_pieces();
}

void OctreeBuilder::choose_schemes() {
    for (std::uint32_t b = 0; b < batches_.size(); ++b)
        schemes_.push_back(is_ordered(b) ? scheme_of(batches_[b]) : ClusterScheme::AxisAligned);
    cluster_of_triangle_.resize(options_.normal_order ? triangles_.size() : 0);
}

void OctreeBuilder::add_node(std::size_t begin, std::size_t end, int level) {
    const auto id = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    nodes_[id].triangle_count = static_cast<std::uint32_t>(end - begin);
    cells_.push_back({begin, end});
    const bool small = is_small(begin, end);
    // Levels that keep all triangles together make no node.
    while (!small && level < kMortonLevels && octant(begin, level) == octant(end - 1, level)) ++level;
    if (small || level == kMortonLevels) {
        leaves_.push_back(id);
    } else {
        while (begin < end) {
            const std::size_t next = end_of_octant(begin, end, level);
            add_node(begin, next, level + 1);
            begin = next;
        }
    }
    nodes_[id].end = static_cast<std::uint32_t>(nodes_.size());
}

/// Whether the triangles fit one leaf.
bool OctreeBuilder::is_small(std::size_t begin, std::size_t end) {
    if (end - begin <= max_leaf_) return true;
    if (!options_.count_leaf_per_batch) return false;
    triangles_of_batch_.assign(batches_.size(), 0);
    for (const MortonTriangle& t : triangles_.subspan(begin, end - begin))
        if (++triangles_of_batch_[t.batch] > max_leaf_) return false;
    return true;
}

std::uint64_t OctreeBuilder::octant(std::size_t triangle, int level) const {
    return triangles_[triangle].code >> (3 * (kMortonLevels - 1 - level));
}

std::size_t OctreeBuilder::end_of_octant(std::size_t begin, std::size_t end, int level) const {
    const std::uint64_t value = octant(begin, level);
    const int shift = 3 * (kMortonLevels - 1 - level);
    const auto first = triangles_.begin();
    const auto found = std::partition_point(
        first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end),
        [&](const MortonTriangle& t) { return t.code >> shift == value; });
    return static_cast<std::size_t>(found - first);
}

/// A leaf's order is free: the source's keeps neighbours that share vertices together. (The clusters' comes
/// first where there are any.) Codes have done their work.
void OctreeBuilder::sort_leaves() {
    tbb::parallel_for(std::size_t{0}, leaves_.size(), [&](std::size_t leaf) {
        const Cell cell = cells_[leaves_[leaf]];
        const std::span<MortonTriangle> part = triangles_.subspan(cell.begin, cell.end - cell.begin);
        if (!std::ranges::is_sorted(part, {}, &MortonTriangle::id))
            std::ranges::sort(part, {}, &MortonTriangle::id);
        progress_.advance(part.size());
    });
}

/// Each leaf's ranges, one batch after the other. Ids are by batch: so are a leaf's triangles.
void OctreeBuilder::place_leaves() {
    std::vector<std::uint32_t> next_index;
    for (std::uint32_t b = 0; b < batches_.size(); ++b) next_index.push_back(3 * ids_.first_of(b));
    for (const std::uint32_t leaf : leaves_) {
        nodes_[leaf].first_range = static_cast<std::uint32_t>(ranges_.size());
        for (std::size_t begin = cells_[leaf].begin; begin < cells_[leaf].end;) {
            const std::uint32_t batch = triangles_[begin].batch;
            const auto rest = triangles_.subspan(begin, cells_[leaf].end - begin);
            const auto run =
                std::ranges::partition_point(rest, [&](const MortonTriangle& t) { return t.batch == batch; });
            const auto triangles = static_cast<std::uint32_t>(run - rest.begin());
            ranges_.push_back({BatchId{batch}, next_index[batch], 3 * triangles});
            next_index[batch] += 3 * triangles;
            begin += triangles;
        }
        nodes_[leaf].range_count = static_cast<std::uint32_t>(ranges_.size()) - nodes_[leaf].first_range;
    }
}

void OctreeBuilder::fill_leaves() {
    tbb::parallel_for(std::size_t{0}, leaves_.size(), [&](std::size_t leaf) {
        if (progress_.stopped()) return;
        fill_leaf(leaves_[leaf]);
        progress_.advance(nodes_[leaves_[leaf]].triangle_count);
    });
}

/// Indices and box, and the order by normal.
void OctreeBuilder::fill_leaf(std::uint32_t leaf) {
    OctreeNode& node = nodes_[leaf];
    ClusterSorter sorter;
    for (const DrawRange& range : std::span(ranges_).subspan(node.first_range, node.range_count)) {
        const auto b = static_cast<std::uint32_t>(range.batch);
        const TriangleBatch& batch = batches_[b];
        const std::span<std::uint32_t> indices =
            std::span(indices_).subspan(range.first_index, range.index_count);
        copy_source(leaf, range.batch, indices);
        for (const std::uint32_t index : indices) node.bounds.grow(batch.positions[index]);
        if (!is_ordered(b)) continue;
        const std::span<std::uint8_t> clusters =
            std::span(cluster_of_triangle_).subspan(range.first_index / 3, range.index_count / 3);
        classify_normals(schemes_[b], batch.positions, indices, clusters);
        sorter.sort(indices, clusters);
    }
}

/// The batch's triangles of the leaf, in the source's order.
void OctreeBuilder::copy_source(std::uint32_t leaf, BatchId batch, std::span<std::uint32_t> indices) const {
    const Cell cell = cells_[leaf];
    const auto b = static_cast<std::uint32_t>(batch);
    const std::span<const MortonTriangle> all = triangles_.subspan(cell.begin, cell.end - cell.begin);
    auto triangle = std::ranges::lower_bound(all, b, {}, &MortonTriangle::batch);
    for (std::size_t i = 0; i < indices.size(); i += 3, ++triangle)
        std::copy_n(batches_[b].indices.data() + 3 * std::size_t{triangle->id - ids_.first_of(b)}, 3,
                    indices.data() + i);
}

void OctreeBuilder::restore_source_order(std::uint32_t leaf, BatchId batch) {
    const std::span<const DrawRange> ranges = octree_.ranges(NodeId{leaf});
    const auto range = std::ranges::lower_bound(ranges, batch, {}, &DrawRange::batch);
    if (range == ranges.end() || range->batch != batch) return;
    const std::span<std::uint32_t> indices =
        std::span(indices_).subspan(range->first_index, range->index_count);
    copy_source(leaf, batch, indices);
    classify_normals(schemes_[index_of(batch)], batches_[index_of(batch)].positions, indices,
                     std::span(cluster_of_triangle_).subspan(range->first_index / 3, range->index_count / 3));
}

/// Boxes and ranges of inner nodes, from those of their children, which have higher numbers.
void OctreeBuilder::join_children() {
    for (auto id = static_cast<std::uint32_t>(nodes_.size()); id-- > 0;) {
        OctreeNode& node = nodes_[id];
        if (node.end == id + 1) continue;
        for (std::uint32_t child = id + 1; child < node.end; child = nodes_[child].end) {
            node.bounds.grow(nodes_[child].bounds);
            for (const DrawRange& range : octree_.ranges(NodeId{child})) add_to_range(range);
        }
        finish_ranges(node);
    }
}

/// Joins `range` to what the current node already has of that batch; it follows it without a gap.
void OctreeBuilder::add_to_range(const DrawRange& range) {
    std::uint32_t& slot = slot_of_batch_[index_of(range.batch)];
    if (slot == kNoSlot) {
        slot = static_cast<std::uint32_t>(node_ranges_.size());
        node_ranges_.push_back(range);
    } else {
        node_ranges_[slot].index_count += range.index_count;
    }
}

void OctreeBuilder::finish_ranges(OctreeNode& node) {
    std::ranges::sort(node_ranges_, {}, &DrawRange::batch);
    for (const DrawRange& range : node_ranges_) slot_of_batch_[index_of(range.batch)] = kNoSlot;
    node.first_range = static_cast<std::uint32_t>(ranges_.size());
    node.range_count = static_cast<std::uint32_t>(node_ranges_.size());
    ranges_.insert(ranges_.end(), node_ranges_.begin(), node_ranges_.end());
    node_ranges_.clear();
}

/// Hands every batch's base order out to the nodes, in pieces.
void OctreeBuilder::hand_out_pieces() {
    // Per batch: the end of the subtree that its last piece stands for.
    std::vector<std::uint32_t> covered_until(batches_.size(), 0);
    for (std::uint32_t id = 0; id < nodes_.size(); ++id) {
        nodes_[id].first_piece = static_cast<std::uint32_t>(pieces_.size());
        const bool leaf = octree_.is_leaf(NodeId{id});
        for (const DrawRange& range : octree_.ranges(NodeId{id})) {
            std::uint32_t& covered = covered_until[index_of(range.batch)];
            if (id < covered || (!leaf && range.index_count > options_.min_record_indices)) continue;
            covered = nodes_[id].end;
            pieces_.push_back({{}, range.batch, range.first_index, range.index_count, 0, 0});
            node_of_piece_.push_back(id);
        }
    }
    for (OctreeNode& node : nodes_)
        node.piece_end = node.end < nodes_.size() ? nodes_[node.end].first_piece
                                                  : static_cast<std::uint32_t>(pieces_.size());
}

/// Boxes and clusters of the pieces; the clusters of each chunk of pieces on their own, then one after the
/// other.
void OctreeBuilder::bound_pieces() {
    std::vector<PieceChunk> chunks((pieces_.size() + kPiecesTogether - 1) / kPiecesTogether);
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
        const std::size_t end = std::min((c + 1) * kPiecesTogether, pieces_.size());
        VertexCacheOrder order;
        for (std::size_t p = c * kPiecesTogether; p < end && !progress_.stopped(); ++p) {
            const std::size_t before = chunks[c].clusters.size();
            bound_piece(static_cast<std::uint32_t>(p), chunks[c].clusters);
            order_piece(static_cast<std::uint32_t>(p), std::span(chunks[c].clusters).subspan(before), order);
        }
        progress_.advance(kPiecesTogether);
    });
    for (const PieceChunk& chunk : chunks)
        clusters_.insert(clusters_.end(), chunk.clusters.begin(), chunk.clusters.end());
    std::uint32_t next = 0;
    for (OctreePiece& piece : pieces_) {
        piece.first_cluster = next;
        next += piece.cluster_count;
    }
}

void OctreeBuilder::bound_piece(std::uint32_t number, std::vector<NormalCluster>& clusters) {
    OctreePiece& piece = pieces_[number];
    const NodeId node{node_of_piece_[number]};
    const TriangleBatch& batch = batches_[index_of(piece.batch)];
    const std::span<const std::uint32_t> indices =
        octree_.indices().subspan(piece.first_index, piece.index_count);
    piece.bounds = octree_.node(node).bounds;
    if (octree_.node(node).range_count > 1) {
        piece.bounds = {};
        for (const std::uint32_t index : indices) piece.bounds.grow(batch.positions[index]);
    }
    const std::size_t before = clusters.size();
    if (!is_ordered(static_cast<std::uint32_t>(piece.batch))) {
        clusters.push_back({FacingCone(), piece.index_count});
    } else if (octree_.is_leaf(node)) {
        bound_leaf_piece(node_of_piece_[number], piece, clusters);
    } else {
        // Over several leaves the order would start anew in each: nothing to skip, so it must cost nothing.
        for (auto id = static_cast<std::uint32_t>(node); id < octree_.node(node).end; ++id)
            if (octree_.is_leaf(NodeId{id})) restore_source_order(id, piece.batch);
        append_clusters(batch.positions, indices, {}, options_.min_record_indices, clusters);
    }
    piece.cluster_count = static_cast<std::uint32_t>(clusters.size() - before);
}

/// In normal order where what is skipped saves more vertices than the order costs.
void OctreeBuilder::bound_leaf_piece(std::uint32_t leaf, const OctreePiece& piece,
                                     std::vector<NormalCluster>& clusters) {
    const std::span<const glm::vec3> positions = batches_[index_of(piece.batch)].positions;
    const std::span<const std::uint32_t> indices =
        octree_.indices().subspan(piece.first_index, piece.index_count);
    const std::size_t before = clusters.size();
    append_clusters(positions, indices,
                    cluster_of_triangle().subspan(piece.first_index / 3, piece.index_count / 3),
                    options_.min_record_indices, clusters);
    std::vector<std::uint32_t> source(indices.size());
    copy_source(leaf, piece.batch, source);
    const double ordered =
        expected_share(std::span(clusters).subspan(before)) * static_cast<double>(shaded_vertices(indices));
    if (ordered < kOrderPays * static_cast<double>(shaded_vertices(source))) return;
    clusters.resize(before);
    restore_source_order(leaf, piece.batch);
    append_clusters(positions, indices, {}, options_.min_record_indices, clusters);
}

/// Within a record triangles may stand in any order: that which the vertex cache likes best. Leaves stay
/// apart, and without normal order the source's order is kept.
void OctreeBuilder::order_piece(std::uint32_t number, std::span<const NormalCluster> clusters,
                                VertexCacheOrder& order) {
    const OctreePiece& piece = pieces_[number];
    if (!options_.normal_order || !octree_.is_leaf(NodeId{node_of_piece_[number]})) return;
    std::size_t first = piece.first_index;
    for (const NormalCluster& cluster : clusters) {
        order.apply(std::span(indices_).subspan(first, cluster.index_count),
                    std::span(cluster_of_triangle_).subspan(first / 3, cluster.index_count / 3));
        first += cluster.index_count;
    }
}

}  // namespace rhview
