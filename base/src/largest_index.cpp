// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/largest_index.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>

namespace rhview {

std::uint32_t largest_index(std::span<const std::uint32_t> indices) {
    constexpr std::size_t kGrain = std::size_t{1} << 16;  // 256 KiB: long against the start of a task
    const auto largest = [](std::uint32_t a, std::uint32_t b) { return std::max(a, b); };
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, indices.size(), kGrain), std::uint32_t{0},
        [&](const tbb::blocked_range<std::size_t>& part, std::uint32_t value) {
            for (std::size_t i = part.begin(); i < part.end(); ++i) value = std::max(value, indices[i]);
            return value;
        },
        largest);
}

}  // namespace rhview
