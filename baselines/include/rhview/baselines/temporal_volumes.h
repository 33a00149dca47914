// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Temporal bounding volumes: boxes of cells that hold hidden moving objects for some frames.
///
/// Only the hull of a box is kept, as the outlines of its projections in three matrices of cells, xy, xz and
/// yz: a cell lies on the hull exactly if it lies on at least two outlines. A ray that comes from outside of
/// the box crosses the hull, so that a box is found by whoever follows rays into it cell by cell.
/// Sources: Sudarsky & Gotsman 1999; Batagelo 2002, section 3.4.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/ids.h"
#include "rhview/baselines/cell_grid.h"

namespace rhview {

/// Volumes of objects in a grid, and when each ends.
class TemporalVolumes {
  public:
    static constexpr std::uint32_t kLongestPeriod = 256;  ///< frames

    TemporalVolumes() = default;
    /// None yet, for a grid of `cells` and objects numbered below `object_count`.
    TemporalVolumes(const glm::ivec3& cells, std::size_t object_count);

    /// The object, which has no volume, stays in `box`, cells of the grid, through the next `period` - 1
    /// frames; 1 <= `period` <= `kLongestPeriod`. Cost: the length of the box's edges in cells.
    void insert(ObjectId object, const CellBox& box, std::uint32_t period);
    /// The object has a volume. Cost: as `insert`.
    void remove(ObjectId object);
    [[nodiscard]] bool has(ObjectId object) const { return place_[index_of(object)] != kNone; }
    [[nodiscard]] std::size_t size() const { return boxes_.size(); }

    /// Starts the next frame and appends the objects whose volume is over, in the order of their ids; they
    /// keep it until removed.
    void next_frame(std::vector<ObjectId>& expired);
    /// Appends the objects on whose hull the cell lies, some perhaps twice. Cost: the shorter lists of two of
    /// the three matrices at the cell.
    void find_at(const glm::ivec3& cell, std::vector<ObjectId>& found) const;
    /// Appends the objects whose volume has the cell, inside or on its hull. Cost: 12 bytes read per volume.
    void find_around(const glm::ivec3& cell, std::vector<ObjectId>& found) const;

  private:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    static constexpr std::uint32_t kHead = 0x80000000u;

    /// An object in the list of a cell of a matrix; the nodes of one object are chained too.
    struct Node {
        std::uint32_t object = kNone;
        std::uint32_t cell = 0;
        std::uint32_t previous = kNone;  ///< in the cell
        std::uint32_t next = kNone;      ///< in the cell
        std::uint32_t sibling = kNone;   ///< of the object
    };

    struct SmallBox {
        std::array<std::int16_t, 3> min, max;
    };

    [[nodiscard]] std::size_t cell_of(int matrix, int a, int b) const;
    void add_outline(int matrix, const CellBox& box, std::uint32_t object);
    void unlink_due(std::uint32_t object);
    void add_node(std::uint32_t cell, std::uint32_t object);
    [[nodiscard]] bool on_hull(std::uint32_t place, const glm::ivec3& cell) const;

    glm::ivec3 cells_{0};
    std::array<std::size_t, 3> matrix_first_{};
    std::vector<std::uint32_t> heads_;    ///< of the matrices' cells
    std::vector<std::uint32_t> lengths_;  ///< of their lists
    std::vector<Node> nodes_;
    std::uint32_t free_ = kNone;
    std::vector<std::uint32_t> first_node_;  ///< of an object
    std::vector<std::uint32_t> place_;       ///< of an object in `boxes_`
    std::vector<SmallBox> boxes_;            ///< of living volumes, in no order
    std::vector<std::uint32_t> owner_;
    std::uint32_t frame_ = 0;
    std::array<std::uint32_t, kLongestPeriod + 1> due_{};  ///< first object of a list, by frame
    std::vector<std::uint32_t> next_due_;
    std::vector<std::uint32_t> previous_due_;  ///< or `kHead` and its list
};

}  // namespace rhview
