// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/draw_everything.h"

namespace rhview {

DrawEverything::DrawEverything(std::span<const std::uint32_t> batch_index_counts, const Aabb& scene_bounds)
    : bounds_(scene_bounds) {
    std::uint32_t first = 0;
    for (std::uint32_t b = 0; b < batch_index_counts.size(); ++b) {
        if (batch_index_counts[b] > 0) batches_.push_back({BatchId{b}, first, batch_index_counts[b]});
        first += batch_index_counts[b];
    }
}

void DrawEverything::plan(const FrameInput& input, FramePlan& plan) {
    plan.clear();
    plan.opaque = batches_;
    for (std::uint32_t i = 0; i < input.object_boxes.size(); ++i) plan.objects.push_back(ObjectId{i});
    sorter_.sort(input.object_groups, plan);
    plan.chosen.push_back(0);
}

Aabb DrawEverything::bounds_of(std::uint32_t) const {
    return bounds_;
}

}  // namespace rhview
