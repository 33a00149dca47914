// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/index_check.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>

namespace rhview {
namespace {

constexpr std::uint32_t kTopBit = 0x80000000u;

/// For `last` below 2^31: an index above it has its own top bit set, or that of last - index. Two operations
/// that every vector unit has, where a comparison of unsigned numbers takes more.
bool none_above(std::span<const std::uint32_t> indices, std::uint32_t last) {
    std::uint32_t bits = 0;
    for (const std::uint32_t index : indices) bits |= index | (last - index);
    return (bits & kTopBit) == 0;
}

bool part_below(std::span<const std::uint32_t> indices, std::uint64_t vertex_count) {
    if (vertex_count <= kTopBit) return none_above(indices, static_cast<std::uint32_t>(vertex_count - 1));
    return std::ranges::all_of(indices, [&](std::uint32_t index) { return index < vertex_count; });
}

}  // namespace

bool all_below(std::span<const std::uint32_t> indices, std::uint64_t vertex_count) {
    if (indices.empty() || vertex_count == 0) return indices.empty();
    constexpr std::size_t kGrain = std::size_t{1} << 16;  // 256 KiB: long against the start of a task
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, indices.size(), kGrain), true,
        [&](const tbb::blocked_range<std::size_t>& part, bool below) {
            return below && part_below(indices.subspan(part.begin(), part.size()), vertex_count);
        },
        [](bool a, bool b) { return a && b; });
}

}  // namespace rhview
