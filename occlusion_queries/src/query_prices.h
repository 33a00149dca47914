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
inline float usable_render_ns(float render_ns) {
    return render_ns > 0.0f ? std::min(render_ns, 1e15f) : 0.0f;
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
/// probability `p_seen` each, it pays q/n, and if one is seen all are drawn and asked again alone:
/// p_seen·(n·q + (n−1)·render), to first order. The least over n ≤ `most` is at n = q/s,
/// s = √(q·p_seen·(q + render)).
inline float query_share_ns(float query_ns, float p_seen, float render_ns, float most) {
    const float step = std::sqrt(query_ns * p_seen * (query_ns + render_ns));
    if (!(step < query_ns) || most <= 1.0f) return query_ns;
    const float free = 2.0f * step - p_seen * render_ns;
    const float full = query_ns / most + p_seen * (most * query_ns + (most - 1.0f) * render_ns);
    return std::min(query_ns, step * most < query_ns ? full : free);  // alone, nobody asks again
}

}  // namespace rhview
