// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/nested_grid.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace rhview {
namespace {

/// A grid of cubes; the last level's need not be divided further.
struct Grid {
    glm::dvec3 low{0.0};
    double cell = 1.0;
    glm::ivec3 cells{1};

    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
               static_cast<std::size_t>(cells.z);
    }
    [[nodiscard]] glm::ivec3 place(const glm::dvec3& point) const {
        return glm::clamp(glm::ivec3(glm::floor((point - low) / cell)), glm::ivec3(0), cells - 1);
    }
    [[nodiscard]] std::size_t index(const glm::ivec3& at) const {
        return (static_cast<std::size_t>(at.z) * static_cast<std::size_t>(cells.y) +
                static_cast<std::size_t>(at.y)) *
                   static_cast<std::size_t>(cells.x) +
               static_cast<std::size_t>(at.x);
    }
    [[nodiscard]] glm::dvec3 corner(std::size_t cell_index) const {
        const std::size_t x = cell_index % static_cast<std::size_t>(cells.x);
        const std::size_t rest = cell_index / static_cast<std::size_t>(cells.x);
        const std::size_t y = rest % static_cast<std::size_t>(cells.y);
        const std::size_t z = rest / static_cast<std::size_t>(cells.y);
        return low + cell * glm::dvec3(x, y, z);
    }
};

class GridBuilder {
  public:
    GridBuilder(std::span<const TriangleBatch> batches, const NestedGridOptions& options)
        : batches_(batches), options_(options) {
        std::uint32_t count = 0;
        for (const TriangleBatch& batch : batches) {
            first_triangle_.push_back(count);
            count += static_cast<std::uint32_t>(batch.indices.size() / 3);
        }
        first_triangle_.push_back(count);
        for (std::size_t b = 0; b < batches.size(); ++b) next_index_.push_back(3 * first_triangle_[b]);
    }

    OrderedTree build() {
        list_triangles();
        indices_.resize(3 * order_.size());
        if (!order_.empty()) divide(0, order_.size(), top_grid(), 1);
        return {CullTree::of_nodes(std::move(nodes_), std::move(ranges_)), std::move(indices_)};
    }

  private:
    void list_triangles() {
        const std::uint32_t count = first_triangle_.back();
        order_.resize(count);
        scratch_.resize(count);
        cell_.resize(count);
        centroids_.reserve(count);
        for (std::uint32_t t = 0; t < count; ++t) order_[t] = t;
        for (const TriangleBatch& batch : batches_)
            for (std::size_t i = 0; i < batch.indices.size(); i += 3) {
                const auto corner = [&](std::size_t c) { return batch.positions[batch.indices[i + c]]; };
                centroids_.push_back((corner(0) + corner(1) + corner(2)) / 3.0f);
            }
    }

    [[nodiscard]] Grid top_grid() const {
        Aabb bounds;
        for (const glm::vec3& centroid : centroids_) bounds.grow(centroid);
        const glm::dvec3 extent = glm::dvec3(bounds.max) - glm::dvec3(bounds.min);
        const double longest = std::max({extent.x, extent.y, extent.z, 1e-30});
        Grid grid{glm::dvec3(bounds.min), longest / std::max(options_.top_cells, 1u), glm::ivec3(1)};
        grid.cells = glm::max(glm::ivec3(glm::ceil(extent / grid.cell)), glm::ivec3(1));
        return grid;
    }

    /// Sorts order_ [first, end) by the cells of `grid`, stably, and adds a node for each that holds any.
    void divide(std::size_t first, std::size_t end, const Grid& grid, std::uint32_t level) {
        std::vector<std::size_t> place(grid.count() + 1, first);
        for (std::size_t i = first; i < end; ++i) {
            cell_[i] = static_cast<std::uint32_t>(grid.index(grid.place(glm::dvec3(centroids_[order_[i]]))));
            ++place[cell_[i] + 1];
        }
        for (std::size_t c = 1; c < place.size(); ++c) place[c] += place[c - 1] - first;
        std::vector<std::size_t> next(place.begin(), place.end() - 1);
        for (std::size_t i = first; i < end; ++i) scratch_[next[cell_[i]]++] = order_[i];
        std::copy(scratch_.begin() + static_cast<std::ptrdiff_t>(first),
                  scratch_.begin() + static_cast<std::ptrdiff_t>(end),
                  order_.begin() + static_cast<std::ptrdiff_t>(first));
        for (std::size_t c = 0; c + 1 < place.size(); ++c)
            if (place[c] < place[c + 1]) add_cell(place[c], place[c + 1], grid, c, level);
    }

    void add_cell(std::size_t first, std::size_t end, const Grid& grid, std::size_t cell,
                  std::uint32_t level) {
        const std::size_t added = nodes_.size();
        nodes_.emplace_back();
        if (level < options_.levels && end - first > options_.max_triangles) {
            const auto inner = static_cast<int>(std::max(options_.inner_cells, 2u));
            divide(first, end, {grid.corner(cell), grid.cell / inner, glm::ivec3(inner)}, level + 1);
            Aabb bounds;
            for (std::size_t c = added + 1; c < nodes_.size(); ++c) bounds.grow(nodes_[c].bounds);
            nodes_[added].bounds = bounds;
        } else {
            add_leaf(first, end, nodes_[added]);
        }
        nodes_[added].end = static_cast<std::uint32_t>(nodes_.size());
    }

    /// Triangles stand by number, so a batch's follow one another.
    void add_leaf(std::size_t first, std::size_t end, CullNode& leaf) {
        leaf.first_range = static_cast<std::uint32_t>(ranges_.size());
        std::size_t b = 0;
        for (std::size_t i = first; i < end; ++i) {
            const std::uint32_t triangle = order_[i];
            while (triangle >= first_triangle_[b + 1]) ++b;
            const BatchId batch{static_cast<std::uint32_t>(b)};
            if (ranges_.size() == leaf.first_range || ranges_.back().batch != batch)
                ranges_.push_back({batch, next_index_[b], 0});
            ranges_.back().index_count += 3;
            for (std::uint32_t c = 0; c < 3; ++c) {
                const std::uint32_t index = batches_[b].indices[3 * (triangle - first_triangle_[b]) + c];
                leaf.bounds.grow(batches_[b].positions[index]);
                indices_[next_index_[b]++] = index;
            }
        }
        leaf.range_count = static_cast<std::uint32_t>(ranges_.size()) - leaf.first_range;
    }

    std::span<const TriangleBatch> batches_;
    NestedGridOptions options_;
    std::vector<std::uint32_t> first_triangle_;  ///< by batch, and one more
    std::vector<std::uint32_t> next_index_;      ///< by batch: where its next triangle goes
    std::vector<glm::vec3> centroids_;
    std::vector<std::uint32_t> order_, scratch_, cell_;
    std::vector<std::uint32_t> indices_;
    std::vector<CullNode> nodes_;
    std::vector<DrawRange> ranges_;
};

}  // namespace

OrderedTree make_nested_grid(std::span<const TriangleBatch> batches, const NestedGridOptions& options) {
    return GridBuilder(batches, options).build();
}

}  // namespace rhview
