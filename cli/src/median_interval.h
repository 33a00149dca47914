// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>

namespace rhview::cli {

struct MedianInterval {
    double median = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// The median with a confidence interval of at least 95 %, whatever the values' distribution: two of the
/// sorted values, as far in as the binomial distribution allows. It takes the values as independent.
/// Nothing where there are fewer than six: no two of them make 95 %. Source: David & Nagaraja, Order
/// Statistics, 3rd ed., section 7.1.
std::optional<MedianInterval> median_interval(std::span<const double> values);

}  // namespace rhview::cli
