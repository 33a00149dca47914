// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The index lists of a mesh's levels, before anyone knows how good they are.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "rhview/base/build_progress.h"
#include "rhview/lod/lod_chain.h"

namespace rhview {

struct SimplifiedLevel {
    std::vector<std::uint32_t> indices;  ///< in an order for the vertex cache
    bool sloppy = false;
};

struct SimplifiedLevels {
    std::vector<SimplifiedLevel> levels;  ///< level 1 and on
    LodEnd end = LodEnd::Smallest;
};

/// Each level is made from the one before, `LodOptions::ratio` of it, until there are `min_triangles` or
/// nothing more can be taken away. Corners at one position are joined when seams stand in the way. The
/// positions are finite, the indices below their number. Empty if the build was stopped.
SimplifiedLevels simplify_to_levels(std::span<const glm::vec3> positions,
                                    std::span<const std::uint32_t> indices, const LodOptions& options,
                                    const BuildProgress& progress);

}  // namespace rhview
