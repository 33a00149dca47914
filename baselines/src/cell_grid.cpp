// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/cell_grid.h"

#include <algorithm>

namespace rhview {
namespace {

/// Of a cell: more than what the way of a float position into cell coordinates rounds.
constexpr double kSlackCells = 1e-4;

}  // namespace

bool CellBox::contains(const glm::ivec3& cell) const {
    return cell.x >= min.x && cell.x <= max.x && cell.y >= min.y && cell.y <= max.y && cell.z >= min.z &&
           cell.z <= max.z;
}

CellGrid::CellGrid(const Aabb& bounds, const glm::ivec3& cells) : origin_(bounds.min), cells_(cells) {
    for (int a = 0; a < 3; ++a) {
        const double extent = static_cast<double>(bounds.max[a]) - static_cast<double>(bounds.min[a]);
        cell_size_[a] = (extent > 0.0 ? extent : 1.0) / cells[a];
    }
}

std::size_t CellGrid::cell_count() const {
    return static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) *
           static_cast<std::size_t>(cells_.z);
}

glm::ivec3 CellGrid::cell_at(std::size_t index) const {
    const auto x_cells = static_cast<std::size_t>(cells_.x);
    const auto y_cells = static_cast<std::size_t>(cells_.y);
    return {static_cast<int>(index % x_cells), static_cast<int>(index / x_cells % y_cells),
            static_cast<int>(index / (x_cells * y_cells))};
}

// A box on the grid's own border belongs to the border's cells alone.
CellBox CellGrid::touched(const Aabb& box) const {
    const glm::dvec3 low = to_cells(glm::dvec3(box.min)), high = to_cells(glm::dvec3(box.max));
    CellBox result;
    for (int a = 0; a < 3; ++a) {
        const double first = std::floor(std::clamp(low[a] - kSlackCells, -1e9, 1e9));
        const double last = std::floor(std::clamp(high[a] + kSlackCells, -1e9, 1e9));
        result.min[a] = first == -1.0 && low[a] > -2 * kSlackCells ? 0 : static_cast<int>(first);
        result.max[a] = last == cells_[a] && high[a] < cells_[a] + 2 * kSlackCells ? cells_[a] - 1
                                                                                   : static_cast<int>(last);
    }
    return result;
}

CellBox CellGrid::clipped(const CellBox& box) const {
    return {glm::max(box.min, glm::ivec3(0)), glm::min(box.max, cells_ - 1)};
}

bool CellGrid::holds(const CellBox& box) const {
    return box.min.x >= 0 && box.min.y >= 0 && box.min.z >= 0 && box.max.x < cells_.x &&
           box.max.y < cells_.y && box.max.z < cells_.z;
}

CellSet::CellSet(const glm::ivec3& cells)
    : cells_(cells),
      x_words_((static_cast<std::size_t>(cells.x) + 63) / 64),
      y_words_((static_cast<std::size_t>(cells.y) + 63) / 64),
      along_x_(x_words_ * static_cast<std::size_t>(cells.y) * static_cast<std::size_t>(cells.z)),
      along_y_(y_words_ * static_cast<std::size_t>(cells.z) * static_cast<std::size_t>(cells.x)) {}

void CellSet::change(const glm::ivec3& cell, bool value) {
    const auto x = static_cast<std::size_t>(cell.x), y = static_cast<std::size_t>(cell.y),
               z = static_cast<std::size_t>(cell.z);
    std::uint64_t& a = along_x_[(z * static_cast<std::size_t>(cells_.y) + y) * x_words_ + x / 64];
    std::uint64_t& b = along_y_[(x * static_cast<std::size_t>(cells_.z) + z) * y_words_ + y / 64];
    const std::uint64_t a_bit = std::uint64_t{1} << (x % 64), b_bit = std::uint64_t{1} << (y % 64);
    a = value ? a | a_bit : a & ~a_bit;
    b = value ? b | b_bit : b & ~b_bit;
}

bool CellSet::contains(const glm::ivec3& cell) const {
    return (row(2, cell.z, cell.y)[static_cast<std::size_t>(cell.x) / 64] >> (cell.x % 64) & 1) != 0;
}

std::span<const std::uint64_t> CellSet::row(int axis, int slab, int v) const {
    const auto s = static_cast<std::size_t>(slab), r = static_cast<std::size_t>(v);
    if (axis == 0)
        return {along_y_.data() + (s * static_cast<std::size_t>(cells_.z) + r) * y_words_, y_words_};
    const std::size_t z = axis == 1 ? r : s, y = axis == 1 ? s : r;
    return {along_x_.data() + (z * static_cast<std::size_t>(cells_.y) + y) * x_words_, x_words_};
}

void CellSet::clear() {
    std::fill(along_x_.begin(), along_x_.end(), 0);
    std::fill(along_y_.begin(), along_y_.end(), 0);
}

}  // namespace rhview
