// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Triangles ordered along the Morton curve of their centroids: the order in which an octree's leaves stand.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/build_progress.h"
#include "rhview/base/result.h"
#include "rhview/base/triangle_batch.h"
#include "triangle_ids.h"

namespace rhview {

inline constexpr int kMortonLevels = 21;  ///< three bits a level in 63

struct MortonTriangle {
    std::uint64_t code = 0;  ///< level l's octant is bits [3·(20 - l), 3·(20 - l) + 3)
    std::uint32_t id = 0;    ///< by `TriangleIds`
    std::uint32_t batch = 0;
};

/// Every index is in range, every corner finite, index counts are multiples of three and fit 32 bits
/// together; else the error that `build_octree` promises: of the first such triangle, whatever the number of
/// threads.
Status check_batches(std::span<const TriangleBatch> batches);

/// All triangles by code, as far as a cell of the octree has more than `cell_triangles`: within smaller cells
/// they stand in any order, the same one whatever the number of threads. The batches are checked. Cost: a
/// radix sort from the top, about one pass per four levels that are cut.
std::vector<MortonTriangle> sort_by_morton_code(std::span<const TriangleBatch> batches,
                                                const TriangleIds& ids, std::size_t cell_triangles,
                                                BuildProgress& progress);

}  // namespace rhview
