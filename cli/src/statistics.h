// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>

namespace rhview::cli {

struct Statistics {
    double mean = 0.0;
    double median = 0.0;  ///< mean of the middle two when the count is even
    double p95 = 0.0;     ///< nearest rank
    double max = 0.0;
};

/// `values` is not empty.
Statistics summarise(std::span<const double> values);

}  // namespace rhview::cli
