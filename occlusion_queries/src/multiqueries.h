// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

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
    struct Entry {
        std::uint32_t candidate = 0;
        float p_hidden = 0.0f;
        float render_ns = 0.0f;  ///< drawn in vain if another member is seen
        std::uint8_t rank = 0;   ///< below OptionPricer::kRanks
    };

    void clear() { entries_.clear(); }
    void reserve(std::size_t count);
    void add(const Entry& entry) { entries_.push_back(entry); }

    /// Calls `emit(candidates, p)` per group: p that all are hidden, by what is known of each. Descending
    /// p_hidden, ties as added. Linear.
    template <class Emit>
    void for_each_group(double query_ns, std::uint32_t most, Emit&& emit) {
        sort_by_rank();
        for (std::size_t first = 0; first < sorted_.size();) {
            double p_all = 1.0;
            const std::size_t count = group_at(first, query_ns, most, p_all);
            emit(std::span<const std::uint32_t>(candidates_).subspan(first, count), p_all);
            first += count;
        }
    }

  private:
    void sort_by_rank();
    std::size_t group_at(std::size_t first, double query_ns, std::uint32_t most, double& p_all) const;

    std::vector<Entry> entries_;
    std::vector<Entry> sorted_;
    std::vector<std::uint32_t> candidates_;  ///< of `sorted_`
};

}  // namespace rhview
