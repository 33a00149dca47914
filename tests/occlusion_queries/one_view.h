// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "rhview/occlusion_queries/occlusion_scheduler.h"

namespace rhview {

/// A scheduler whose answers a test chooses item by item.
class OneView {
  public:
    explicit OneView(const OcclusionSettings& settings, const QueryCosts& costs, std::size_t items = 100)
        : scheduler(settings, costs) {
        scheduler.resize(items);
    }

    /// One frame, with the answers to all queries of the last. `is_hidden` answers those of this one.
    const OcclusionDecisions& frame(const std::vector<OcclusionCandidate>& candidates,
                                    const std::function<bool(std::uint32_t)>& is_hidden,
                                    double frame_ns = 0.0, double screen_pixels = 0.0) {
        scheduler.absorb(answers);
        scheduler.begin_frame(frame_ns, screen_pixels);
        for (const OcclusionCandidate& candidate : candidates) scheduler.visit(candidate.item);
        scheduler.decide(candidates, decided);
        answers.clear();
        for (const ScheduledQuery& query : decided.queries) {
            bool visible = false;
            for (std::uint32_t i = 0; i < query.member_count; ++i) {
                visible |= !is_hidden(candidates[decided.members[query.first_member + i]].item);
            }
            answers.push_back({query.ticket, visible, 0});
        }
        return decided;
    }
    [[nodiscard]] OcclusionAction action(std::size_t candidate) const {
        return decided.decisions[candidate].action;
    }
    /// Members of the query that a candidate is in; 0 without.
    [[nodiscard]] std::uint32_t members(std::size_t candidate) const {
        const std::uint32_t query = decided.decisions[candidate].query;
        return query == OcclusionDecision::kNoQuery ? 0 : decided.queries[query].member_count;
    }
    [[nodiscard]] std::size_t count(OcclusionAction wanted) const {
        std::size_t found = 0;
        for (const OcclusionDecision& decision : decided.decisions)
            found += decision.action == wanted ? 1 : 0;
        return found;
    }

    OcclusionScheduler scheduler;
    OcclusionDecisions decided;
    std::vector<QueryAnswer> answers;
};

/// `count` items, each `render_ns` to draw and `pixels` big, the nearer the lower its number.
inline std::vector<OcclusionCandidate> row(std::uint32_t count, float render_ns, float pixels = 100) {
    std::vector<OcclusionCandidate> candidates;
    for (std::uint32_t i = 0; i < count; ++i) {
        candidates.push_back({i, render_ns, pixels, static_cast<float>(i + 1), 1, 1, true, false});
    }
    return candidates;
}

inline bool always(std::uint32_t) {
    return true;
}
inline bool never(std::uint32_t) {
    return false;
}

inline constexpr double kUnaffordable = 1e300;

/// Hardware queries alone, at `query_ns`.
inline QueryCosts hardware_costs(double query_ns) {
    return {{0, query_ns, 0, 0, 0}, {0, kUnaffordable, 0, 0, 0}};
}
/// The box pass alone.
inline QueryCosts box_pass_costs(double query_ns, double frame_ns = 0.0) {
    return {{0, kUnaffordable, 0, 0, 0}, {frame_ns, query_ns, 0, 0, 0}};
}

}  // namespace rhview
