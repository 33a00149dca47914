// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "rhview/baselines/cell_grid.h"

namespace rhview {

/// From the point to the nearest and to the farthest point of a cell, metres.
struct Distances {
    double nearest = 0.0;
    double farthest = 0.0;
};
inline Distances distances_to_cell(const glm::dvec3& point, const CellGrid& grid, const glm::ivec3& cell) {
    const glm::dvec3 low = grid.from_cells(glm::dvec3(cell)) - point;
    const glm::dvec3 high = grid.from_cells(glm::dvec3(cell) + 1.0) - point;
    const glm::dvec3 nearest = glm::max(glm::max(low, -high), glm::dvec3(0.0));
    return {glm::length(nearest), glm::length(glm::max(glm::abs(low), glm::abs(high)))};
}

inline bool touch(const Aabb& box, const glm::dvec3& point) {
    for (int a = 0; a < 3; ++a)
        if (point[a] < static_cast<double>(box.min[a]) || point[a] > static_cast<double>(box.max[a]))
            return false;
    return true;
}

}  // namespace rhview
