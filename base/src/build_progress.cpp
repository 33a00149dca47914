// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/build_progress.h"

#include <algorithm>

namespace rhview {
namespace {

// Steps smaller than this are not worth a call.
constexpr double kLeastStep = 0.005;

}  // namespace

void BuildProgress::begin_phase(double share, std::size_t steps) {
    begin_ = std::min(begin_ + share_, 1.0);
    share_ = share;
    steps_ = std::max<std::size_t>(steps, 1);
    done_ = 0;
    advance(0);
}

void BuildProgress::advance(std::size_t steps) {
    const std::size_t done = done_.fetch_add(steps, std::memory_order_relaxed) + steps;
    if (!callback_ || stopped()) return;
    const std::unique_lock lock(asking_, std::try_to_lock);
    if (!lock.owns_lock()) return;
    const double part = static_cast<double>(std::min(done, steps_)) / static_cast<double>(steps_);
    const double now = std::min(begin_ + share_ * part, 1.0);
    if (now < told_ + kLeastStep) return;
    told_ = now;
    if (!callback_(now)) stopped_ = true;
}

}  // namespace rhview
