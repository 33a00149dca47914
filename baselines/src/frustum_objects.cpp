// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/frustum_objects.h"

#include <bit>
#include <utility>

namespace rhview {

FrustumObjects::FrustumObjects(std::vector<StaticObject> objects)
    : objects_(std::move(objects)), visible_(visibility_words(objects_.size())) {
    boxes_.resize(objects_.size());
    for (std::size_t i = 0; i < objects_.size(); ++i) boxes_.set(i, objects_[i].bounds);
}

void FrustumObjects::plan(const FrameInput& input, FramePlan& plan) {
    plan.clear();
    const Frustum frustum = make_frustum(input.culling_view, input.scene_origin);
    cull_boxes(frustum, boxes_.spans(), visible_);
    for (std::size_t word = 0; word < visible_.size(); ++word)
        for (std::uint64_t rest = visible_[word]; rest != 0; rest &= rest - 1) {
            const std::size_t i = 64 * word + static_cast<std::size_t>(std::countr_zero(rest));
            plan.opaque.push_back(objects_[i].range);
            plan.chosen.push_back(static_cast<std::uint32_t>(i));
        }
    append_visible_objects(frustum, input.object_boxes, plan.objects);
    sorter_.sort(input.object_groups, plan);
    plan.nodes_visited = objects_.size();
}

Aabb FrustumObjects::bounds_of(std::uint32_t chosen) const {
    return objects_[chosen].bounds;
}

}  // namespace rhview
