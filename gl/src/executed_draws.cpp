// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <tuple>

#include "object_drawer.h"
#include "rhview/gl/executor.h"

namespace rhview::gl {

ExecutedDraws count_executed(const FramePlan& plan, const SceneBuffers& scene,
                             std::span<const QueryAnswer> answers, std::span<const glm::dmat4> placements) {
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
    const auto add = [&](std::uint32_t query, std::uint32_t indices, bool new_range) {
        if (seen[query] == Seen::No) return;
        const bool known = seen[query] == Seen::Yes;
        (known ? executed.sub_draws : executed.unknown_sub_draws) += new_range ? 1 : 0;
        (known ? executed.indices : executed.unknown_indices) += indices;
    };
    for (const ConditionalRange& range : plan.conditional) add(range.query, range.range.index_count, true);
    // Neighbours of one mesh, level, mirroring and query are instances of one draw.
    const auto draw_of = [&](const ConditionalObject& object) {
        const std::size_t id = index_of(object.object);
        return std::tuple(object.query, object.level, scene.object_meshes()[id],
                          is_mirrored(id < placements.size() ? placements[id] : scene.placements()[id]));
    };
    for (std::size_t i = 0; i < plan.conditional_objects.size(); ++i) {
        const ConditionalObject& object = plan.conditional_objects[i];
        const bool new_range = i == 0 || draw_of(object) != draw_of(plan.conditional_objects[i - 1]);
        add(object.query,
            scene.level_range(scene.object_meshes()[index_of(object.object)], object.level).index_count,
            new_range);
    }
    return executed;
}

}  // namespace rhview::gl
