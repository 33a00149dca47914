// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Whether index values stay inside their vertices.
#pragma once

#include <cstdint>
#include <span>

namespace rhview {

/// The largest of `indices`, 0 if there are none. Cost: one pass, on all of oneTBB's threads.
std::uint32_t largest_index(std::span<const std::uint32_t> indices);

/// Whether every index is below `vertex_count`. Cost: that of `largest_index`.
inline bool all_below(std::span<const std::uint32_t> indices, std::uint64_t vertex_count) {
    return indices.empty() || largest_index(indices) < vertex_count;
}

}  // namespace rhview
