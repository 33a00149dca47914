// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/timing_model/frame_budget.h"

#include <algorithm>
#include <cmath>

namespace rhview {
namespace {

/// Of fewer frames the largest is no bound on the next one.
constexpr std::size_t kEnough = 39;

}  // namespace

FrameBudget::FrameBudget(const std::optional<ResidualPercentiles>& residuals) {
    // Of (predicted - measured) / measured: the fifth percentile is a frame that took longer.
    if (residuals && residuals->p5 > -1.0) prior_ = std::max(1.0, 1.0 / (1.0 + residuals->p5));
}

void FrameBudget::observe(double predicted_ns, double measured_ns) {
    const double factor = measured_ns / predicted_ns;
    if (!(predicted_ns > 0.0) || !(measured_ns > 0.0) || !std::isfinite(factor)) return;
    factors_[seen_ % kRemembered] = factor;
    ++seen_;
}

double FrameBudget::margin() const {
    const std::size_t count = std::min(seen_, kRemembered);
    std::array<double, kRemembered> sorted = factors_;
    std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count));
    if (count < kEnough) return count == 0 ? prior_ : std::max(prior_, sorted[count - 1]);
    const auto rank = static_cast<std::size_t>(std::ceil(kBudgetShare * static_cast<double>(count + 1)));
    return sorted[std::min(rank, count) - 1];
}

}  // namespace rhview
