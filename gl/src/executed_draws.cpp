// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "rhview/gl/executor.h"

namespace rhview::gl {

ExecutedDraws count_executed(const FramePlan& plan, const SceneBuffers& scene,
                             std::span<const QueryAnswer> answers) {
    enum class Seen : std::uint8_t { Unknown, Yes, No };
    std::vector<QueryAnswer> by_ticket(answers.begin(), answers.end());
    std::ranges::sort(by_ticket, {}, &QueryAnswer::ticket);
    std::vector<Seen> seen;
    for (const PlannedQuery& query : plan.queries) {
        const auto found = std::ranges::lower_bound(by_ticket, query.ticket, {}, &QueryAnswer::ticket);
        const bool known = found != by_ticket.end() && found->ticket == query.ticket;
        seen.push_back(!known ? Seen::Unknown : found->visible ? Seen::Yes : Seen::No);
    }
    ExecutedDraws executed;
    const auto add = [&](std::uint32_t query, std::uint32_t indices) {
        if (seen[query] == Seen::No) return;
        const bool known = seen[query] == Seen::Yes;
        (known ? executed.sub_draws : executed.unknown_sub_draws) += 1;
        (known ? executed.indices : executed.unknown_indices) += indices;
    };
    for (const ConditionalRange& range : plan.conditional) add(range.query, range.range.index_count);
    for (const ConditionalObject& object : plan.conditional_objects)
        add(object.query, scene.objects()[index_of(object.object)].index_count);
    return executed;
}

}  // namespace rhview::gl
