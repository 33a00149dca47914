// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/frustum/box_batch.h"

#include <algorithm>

#include "box_kernels.h"
#include "box_test.h"
#include "rhview/base/assert.h"

namespace rhview {
namespace {

// Views in one pass: their planes stand on the stack.
constexpr std::size_t kViewsAtOnce = 16;

void set_box(std::vector<float>* values, std::size_t i, const Aabb& box) {
    for (int axis = 0; axis < 3; ++axis) {
        values[axis][i] = box.min[axis];
        values[axis + 3][i] = box.max[axis];
    }
}

}  // namespace

BoxSpans BoxSpans::subspan(std::size_t first, std::size_t length) const {
    return {min_x + first, min_y + first, min_z + first, max_x + first, max_y + first, max_z + first, length};
}

void BoxArrays::assign(std::span<const Aabb> boxes) {
    for (std::vector<float>& values : values_) values.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) set_box(values_, i, boxes[i]);
}

void BoxArrays::resize(std::size_t count) {
    const Aabb empty;
    for (int axis = 0; axis < 3; ++axis) {
        values_[axis].resize(count, empty.min[axis]);
        values_[axis + 3].resize(count, empty.max[axis]);
    }
}

void BoxArrays::set(std::size_t i, const Aabb& box) {
    set_box(values_, i, box);
}

BoxSpans BoxArrays::spans() const {
    return {values_[0].data(),
            values_[1].data(),
            values_[2].data(),
            values_[3].data(),
            values_[4].data(),
            values_[5].data(),
            size()};
}

KernelPlanes kernel_planes(const Frustum& frustum, PlaneMask mask) {
    KernelPlanes result;
    for (int axis = 0; axis < 3; ++axis) result.eye[axis] = frustum.box_eye[axis];
    for (std::size_t i = 0; i < frustum.box_planes.size(); ++i) {
        if ((mask >> i & 1u) == 0) continue;
        const BoxPlane& plane = frustum.box_planes[i];
        const glm::vec3& n = plane.normal;
        const unsigned octant = (n.x >= 0 ? 1u : 0u) | (n.y >= 0 ? 2u : 0u) | (n.z >= 0 ? 4u : 0u);
        result.planes[result.count++] = {n.x, n.y, n.z, plane.outside_distance, octant};
    }
    return result;
}

void cull_boxes(const Frustum& frustum, const BoxSpans& boxes, std::span<std::uint64_t> visible) {
    cull_boxes({&frustum, 1}, boxes, visible);
}

void cull_boxes(const Frustum& frustum, std::span<const Aabb> boxes, std::span<std::uint64_t> visible) {
    RHVIEW_ASSERT(visible.size() >= visibility_words(boxes.size()));
    cull_aabbs(kernel_planes(frustum, frustum.mask), boxes.data(), boxes.size(), visible.data());
}

void cull_boxes(std::span<const Frustum> views, const BoxSpans& boxes, std::span<std::uint64_t> visible) {
    const std::size_t words = visibility_words(boxes.count);
    RHVIEW_ASSERT(visible.size() >= words * views.size());
    KernelPlanes planes[kViewsAtOnce];
    for (std::size_t first = 0; first < views.size(); first += kViewsAtOnce) {
        const std::size_t count = std::min(kViewsAtOnce, views.size() - first);
        for (std::size_t v = 0; v < count; ++v)
            planes[v] = kernel_planes(views[first + v], views[first + v].mask);
        cull_arrays(planes, count, boxes, visible.data() + first * words);
    }
}

void cull_boxes_scalar(const Frustum& frustum, const BoxSpans& boxes, std::span<std::uint64_t> visible) {
    RHVIEW_ASSERT(visible.size() >= visibility_words(boxes.count));
    std::fill_n(visible.begin(), visibility_words(boxes.count), std::uint64_t{0});
    for (std::size_t i = 0; i < boxes.count; ++i) {
        PlaneMask mask = frustum.mask;
        const bool outside = classify(frustum, boxes[i], mask) == Containment::Outside;
        visible[i / 64] |= std::uint64_t{!outside} << (i % 64);
    }
}

}  // namespace rhview
