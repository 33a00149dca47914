// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "multiqueries.h"

#include <algorithm>
#include <array>

namespace rhview {

void Multiqueries::reserve(std::size_t count) {
    entries_.reserve(count);
    sorted_.reserve(count);
    candidates_.reserve(count);
}

void Multiqueries::sort_by_rank() {
    std::array<std::uint32_t, OptionPricer::kRanks + 1> starts{};
    for (const Entry& entry : entries_) ++starts[entry.rank + 1];
    for (std::size_t rank = 1; rank < starts.size(); ++rank) starts[rank] += starts[rank - 1];
    sorted_.resize(entries_.size());
    candidates_.resize(entries_.size());
    for (const Entry& entry : entries_) {
        const std::uint32_t place = starts[entry.rank]++;
        sorted_[place] = entry;
        candidates_[place] = entry.candidate;
    }
}

/// The longest start of what is left whose overhead per member falls with each member. Overhead is what a
/// group costs beyond its members' boxes and those draws that are seen anyway: the query; and if one is seen,
/// the members' own queries in the next frame and the hidden ones drawn in vain.
std::size_t Multiqueries::group_at(std::size_t first, double query_ns, std::uint32_t most,
                                   double& p_all) const {
    p_all = sorted_[first].p_hidden;
    double render_ns = sorted_[first].render_ns;
    double seen_ns = (1.0 - sorted_[first].p_hidden) * sorted_[first].render_ns;
    double overhead_ns = query_ns;
    std::size_t count = 1;
    while (count < most && first + count < sorted_.size()) {
        const Entry& next = sorted_[first + count];
        const double p = p_all * next.p_hidden;
        const double all_ns = render_ns + next.render_ns;
        const double some_ns = seen_ns + (1.0 - next.p_hidden) * next.render_ns;
        const double members = static_cast<double>(count) + 1.0;
        const double overhead = query_ns + (1.0 - p) * (members * query_ns + all_ns) - some_ns;
        if (!(overhead * static_cast<double>(count) < overhead_ns * members)) break;
        p_all = p;
        render_ns = all_ns;
        seen_ns = some_ns;
        overhead_ns = overhead;
        ++count;
    }
    return count;
}

}  // namespace rhview
