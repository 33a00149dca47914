// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "query_writer.h"

namespace rhview {

QueryWriter::QueryWriter(std::span<const OcclusionCandidate> candidates, const QueryCosts& costs,
                         ItemHistories& histories, PendingQueries& pending, OcclusionDecisions& out)
    : candidates_(candidates), costs_(costs), histories_(histories), pending_(pending), out_(out) {}

double QueryWriter::ask(std::span<const std::uint32_t> members, QueryWay way, OcclusionAction action,
                        bool explores) {
    const AnswerCosts& price = costs(way);
    ScheduledQuery query;
    query.way = way;
    query.first_member = static_cast<std::uint32_t>(out_.members.size());
    query.member_count = static_cast<std::uint32_t>(members.size());
    const auto number = static_cast<std::uint32_t>(out_.queries.size());
    double ns = price.query_ns;
    for (const std::uint32_t member : members) {
        const OcclusionCandidate& candidate = candidates_[member];
        ItemHistory& item = histories_[candidate.item];
        ns += member_ns(price, candidate);
        if (action == OcclusionAction::QueryFirst) ns += conditional_ns(price, candidate);
        query.counts_samples |= candidate.counts_samples;
        out_.decisions[member] = {action, number};
        out_.members.push_back(member);
        pending_.add_member({candidate.item, item.belief});
        item.tested = histories_.frame();
        if (candidate.trial) histories_.begin_trial(candidate.item);
    }
    query.ticket = pending_.add_query(explores, nothing_in_front_ && action == OcclusionAction::QueryFirst);
    out_.queries.push_back(query);
    out_.query_ns += ns;
    if (bool& used = uses_[static_cast<std::size_t>(way)]; !used) {
        used = true;
        out_.query_ns += price.frame_ns;
    }
    return ns;
}

}  // namespace rhview
