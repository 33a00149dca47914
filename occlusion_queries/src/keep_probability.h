// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace rhview {

/// p_keep(i) = certainty − doubt·e^−i: that an item which answered hidden i times in a row still is
/// (Mattausch, Bittner & Wimmer 2008). Beyond `kLast` the exponential is below 10⁻⁶: one level.
class KeepProbability {
  public:
    static constexpr std::uint32_t kLast = 15;

    KeepProbability(double certainty, double doubt) {
        // Powers of e by multiplication: std::exp differs in the last bit between libraries.
        constexpr double kInverseE = 0.36787944117144233;
        double power = std::max(doubt, 0.0);
        for (double& p : table_) {
            p = std::clamp(certainty - power, 0.0, 1.0 - 1e-6);
            power *= kInverseE;
        }
    }

    [[nodiscard]] double operator()(std::uint32_t hidden_answers) const {
        return table_[std::min(hidden_answers, kLast)];
    }
    /// The most answers, at least one, that give no more confidence than `p`.
    [[nodiscard]] std::uint32_t answers_for(double p) const {
        std::uint32_t answers = 1;
        while (answers < kLast && table_[answers + 1] <= p) ++answers;
        return answers;
    }

  private:
    std::array<double, kLast + 1> table_{};
};

}  // namespace rhview
