// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <set>
#include <span>

#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// What a draw list costs by its definition: each range a draw, each batch a call.
inline double price(std::span<const DrawRange> ranges, const DrawCosts& costs) {
    double total_ns = 0.0;
    std::set<BatchId> batches;
    for (const DrawRange& range : ranges) {
        total_ns += costs.draw_ns + costs.index_ns * range.index_count;
        batches.insert(range.batch);
    }
    return total_ns + costs.call_ns * static_cast<double>(batches.size());
}

}  // namespace rhview
