// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/draw_order.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "rhview/base/assert.h"

namespace rhview {
namespace {

// Of squared distances as floats: two steps of the exponent are a factor of two of the distance.
constexpr int kSlabShift = 24;

// Before the farthest; what is nearer is in the first.
constexpr std::uint32_t kSlabs = 12;

}  // namespace

DrawOrder::DrawOrder(const RhOctree& octree) : batch_count_(octree.batch_count()) {
    places_.reserve(octree.pieces().size() + octree.replicas().size());
    for (const OctreePiece& piece : octree.pieces()) places_.push_back({piece.first_index, piece.bounds});
    for (const OctreeReplica& replica : octree.replicas())
        places_.push_back({replica.first_index, octree.node(replica.node).bounds});
    std::ranges::sort(places_, {}, &Place::first_index);
}

/// The place that holds `index`. Galloping: the ranges of a batch follow one another.
std::size_t DrawOrder::find_place(std::uint32_t index, std::size_t from) const {
    if (places_[from].first_index > index) from = 0;
    std::size_t step = 1;
    while (from + step < places_.size() && places_[from + step].first_index <= index) {
        from += step;
        step *= 2;
    }
    const auto first = places_.begin() + static_cast<std::ptrdiff_t>(from);
    const auto last = places_.begin() + static_cast<std::ptrdiff_t>(std::min(from + step, places_.size()));
    return static_cast<std::size_t>(std::ranges::upper_bound(first, last, index, {}, &Place::first_index) -
                                    places_.begin() - 1);
}

std::uint32_t DrawOrder::find_slab(const glm::vec3& eye, const DrawRange& range, std::size_t place) const {
    const std::uint32_t end = range.first_index + range.index_count;
    float nearest = std::numeric_limits<float>::max();
    for (; place < places_.size() && places_[place].first_index < end; ++place) {
        const glm::vec3 to = glm::clamp(eye, places_[place].bounds.min, places_[place].bounds.max) - eye;
        nearest = std::min(nearest, glm::dot(to, to));
    }
    return std::bit_cast<std::uint32_t>(nearest) >> kSlabShift;
}

void DrawOrder::sort(const glm::vec3& eye, bool keeps_batches, std::vector<DrawRange>& ranges) {
    if (ranges.empty()) return;
    slab_of_.clear();
    std::size_t place = 0;
    std::uint32_t farthest = 0;
    for (const DrawRange& range : ranges) {
        place = find_place(range.first_index, place);
        slab_of_.push_back(find_slab(eye, range, place));
        farthest = std::max(farthest, slab_of_.back());
    }
    // A stable counting sort.
    const std::uint32_t first = farthest + 1 - std::min(farthest + 1, kSlabs);
    offset_.assign(kSlabs * batch_count_ + 1, 0);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        RHVIEW_ASSERT(index_of(ranges[i].batch) < batch_count_);
        const std::size_t slab = std::max(slab_of_[i], first) - first, batch = index_of(ranges[i].batch);
        slab_of_[i] =
            static_cast<std::uint32_t>(keeps_batches ? batch * kSlabs + slab : slab * batch_count_ + batch);
        ++offset_[slab_of_[i] + 1];
    }
    for (std::size_t i = 1; i < offset_.size(); ++i) offset_[i] += offset_[i - 1];
    sorted_.resize(ranges.size());
    for (std::size_t i = 0; i < ranges.size(); ++i) sorted_[offset_[slab_of_[i]]++] = ranges[i];
    ranges.swap(sorted_);
}

}  // namespace rhview
