// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A regular grid over a box, and sets of its cells.
///
/// Cell coordinates are the scene's, moved and scaled so that cell (x, y, z) is the unit cube from (x, y, z)
/// to (x + 1, y + 1, z + 1). Straight lines stay straight: visibility may be decided in them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "rhview/base/aabb.h"

namespace rhview {

/// Cells from `min` to `max`, both included; empty where min > max on an axis.
struct CellBox {
    glm::ivec3 min{0};
    glm::ivec3 max{-1};

    [[nodiscard]] bool is_empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
    /// Whether `cell` is one of the box's.
    [[nodiscard]] bool contains(const glm::ivec3& cell) const;
};

/// A box cut into equal cells, numbered along x first, then y, then z.
class CellGrid {
  public:
    CellGrid() = default;
    /// `bounds` is not empty, `cells` at least 1 on each axis. An axis without extent gets one metre.
    CellGrid(const Aabb& bounds, const glm::ivec3& cells);

    [[nodiscard]] const glm::ivec3& cells() const { return cells_; }
    [[nodiscard]] const glm::dvec3& cell_size() const { return cell_size_; }
    /// Of the whole grid.
    [[nodiscard]] std::size_t cell_count() const;
    /// The number of a cell of the grid.
    [[nodiscard]] std::size_t index(const glm::ivec3& cell) const {
        return (static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(cells_.y) +
                static_cast<std::size_t>(cell.y)) *
                   static_cast<std::size_t>(cells_.x) +
               static_cast<std::size_t>(cell.x);
    }
    /// The cell of that number: the inverse of `index`.
    [[nodiscard]] glm::ivec3 cell_at(std::size_t index) const;
    /// A scene position in units of cells, from the grid's low corner.
    [[nodiscard]] glm::dvec3 to_cells(const glm::dvec3& position) const {
        return (position - origin_) / cell_size_;
    }
    /// The inverse of `to_cells`.
    [[nodiscard]] glm::dvec3 from_cells(const glm::dvec3& position) const {
        return position * cell_size_ + origin_;
    }
    /// All cells that `box` may touch, also those that the grid does not have.
    [[nodiscard]] CellBox touched(const Aabb& box) const;
    /// What of `box` is in the grid; empty if nothing is.
    [[nodiscard]] CellBox clipped(const CellBox& box) const;
    /// Whether the grid has all of `box`.
    [[nodiscard]] bool holds(const CellBox& box) const;

  private:
    glm::dvec3 origin_{0.0};
    glm::dvec3 cell_size_{1.0};
    glm::ivec3 cells_{0};
};

/// Calls `use(cell)` for each cell, x fastest.
template <class Use>
void for_each_cell(const CellBox& box, Use&& use) {
    for (int z = box.min.z; z <= box.max.z; ++z)
        for (int y = box.min.y; y <= box.max.y; ++y)
            for (int x = box.min.x; x <= box.max.x; ++x) use(glm::ivec3(x, y, z));
}

/// The axes of a slab of cells: the bits of a row run along `u`, its rows along `v`.
struct SlabAxes {
    int u = 0;
    int v = 1;
};
/// Of the slabs that stand on `axis`.
constexpr SlabAxes slab_axes(int axis) {
    return axis == 0 ? SlabAxes{1, 2} : axis == 1 ? SlabAxes{0, 2} : SlabAxes{0, 1};
}

/// One bit per cell, readable slab by slab along each axis.
class CellSet {
  public:
    CellSet() = default;
    /// The empty set of a grid of so many cells.
    explicit CellSet(const glm::ivec3& cells);

    void insert(const glm::ivec3& cell) { change(cell, true); }
    void erase(const glm::ivec3& cell) { change(cell, false); }
    /// Whether `cell`, of the grid, was inserted.
    [[nodiscard]] bool contains(const glm::ivec3& cell) const;
    /// The row at `v` of a slab; the bit of `u` is bit u % 64 of word u / 64.
    [[nodiscard]] std::span<const std::uint64_t> row(int axis, int slab, int v) const;
    /// Takes all cells out and keeps the memory.
    void clear();

  private:
    void change(const glm::ivec3& cell, bool value);

    glm::ivec3 cells_{0};
    std::size_t x_words_ = 0;
    std::size_t y_words_ = 0;
    std::vector<std::uint64_t> along_x_;  ///< [z][y]
    std::vector<std::uint64_t> along_y_;  ///< [x][z]
};

}  // namespace rhview
