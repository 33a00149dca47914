// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/frustum_objects.h"

namespace rhview {

FrustumObjects::FrustumObjects(std::vector<StaticObject> objects) : objects_(std::move(objects)) {}

void FrustumObjects::plan(const FrameInput& input, FramePlan& plan) {
    plan.clear();
    const Frustum frustum = make_frustum(input.culling_view, input.scene_origin);
    for (std::uint32_t i = 0; i < objects_.size(); ++i) {
        PlaneMask mask = frustum.mask;
        if (classify(frustum, objects_[i].bounds, mask) == Containment::Outside) continue;
        plan.opaque.push_back(objects_[i].range);
        plan.chosen.push_back(i);
    }
    append_visible_objects(frustum, input.object_boxes, plan.objects);
    plan.nodes_visited = objects_.size();
}

Aabb FrustumObjects::bounds_of(std::uint32_t chosen) const {
    return objects_[chosen].bounds;
}

}  // namespace rhview
