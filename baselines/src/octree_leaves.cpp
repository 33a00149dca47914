// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/octree_leaves.h"

namespace rhview {

void OctreeLeaves::plan(const FrameInput& input, FramePlan& plan) {
    const Frustum frustum = make_frustum(input.culling_view, input.scene_origin);
    leaf_draw_list(octree_, frustum, list_);
    finish_octree_plan(octree_, list_, frustum, input, sorter_, plan);
}

Aabb OctreeLeaves::bounds_of(std::uint32_t chosen) const {
    return octree_.node(NodeId{chosen}).bounds;
}

}  // namespace rhview
