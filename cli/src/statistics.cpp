// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "statistics.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "rhview/base/assert.h"

namespace rhview::cli {

Statistics summarise(std::span<const double> values) {
    RHVIEW_ASSERT(!values.empty());
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    const std::size_t n = sorted.size();
    Statistics result;
    result.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(n);
    result.median = 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
    result.p95 = sorted[(95 * n + 99) / 100 - 1];
    result.max = sorted.back();
    return result;
}

}  // namespace rhview::cli
