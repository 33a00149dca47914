// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <bit>
#include <vector>

#include "rhview/frustum/box_hierarchy.h"

namespace rhview {

/// `first` is not below the end of the last range; neighbours are joined.
inline void append_range(std::vector<OrderRange>& ranges, std::uint32_t first, std::uint32_t count) {
    if (!ranges.empty() && ranges.back().first + ranges.back().count == first)
        ranges.back().count += count;
    else
        ranges.push_back({first, count});
}

/// Bit i stands for place first + i.
inline void append_bits(std::vector<OrderRange>& ranges, std::uint32_t first, std::uint64_t bits) {
    while (bits != 0) {
        const int skip = std::countr_zero(bits), run = std::countr_one(bits >> skip);
        append_range(ranges, first + static_cast<std::uint32_t>(skip), static_cast<std::uint32_t>(run));
        if (skip + run == 64) break;
        bits &= ~std::uint64_t{0} << (skip + run);
    }
}

}  // namespace rhview
