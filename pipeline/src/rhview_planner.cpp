// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/rhview_planner.h"

namespace rhview {

void RhviewPlanner::plan(const FrameInput& input, FramePlan& plan) {
    plan.clear();
    const Frustum frustum = make_frustum(input.culling_view, input.scene_origin);
    const Viewpoint viewpoint = make_viewpoint(input.culling_view, input.scene_origin);
    solver_.solve(octree_, frustum, viewpoint, costs_, list_);
    plan.opaque.assign(list_.ranges.begin(), list_.ranges.end());
    plan.predicted_ns = list_.predicted_ns;
    plan.nodes_visited = list_.nodes_visited;
    for (const NodeId node : list_.nodes) plan.chosen.push_back(static_cast<std::uint32_t>(node));
    append_visible_objects(frustum, input.object_boxes, plan.objects);
}

Aabb RhviewPlanner::bounds_of(std::uint32_t chosen) const {
    return octree_.node(NodeId{chosen}).bounds;
}

}  // namespace rhview
