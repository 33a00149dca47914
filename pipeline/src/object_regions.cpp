// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/object_regions.h"

#include <algorithm>
#include <array>
#include <bit>

#include "rhview/base/assert.h"
#include "rhview/frustum/box_batch.h"

namespace rhview {
namespace {

/// Regions are made anew when their surfaces have grown by this factor: a surface is what a region is seen
/// by.
constexpr double kGrown = 2.0;
/// But not more often than once in so many frames, where everything flies apart all the time.
constexpr std::uint32_t kLeastAge = 30;
/// Or when this share of the objects, and more than one region's worth, is in none.
constexpr std::size_t kLooseShare = 8;

double area_of(const Aabb& box) {
    const glm::dvec3 e(box.max - box.min);
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

}  // namespace

double ObjectRegions::leaf_area() const {
    double area = 0.0;
    const std::span<const HierarchyNode> nodes = tree_.nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].escape == i + 1) area += area_of(nodes[i].bounds);
    return area;
}

bool ObjectRegions::update(std::span<const Aabb> boxes, std::uint32_t objects_per_region) {
    RHVIEW_ASSERT(objects_per_region >= 1 && objects_per_region <= kMostObjects);
    ++age_;
    const std::size_t held = object_count();
    const std::size_t loose = boxes.size() - std::min(boxes.size(), held);
    const bool fits =
        held > 0 && held <= boxes.size() && loose <= std::max<std::size_t>(kMostObjects, held / kLooseShare);
    if (fits) {
        tree_.refit(boxes.first(held));
        // Not a number, or endless: what is in there is drawn, whatever its region.
        if (age_ < kLeastAge || !(leaf_area() > kGrown * area_when_made_)) return false;
    }
    HierarchyOptions options;
    options.max_leaf_boxes = objects_per_region;
    tree_ = BoxHierarchy(boxes, options);
    objects_per_region_ = objects_per_region;
    area_when_made_ = leaf_area();
    age_ = 0;
    region_count_ = 0;
    region_of_node_.clear();
    const std::span<const HierarchyNode> nodes = tree_.nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const bool leaf = nodes[i].escape == i + 1;
        region_of_node_.push_back(static_cast<std::uint32_t>(region_count_));
        if (leaf) ++region_count_;
    }
    return true;
}

void ObjectRegions::cull(const Frustum& frustum, std::span<const std::uint64_t> alive,
                         std::vector<RegionInView>& visible) const {
    visible.clear();
    const std::span<const HierarchyNode> nodes = tree_.nodes();
    constexpr std::uint32_t kMostDepth = 64;
    std::array<PlaneMask, kMostDepth + 1> masks;
    masks[0] = frustum.mask;
    for (std::uint32_t i = 0; i < nodes.size();) {
        const HierarchyNode& node = nodes[i];
        PlaneMask mask = masks[node.depth];
        if (mask != 0 && classify(frustum, node.bounds, mask) == Containment::Outside) {
            i = node.escape;
            continue;
        }
        if (node.escape != i + 1) {
            masks[node.depth + 1] = mask;
            ++i;
            continue;
        }
        RegionInView region{region_of_node_[i], node.first, 0};
        cull_boxes(frustum, tree_.boxes().subspan(node.first, node.count), {&region.objects, 1});
        if (!alive.empty())
            for (std::uint64_t rest = region.objects; rest != 0; rest &= rest - 1) {
                const std::size_t id =
                    index_of(order()[node.first + static_cast<std::size_t>(std::countr_zero(rest))]);
                if ((alive[id / 64] >> (id % 64) & 1) == 0) region.objects &= ~(rest & ~(rest - 1));
            }
        if (region.objects != 0) visible.push_back(region);
        ++i;
    }
}

}  // namespace rhview
