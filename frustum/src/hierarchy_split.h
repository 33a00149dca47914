// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Where to divide the boxes of a node.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/frustum/box_hierarchy.h"

namespace rhview {

/// The box, or all of space if it has a NaN, no end or min > max: what contains it in any case.
Aabb bounds_for_hierarchy(const Aabb& box);

/// Divides ids in place, both halves keep their order; neither is empty.
class HierarchySplitter {
  public:
    HierarchySplitter(std::span<const Aabb> boxes, HierarchySplit split);

    /// How many come first. `ids` has two at least. Falls back to halves where the split does not divide.
    std::size_t divide(std::span<std::uint32_t> ids, HierarchySplit split);
    std::size_t divide(std::span<std::uint32_t> ids) { return divide(ids, split_); }

  private:
    struct Plane {
        int axis = 0;
        float position = 0.0f;
    };
    [[nodiscard]] Plane mean_plane(std::span<const std::uint32_t> ids) const;
    [[nodiscard]] Plane area_plane(std::span<const std::uint32_t> ids) const;
    [[nodiscard]] Aabb centre_bounds(std::span<const std::uint32_t> ids) const;
    std::size_t divide_in_halves(std::span<std::uint32_t> ids);
    template <class Goes>
    std::size_t partition(std::span<std::uint32_t> ids, const Goes& goes_first);

    std::span<const Aabb> boxes_;
    HierarchySplit split_;
    std::vector<glm::vec3> centres_;
    std::vector<std::uint32_t> scratch_;
};

}  // namespace rhview
