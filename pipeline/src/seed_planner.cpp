// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/seed_planner.h"

namespace rhview {
namespace {

const RhOctree kNoNodes{};

}  // namespace

SeedPlanner::SeedPlanner(const RhOctree& octree, const DrawCosts& costs, const OcclusionOptions& occlusion)
    : octree_(octree), costs_(costs) {
    objects_.emplace(kNoNodes, occlusion);
}

void SeedPlanner::absorb(std::span<const QueryAnswer> answers) {
    if (objects_) objects_->absorb(answers);
}

void finish_octree_plan(const RhOctree& octree, const NodeList& list, const Frustum& frustum,
                        const FrameInput& input, PlanSorter& sorter, FramePlan& plan) {
    plan.clear();
    append_ranges(octree, list, plan.opaque);
    sorter.ranges.sort(plan.opaque, octree.batch_count());
    append_visible_objects(frustum, input.object_boxes, plan.objects);
    sorter.objects.sort(input.object_groups, plan);
    for (const NodeId node : list.nodes) plan.chosen.push_back(static_cast<std::uint32_t>(node));
    plan.nodes_visited = list.nodes_visited;
}

void SeedPlanner::plan(const FrameInput& input, FramePlan& plan) {
    const Frustum frustum = make_frustum(input.culling_view, input.scene_origin);
    seed_draw_list(octree_, frustum, list_);
    FrameInput octree_input = input;
    if (objects_) octree_input.object_boxes = {};
    finish_octree_plan(octree_, list_, frustum, octree_input, sorter_, plan);
    if (!objects_) return;
    double static_ns = 0.0;
    for (const DrawRange& range : plan.opaque)
        static_ns += costs_.draw_ns + costs_.index_ns * range.index_count;
    objects_->decide(input, frustum, costs_, static_ns, plan);
    sorter_.objects.sort(input.object_groups, plan);
}

Aabb SeedPlanner::bounds_of(std::uint32_t chosen) const {
    return octree_.node(NodeId{chosen}).bounds;
}

}  // namespace rhview
