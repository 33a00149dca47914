// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// How much of a frame budget may be planned for, when predictions are as wrong as they have been.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "rhview/timing_model/fit.h"

namespace rhview {

/// The share of frames that a budget is planned to hold for. Frames that follow one another are alike and
/// then change all at once: of the twentieth that may miss, half is left to that.
inline constexpr double kBudgetShare = 0.975;

/// Remembers by what factor the last frames took longer than was predicted. The margin is the factor that
/// `kBudgetShare` of them stayed within, counted as for one more frame of their kind: the ⌈0.975·(n + 1)⌉-th
/// of n. Source: Vovk, Gammerman & Shafer 2005, "Algorithmic learning in a random world" (inductive conformal
/// prediction). No allocation.
class FrameBudget {
  public:
    /// Until enough frames were seen, the margin is the largest of them or of the profile's residuals,
    /// whichever is greater. Without residuals: 1.5.
    explicit FrameBudget(const std::optional<ResidualPercentiles>& residuals);

    /// A frame; times that are not positive and finite are ignored.
    void observe(double predicted_ns, double measured_ns);

    /// Measured over predicted, as it must be reckoned with.
    [[nodiscard]] double margin() const;
    /// What a frame may be predicted to take so that it holds `budget_ns`.
    [[nodiscard]] double plannable_ns(double budget_ns) const { return budget_ns / margin(); }

  private:
    static constexpr std::size_t kRemembered = 120;

    double prior_ = 1.5;
    std::array<double, kRemembered> factors_{};  ///< a ring
    std::size_t seen_ = 0;
};

}  // namespace rhview
