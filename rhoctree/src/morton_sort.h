// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Triangles ordered along the Morton curve of their centroids: the order in which an octree's leaves stand.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/base/triangle_batch.h"

namespace rhview {

inline constexpr int kMortonLevels = 21;  ///< three bits a level in 63

struct MortonTriangle {
    std::uint64_t code = 0;  ///< level l's octant is bits [3·(20 - l), 3·(20 - l) + 3)
    std::uint32_t batch = 0;
    std::uint32_t triangle = 0;  ///< within its batch
};

/// All triangles by code; those of equal code stay in source order. Errors as `build_octree` says.
Result<std::vector<MortonTriangle>> sort_by_morton_code(std::span<const TriangleBatch> batches);

}  // namespace rhview
