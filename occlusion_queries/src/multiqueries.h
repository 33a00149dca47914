// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "candidate_option.h"

namespace rhview {

/// Items that are asked about together: one query sees nothing, or all of them are drawn and asked about
/// alone in the next frame. Source: CHC++'s multiqueries, with prices instead of counts (docs/occlusion.md).
class Multiqueries {
  public:
    struct Price {
        double query_ns = 0.0;
        std::uint32_t most = 1;   ///< members
        bool draws_on_it = true;  ///< what its members draw hangs on it, and is drawn in vain if one is seen
    };

    void clear() {
        candidates_.clear();
        starts_ = {};
    }
    void reserve(std::size_t count);
    void add(std::uint32_t candidate, std::uint8_t rank) {
        candidates_.push_back(candidate);
        ++starts_[rank + 1];
    }

    /// Calls `emit(candidates, p)` per group: p that all are hidden, by what is known of each. Descending
    /// p(hidden), ties as added. Linear. Once per `clear`.
    template <class Emit>
    void for_each_group(std::span<const CandidateOption> options, std::span<const float> p_by_rank,
                        const Price& price, Emit&& emit) {
        sort_by_rank(options);
        std::span<const std::uint32_t> left = sorted_;
        while (!left.empty()) {
            double p_all = 1.0;
            const std::size_t count = group(left, options, p_by_rank, price, p_all);
            emit(left.first(count), p_all);
            left = left.subspan(count);
        }
    }

  private:
    void sort_by_rank(std::span<const CandidateOption> options);
    static std::size_t group(std::span<const std::uint32_t> left, std::span<const CandidateOption> options,
                             std::span<const float> p_by_rank, const Price& price, double& p_all);

    std::array<std::uint32_t, OptionPricer::kRanks + 1>
        starts_{};  ///< counts of ranks, then places in sorted_
    std::vector<std::uint32_t> candidates_;
    std::vector<std::uint32_t> sorted_;
};

}  // namespace rhview
