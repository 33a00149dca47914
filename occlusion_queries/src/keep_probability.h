// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "learned_rates.h"

namespace rhview {

/// p_keep(i): that an item which answered hidden i times in a row still is. It starts as certainty −
/// doubt·e^−i (Mattausch, Bittner & Wimmer 2008), and answers then move each of its points.
class KeepProbability {
  public:
    /// Beyond, the exponential is below 10⁻⁶: one level.
    static constexpr std::uint32_t kLast = 15;

    KeepProbability(double certainty, double doubt, double prior_answers, double memory) {
        // Powers of e by multiplication: std::exp differs in the last bit between libraries.
        constexpr double kInverseE = 0.36787944117144233;
        double power = doubt;
        learned_.reserve(kLast + 1);
        for (std::uint32_t i = 0; i <= kLast; ++i) {
            learned_.emplace_back(std::clamp(certainty - power, 0.0, 1.0), prior_answers, memory);
            power *= kInverseE;
        }
        take_in();
    }

    [[nodiscard]] double operator()(std::uint32_t hidden_answers) const {
        return table_[std::min(hidden_answers, kLast)];
    }
    /// An item with so many hidden answers was asked about among `members`.
    void add(std::uint32_t hidden_answers, bool visible, std::uint32_t members) {
        // A shared query that saw something saw about one of its members.
        const double seen = visible ? 1.0 / members : 0.0;
        learned_[std::min(hidden_answers, kLast)].add(1.0 - seen, seen);
    }
    void take_in() {
        for (std::uint32_t i = 0; i <= kLast; ++i) {
            learned_[i].take_in();
            table_[i] = learned_[i].mean();
        }
    }
    /// The most answers, at least one, that give no more confidence than `p`.
    [[nodiscard]] std::uint32_t answers_for(double p) const {
        std::uint32_t answers = 1;
        while (answers < kLast && table_[answers + 1] <= p) ++answers;
        return answers;
    }

  private:
    std::vector<LearnedProbability> learned_;
    std::array<double, kLast + 1> table_{};
};

}  // namespace rhview
