// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>

#include "item_history.h"
#include "pending_queries.h"
#include "query_prices.h"
#include "rhview/occlusion_queries/occlusion_scheduler.h"

namespace rhview {

/// Writes the queries of one frame: into its decisions, the pending ones and the histories, and adds up what
/// they cost.
class QueryWriter {
  public:
    QueryWriter(std::span<const OcclusionCandidate> candidates, const QueryCosts& costs,
                ItemHistories& histories, PendingQueries& pending, OcclusionDecisions& out);

    /// One query about all `members` (candidates), each of which gets `action`. Returns its price, without
    /// the way's own.
    double ask(std::span<const std::uint32_t> members, QueryWay way, OcclusionAction action,
               bool explores = false);
    /// From now on, for what hangs on its query.
    void set_nothing_in_front(bool nothing) { nothing_in_front_ = nothing; }
    [[nodiscard]] bool uses(QueryWay way) const { return uses_[static_cast<std::size_t>(way)]; }
    [[nodiscard]] const AnswerCosts& costs(QueryWay way) const {
        return way == QueryWay::HardwareQuery ? costs_.hardware : costs_.box_pass;
    }

  private:
    std::span<const OcclusionCandidate> candidates_;
    const QueryCosts& costs_;
    ItemHistories& histories_;
    PendingQueries& pending_;
    OcclusionDecisions& out_;
    bool nothing_in_front_ = false;
    bool uses_[2] = {false, false};
};

}  // namespace rhview
