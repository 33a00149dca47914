// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/rhview_planner.h"

namespace rhview {

RhviewPlanner::RhviewPlanner(const RhOctree& octree, const DrawCosts& costs,
                             const std::optional<OcclusionOptions>& occlusion)
    : octree_(octree), costs_(costs), order_(octree) {
    if (occlusion) visibility_.emplace(octree, *occlusion);
}

void RhviewPlanner::absorb(std::span<const QueryAnswer> answers) {
    if (visibility_) visibility_->absorb(answers);
}

void RhviewPlanner::plan(const FrameInput& input, FramePlan& plan) {
    plan.clear();
    const Frustum frustum = make_frustum(input.culling_view, input.scene_origin);
    const Viewpoint viewpoint = make_viewpoint(input.culling_view, input.scene_origin);
    std::span<const NodeAlternative> alternatives;
    KnownContainment known;
    if (visibility_) {
        visibility_->decide(input, frustum, costs_, last_predicted_ns_, plan);
        alternatives = visibility_->alternatives();
        known = visibility_->known_containment();
    } else {
        append_visible_objects(frustum, input.object_boxes, plan.objects, input.object_alive);
    }
    solver_.solve(octree_, frustum, viewpoint, costs_, list_, alternatives, known);
    plan.opaque.assign(list_.ranges.begin(), list_.ranges.end());
    order_.sort(glm::vec3(frustum.eye), costs_.call_ns > 0.0, plan.opaque);
    if (visibility_) visibility_->append_conditional(list_.alternatives, plan);
#ifdef RHVIEW_DISHONEST_ANSWERS
    // For the tests that show that the checks can fail: what hangs on a query hangs on the next one.
    for (ConditionalRange& conditional : plan.conditional)
        conditional.query = (conditional.query + 1) % static_cast<std::uint32_t>(plan.queries.size());
#endif
    sorter_.sort(input.object_groups, plan);
    plan.predicted_ns = list_.predicted_ns + (plan.occlusion ? plan.occlusion->query_ns : 0.0);
    plan.nodes_visited = list_.nodes_visited + (visibility_ ? visibility_->nodes_visited() : 0);
    for (const NodeId node : list_.nodes) plan.chosen.push_back(static_cast<std::uint32_t>(node));
    last_predicted_ns_ = *plan.predicted_ns;
}

Aabb RhviewPlanner::bounds_of(std::uint32_t chosen) const {
    return octree_.node(NodeId{chosen}).bounds;
}

}  // namespace rhview
