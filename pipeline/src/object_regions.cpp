// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/object_regions.h"

#include <algorithm>
#include <bit>

#include "rhview/base/assert.h"
#include "rhview/frustum/box_batch.h"

namespace rhview {
namespace {

/// Regions are made anew when their surfaces have grown by this factor: a surface is what a region is seen
/// by. Temporal bounding volumes alone make some of it.
constexpr double kGrown = 4.0;
/// But not more often than once in so many frames, where everything flies apart all the time.
constexpr std::uint32_t kLeastAge = 30;
/// Or when this share of the objects, and more than a leaf's worth, is in none.
constexpr std::size_t kLooseShare = 8, kLoose = 64;

double area_of(const Aabb& box) {
    const glm::dvec3 e(box.max - box.min);
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

}  // namespace

double ObjectRegions::leaf_area() const {
    double area = 0.0;
    for (std::uint32_t i = 0; i < nodes().size(); ++i)
        if (is_leaf(i)) area += area_of(nodes()[i].bounds);
    return area;
}

bool ObjectRegions::update(std::span<const Aabb> boxes, std::uint32_t per_leaf) {
    ++age_;
    const std::size_t held = object_count();
    const std::size_t loose = boxes.size() - std::min(boxes.size(), held);
    if (held > 0 && held <= boxes.size() && loose <= std::max(kLoose, held / kLooseShare)) {
        tree_.refit(boxes.first(held));
        // Not a number, or endless: then that region is drawn, and the others go on.
        if (age_ < kLeastAge || !(leaf_area() > kGrown * area_when_made_)) return false;
    }
    HierarchyOptions options;
    options.max_leaf_boxes = per_leaf;
    tree_ = BoxHierarchy(boxes, options);
    area_when_made_ = leaf_area();
    age_ = 0;
    return true;
}

void ObjectRegions::find_in_view(std::uint32_t node, const Frustum& frustum,
                                 std::vector<std::uint64_t>& words) const {
    const HierarchyNode& region = nodes()[node];
    words.resize(visibility_words(region.count));
    cull_boxes(frustum, tree_.boxes().subspan(region.first, region.count), words);
}

std::size_t ObjectRegions::lowest_bit(std::uint64_t word) {
    return static_cast<std::size_t>(std::countr_zero(word));
}

}  // namespace rhview
