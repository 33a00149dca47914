// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "rhview/occlusion_queries/occlusion_scheduler.h"
#include "rhview/occlusion_queries/query.h"

namespace rhview {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// Costs to reckon with: what is not known (NaN, below 0) is never paid.
inline AnswerCosts usable_costs(const AnswerCosts& costs) {
    const auto usable = [](double ns) { return ns >= 0.0 ? ns : kNever; };
    return {usable(costs.frame_ns), usable(costs.query_ns), usable(costs.box_ns), usable(costs.pixel_ns),
            usable(costs.draw_ns)};
}

/// What drawing costs, if it is known; else 0: nothing is gained by leaving it out, so it is drawn.
inline double usable_render_ns(float render_ns) {
    return render_ns > 0.0f ? std::min<double>(render_ns, 1e15) : 0.0;
}

/// What `candidate` adds to a query, without the query itself. NaN where a factor is unknown: no comparison
/// with it holds, so nothing is asked.
inline double member_ns(const AnswerCosts& costs, const OcclusionCandidate& candidate) {
    return candidate.boxes * costs.box_ns + static_cast<double>(candidate.pixels) * costs.pixel_ns;
}

inline double conditional_ns(const AnswerCosts& costs, const OcclusionCandidate& candidate) {
    return candidate.draws * costs.draw_ns;
}

/// What a member of a multiquery pays for the query: of n alike, that take `render_ns` each and are seen with
/// probability `p_seen` each, one saves the others' queries unless it is seen, and then all are drawn and
/// asked again: q/n + p_seen·(n·q + (n−1)·render), to first order in p_seen, at the best n up to `most`.
inline double query_share_ns(double query_ns, double p_seen, double render_ns, double most) {
    if (!(query_ns < kNever)) return kNever;
    const double alone = query_ns;
    if (query_ns == 0.0 || most <= 1.0) return alone;
    const double best = std::sqrt(query_ns / (p_seen * (query_ns + render_ns)));
    const double members = std::clamp(best, 1.0, most);
    const double shared = query_ns / members + p_seen * (members * query_ns + (members - 1.0) * render_ns);
    return std::min(alone, shared);
}

}  // namespace rhview
