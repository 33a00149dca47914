// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "multiqueries.h"

#include <algorithm>

namespace rhview {

void Multiqueries::reserve(std::size_t count) {
    candidates_.reserve(count);
    sorted_.reserve(count);
}

void Multiqueries::sort_by_rank(std::span<const CandidateOption> options) {
    for (std::size_t rank = 1; rank < starts_.size(); ++rank) starts_[rank] += starts_[rank - 1];
    sorted_.resize(candidates_.size());
    for (const std::uint32_t candidate : candidates_) sorted_[starts_[options[candidate].rank]++] = candidate;
}

/// The longest start of what is left whose overhead per member falls with each member. Overhead is what a
/// group costs beyond its members' boxes and those draws that are seen anyway: the query; and if one is seen,
/// the members' own queries in the next frame and the hidden ones drawn in vain.
std::size_t Multiqueries::group(std::span<const std::uint32_t> left, std::span<const CandidateOption> options,
                                std::span<const float> p_by_rank, const Price& price, double& p_all) {
    double render_ns = 0.0, seen_ns = 0.0, overhead_ns = kNever;
    p_all = 1.0;
    std::size_t count = 0;
    const std::size_t most = std::min<std::size_t>(price.most, left.size());
    while (count < most) {
        const CandidateOption& next = options[left[count]];
        const double p_next = p_by_rank[next.rank];
        const double next_ns = price.draws_on_it ? next.render_ns : 0.0;
        const double p = p_all * p_next;
        const double all_ns = render_ns + next_ns;
        const double some_ns = seen_ns + (1.0 - p_next) * next_ns;
        const double members = static_cast<double>(count) + 1.0;
        const double again_ns = count == 0 ? 0.0 : members * price.query_ns;
        const double overhead = price.query_ns + (1.0 - p) * (again_ns + all_ns) - some_ns;
        if (count > 0 && !(overhead * static_cast<double>(count) < overhead_ns * members)) break;
        p_all = p;
        render_ns = all_ns;
        seen_ns = some_ns;
        overhead_ns = overhead;
        ++count;
    }
    return count;
}

}  // namespace rhview
