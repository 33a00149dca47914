// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "median_interval.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "statistics.h"

namespace rhview::cli {
namespace {

constexpr double kBeyond = 0.05;  ///< probability that the median lies outside, on either side together

/// The greatest k for which the k-th least and the k-th greatest of n values are far enough apart: the
/// median is outside with probability 2 P(B < k), B binomial (n, 1/2). 0: none. In logarithms, lest 2^-n
/// vanish.
std::size_t rank_of_bound(std::size_t n) {
    const auto count = static_cast<double>(n);
    double below = 0.0;
    for (std::size_t k = 0; k <= n / 2; ++k) {
        const auto hits = static_cast<double>(k);
        below += std::exp(std::lgamma(count + 1.0) - std::lgamma(hits + 1.0) -
                          std::lgamma(count - hits + 1.0) - count * std::log(2.0));
        if (2.0 * below > kBeyond) return k;
    }
    return n / 2;
}

}  // namespace

std::optional<MedianInterval> median_interval(std::span<const double> values) {
    const std::size_t rank = rank_of_bound(values.size());
    if (rank == 0) return {};
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    return MedianInterval{summarise(sorted).median, sorted[rank - 1], sorted[sorted.size() - rank]};
}

}  // namespace rhview::cli
