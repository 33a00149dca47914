// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Surface area: Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007 (16 bins). Ids
// keep their order in both halves, so sums do not depend on how a library sorts.

#include "hierarchy_split.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rhview {
namespace {

constexpr int kBins = 16;

int longest_axis(const glm::vec3& extent) {
    if (extent.x >= extent.y && extent.x >= extent.z) return 0;
    return extent.y >= extent.z ? 1 : 2;
}

double half_area(const Aabb& box) {
    const glm::dvec3 e(box.extent());
    return box.is_empty() ? 0.0 : e.x * e.y + e.y * e.z + e.z * e.x;
}

struct Bin {
    Aabb bounds;
    std::size_t count = 0;
};

}  // namespace

Aabb bounds_for_hierarchy(const Aabb& box) {
    constexpr float kLimit = std::numeric_limits<float>::max();
    const bool proper = !box.is_empty() &&
                        glm::all(glm::lessThanEqual(glm::abs(box.min), glm::vec3(kLimit))) &&
                        glm::all(glm::lessThanEqual(glm::abs(box.max), glm::vec3(kLimit)));
    return proper ? box : Aabb{glm::vec3(-INFINITY), glm::vec3(INFINITY)};
}

HierarchySplitter::HierarchySplitter(std::span<const Aabb> boxes, HierarchySplit split)
    : boxes_(boxes), split_(split), scratch_(boxes.size()) {
    centres_.reserve(boxes.size());
    for (const Aabb& box : boxes) {
        const glm::vec3 centre = box.centre();
        // A box without a middle goes anywhere, but always to the same place.
        const bool finite = std::isfinite(centre.x) && std::isfinite(centre.y) && std::isfinite(centre.z);
        centres_.push_back(finite ? centre : glm::vec3(0.0f));
    }
}

template <class Goes>
std::size_t HierarchySplitter::partition(std::span<std::uint32_t> ids, const Goes& goes_first) {
    std::size_t first = 0, second = 0;
    for (const std::uint32_t id : ids)
        if (goes_first(id))
            ids[first++] = id;
        else
            scratch_[second++] = id;
    std::copy_n(scratch_.begin(), second, ids.begin() + static_cast<std::ptrdiff_t>(first));
    return first;
}

Aabb HierarchySplitter::centre_bounds(std::span<const std::uint32_t> ids) const {
    Aabb bounds;
    for (const std::uint32_t id : ids) bounds.grow(centres_[id]);
    return bounds;
}

std::size_t HierarchySplitter::divide(std::span<std::uint32_t> ids, HierarchySplit split) {
    if (split != HierarchySplit::Median) {
        const Plane plane = split == HierarchySplit::Mean ? mean_plane(ids) : area_plane(ids);
        const std::size_t first =
            partition(ids, [&](std::uint32_t id) { return centres_[id][plane.axis] < plane.position; });
        if (first > 0 && first < ids.size()) return first;
    }
    return divide_in_halves(ids);
}

std::size_t HierarchySplitter::divide_in_halves(std::span<std::uint32_t> ids) {
    const int axis = longest_axis(centre_bounds(ids).extent());
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        const float x = centres_[a][axis], y = centres_[b][axis];
        return x < y || (x == y && a < b);
    };
    const std::size_t half = ids.size() / 2;
    const auto begin = scratch_.begin(), middle = begin + static_cast<std::ptrdiff_t>(half);
    std::copy(ids.begin(), ids.end(), begin);
    std::nth_element(begin, middle, begin + static_cast<std::ptrdiff_t>(ids.size()), before);
    const std::uint32_t pivot = *middle;
    return partition(ids, [&](std::uint32_t id) { return before(id, pivot); });
}

HierarchySplitter::Plane HierarchySplitter::mean_plane(std::span<const std::uint32_t> ids) const {
    const int axis = longest_axis(centre_bounds(ids).extent());
    double sum = 0.0;
    for (const std::uint32_t id : ids) sum += centres_[id][axis];
    return {axis, static_cast<float>(sum / static_cast<double>(ids.size()))};
}

HierarchySplitter::Plane HierarchySplitter::area_plane(std::span<const std::uint32_t> ids) const {
    const Aabb centres = centre_bounds(ids);
    Plane best{longest_axis(centres.extent()), centres.min[longest_axis(centres.extent())]};
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const float low = centres.min[axis], width = centres.max[axis] - low;
        if (!(width > 0.0f)) continue;
        const float scale = static_cast<float>(kBins) / width;
        std::array<Bin, kBins> bins;
        for (const std::uint32_t id : ids) {
            Bin& bin = bins[std::clamp(static_cast<int>((centres_[id][axis] - low) * scale), 0, kBins - 1)];
            bin.bounds.grow(boxes_[id]);
            ++bin.count;
        }
        std::array<double, kBins> behind;  // cost of bins from i on
        Bin sum;
        for (int i = kBins - 1; i > 0; --i) {
            sum.bounds.grow(bins[i].bounds);
            behind[i] = half_area(sum.bounds) * static_cast<double>(sum.count += bins[i].count);
        }
        sum = {};
        for (int i = 0; i + 1 < kBins; ++i) {
            sum.bounds.grow(bins[i].bounds);
            sum.count += bins[i].count;
            const double cost = half_area(sum.bounds) * static_cast<double>(sum.count) + behind[i + 1];
            if (sum.count == 0 || sum.count == ids.size() || !(cost < least)) continue;
            least = cost;
            best = {axis, low + static_cast<float>(i + 1) / scale};
        }
    }
    return best;
}

}  // namespace rhview
