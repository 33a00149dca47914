// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Clusters of normals: Zhang & Hoff, "Fast backface culling using normal masks", 1997. The orders are our
// own: the axis-aligned one is the best of all 720, those of the cones were searched by
// benchmarks/cluster_order_search.

#include "rhview/rhoctree/normal_clusters.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cluster_tables.h"
#include "rhview/base/assert.h"

namespace rhview {
namespace {

constexpr std::size_t kMostClusters = 64;

// By axis, then by sign: the place in +x, +y, -x, +z, -y, -z.
constexpr std::array<std::array<std::uint32_t, 2>, 3> kAxisPlaces{{{0, 2}, {1, 4}, {3, 5}}};

// A face of a scene that was turned by a right angle is off its axis by the rounding of the corners.
constexpr double kAxisTangent = 0x1p-16;

int main_axis(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

std::uint32_t nearest_cone(const glm::dvec3& normal, std::span<const glm::vec3, kConeClusters> centres) {
    std::uint32_t best = 0;
    double best_dot = -1.0;
    for (std::uint32_t i = 0; i < kConeClusters; ++i) {
        const double dot = glm::dot(normal, glm::dvec3(centres[i]));
        if (dot > best_dot) {
            best_dot = dot;
            best = i;
        }
    }
    return best;
}

/// Skippable clusters between two that are not.
struct Gap {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
    std::uint64_t index_count = 0;
};

/// The clusters to draw with as many ranges as it takes, as a mask.
std::uint64_t needed_clusters(std::span<const std::uint32_t> index_counts, std::uint64_t skippable) {
    std::uint64_t needed = 0;
    for (std::size_t i = 0; i < index_counts.size(); ++i)
        if (index_counts[i] != 0 && (skippable >> i & 1u) == 0) needed |= std::uint64_t{1} << i;
    return needed;
}

std::size_t find_gaps(std::span<const std::uint32_t> index_counts, std::uint64_t needed,
                      std::array<Gap, kMostClusters>& gaps) {
    std::size_t count = 0;
    std::uint32_t last = static_cast<std::uint32_t>(std::countr_zero(needed));
    for (std::uint64_t rest = needed & (needed - 1); rest != 0; rest &= rest - 1) {
        const auto next = static_cast<std::uint32_t>(std::countr_zero(rest));
        Gap gap{last + 1, next, 0};
        for (std::uint32_t i = gap.first; i < gap.end; ++i) gap.index_count += index_counts[i];
        // A gap without an index saves none, and would cost a range.
        if (gap.index_count != 0) gaps[count++] = gap;
        last = next;
    }
    return count;
}

}  // namespace

glm::dvec3 face_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::dvec3 corner(a);
    return glm::cross(glm::dvec3(b) - corner, glm::dvec3(c) - corner);
}

std::span<const glm::vec3, kConeClusters> cone_centres(int max_ranges) {
    RHVIEW_ASSERT(max_ranges >= 1 && max_ranges <= kMaxClusterRanges);
    return kConeCentres[static_cast<std::size_t>(std::clamp(max_ranges, 1, kMaxClusterRanges) - 1)];
}

std::uint32_t cluster_of(ClusterScheme scheme, const glm::dvec3& normal, int max_ranges) {
    if (!(glm::dot(normal, normal) > 0.0)) return 0;
    if (scheme == ClusterScheme::Cones) return nearest_cone(normal, cone_centres(max_ranges));
    const int axis = main_axis(normal);
    return kAxisPlaces[static_cast<std::size_t>(axis)][normal[axis] < 0.0 ? 1 : 0];
}

ClusterScheme choose_scheme(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 normal =
            face_normal(positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]);
        const glm::dvec3 size = glm::abs(normal);
        const double along = std::max({size.x, size.y, size.z});
        if (size.x + size.y + size.z - along > kAxisTangent * along) return ClusterScheme::Cones;
    }
    return ClusterScheme::AxisAligned;
}

ClusterCover cover_ranges(std::span<const std::uint32_t> index_counts, std::uint64_t skippable,
                          std::span<ClusterRange> ranges) {
    RHVIEW_ASSERT(index_counts.size() <= kMostClusters && !ranges.empty());
    ClusterCover cover;
    const std::uint64_t needed = needed_clusters(index_counts, skippable);
    if (needed == 0) return cover;
    std::array<Gap, kMostClusters> gaps;
    const std::size_t gap_count = find_gaps(index_counts, needed, gaps);
    const std::size_t kept = std::min(gap_count, ranges.size() - 1);
    const auto begin = gaps.begin(), end = begin + static_cast<std::ptrdiff_t>(gap_count);
    const auto middle = begin + static_cast<std::ptrdiff_t>(kept);
    std::partial_sort(begin, middle, end, [](const Gap& a, const Gap& b) {
        return a.index_count != b.index_count ? a.index_count > b.index_count : a.first < b.first;
    });
    std::sort(begin, middle, [](const Gap& a, const Gap& b) { return a.first < b.first; });

    const auto first = static_cast<std::uint32_t>(std::countr_zero(needed));
    const auto past = static_cast<std::uint32_t>(std::bit_width(needed));
    for (std::uint32_t i = first; i < past; ++i) cover.index_count += index_counts[i];
    ranges[0] = {first, past};
    for (auto gap = begin; gap != middle; ++gap) {
        cover.index_count -= gap->index_count;
        ranges[cover.range_count++].end = gap->first;
        ranges[cover.range_count] = {gap->end, past};
    }
    ++cover.range_count;
    return cover;
}

}  // namespace rhview
