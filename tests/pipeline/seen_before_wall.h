// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <span>

#include "fake_gpu.h"
#include "rhview/pipeline/frame_plan.h"

namespace rhview {

/// A world with a wall at x = 20, looked at from smaller x: answers a plan's queries.
inline void ask_before_wall(const FramePlan& plan, FakeGpu& gpu) {
    for (const PlannedQuery& query : plan.queries) {
        const auto boxes = std::span(plan.query_boxes).subspan(query.first_box, query.box_count);
        gpu.ask(
            {query.ticket, std::ranges::any_of(boxes, [](const Aabb& box) { return box.min.x < 20.0f; }), 1});
    }
}

}  // namespace rhview
