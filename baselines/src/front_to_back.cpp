// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "front_to_back.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rhview {
namespace {

// Drawing widens boxes by a part of a pixel, which makes those at the near plane covers of the whole picture.
constexpr float kNearMargin = 1e-3f;

bool comes_later(const FrontToBack::Entry& a, const FrontToBack::Entry& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.node > b.node;
}

}  // namespace

void FrontToBack::begin(const CullTree& tree, const Frustum& frustum) {
    tree_ = &tree;
    frustum_ = &frustum;
    eye_ = glm::vec3(frustum.eye);
    heap_.clear();
}

void FrontToBack::push(std::uint32_t node, PlaneMask mask) {
    const Aabb& box = tree_->nodes()[node].bounds;
    const glm::vec3 beside = glm::max(glm::max(box.min - eye_, eye_ - box.max), 0.0f);
    const float distance = glm::dot(beside, beside);
    // A box that is not made of numbers is looked at first: heaps need an order.
    heap_.push_back({distance >= 0.0f ? distance : 0.0f, node, mask});
    std::ranges::push_heap(heap_, comes_later);
}

void FrontToBack::push_children(const Entry& entry) {
    const std::span<const CullNode> nodes = tree_->nodes();
    for (std::uint32_t c = entry.node + 1; c < nodes[entry.node].end; c = nodes[c].end) push(c, entry.mask);
}

FrontToBack::Entry FrontToBack::pop() {
    std::ranges::pop_heap(heap_, comes_later);
    const Entry entry = heap_.back();
    heap_.pop_back();
    return entry;
}

FrontToBack::Place FrontToBack::place(Entry& entry) const {
    const Aabb& box = tree_->nodes()[entry.node].bounds;
    // An empty mask: inside, so is everything below.
    if (entry.mask != 0 && classify(*frustum_, box, entry.mask) == Containment::Outside)
        return Place::Outside;
    return is_at_eye(box) ? Place::AtEye : Place::InSight;
}

bool FrontToBack::is_at_eye(const Aabb& box) const {
    const glm::vec3 half = 0.5f * (box.max - box.min);
    const glm::vec3 from_eye = 0.5f * (box.max + box.min) - eye_;
    const glm::vec3 reach = kNearMargin * (glm::abs(from_eye) + half);
    const float margin = reach.x + reach.y + reach.z;
    const glm::vec3 beside = glm::abs(from_eye) - half;
    const FrustumPlane& near = frustum_->planes[Frustum::Near];
    const float nearest =
        glm::dot(near.normal, from_eye) - glm::dot(glm::abs(near.normal), half) + near.distance - near.slack;
    // Written so that NaN is at the eye.
    return !(std::max({beside.x, beside.y, beside.z}) > margin && nearest > margin);
}

}  // namespace rhview
