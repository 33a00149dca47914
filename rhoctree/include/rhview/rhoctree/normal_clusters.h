// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Groups of triangles by normal, in an order in which the groups that any view sees from the front lie in
/// few ranges.
///
/// Sort a node's triangles by `cluster_of`, bound each cluster with `bound_facing`, and at run time let
/// `cover_ranges` find what is left to draw of those that `faces_away` cannot prove to be turned away. How
/// much that saves is measured in docs/normal-order.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace rhview {

/// Which table sorts normals into clusters.
enum class ClusterScheme : std::uint8_t {
    AxisAligned,  ///< +x, +y, -x, +z, -y, -z: the fronts of each view octant lie in at most two ranges
    Cones,        ///< the sphere of normals in `kConeClusters` cells
};

/// Clusters of `AxisAligned`: the sides of a cube.
inline constexpr std::uint32_t kAxisClusters = 6;
/// Clusters of `Cones`; as many as bits of a word.
inline constexpr std::uint32_t kConeClusters = 64;
/// There is an order of cones for at most 1, 2 or 3 ranges.
inline constexpr int kMaxClusterRanges = 3;

/// Clusters of a scheme, empty ones counted.
constexpr std::uint32_t cluster_count(ClusterScheme scheme) {
    return scheme == ClusterScheme::AxisAligned ? kAxisClusters : kConeClusters;
}

/// The normal of a triangle, not unit: counter-clockwise is its front. Computed in double.
glm::dvec3 face_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// The cluster of a normal of any length, as its place in the order that suits at most `max_ranges` ranges (1
/// to `kMaxClusterRanges`; the axis-aligned order is the same for all). Zero and NaN go to cluster 0.
/// Cost: one dot product per cluster. Deterministic: of equals the first.
std::uint32_t cluster_of(ClusterScheme scheme, const glm::dvec3& normal, int max_ranges = 2);

/// Centres of the cells of `Cones` in the order for `max_ranges` ranges: a normal belongs to the centre with
/// the largest dot product (they are not unit: a longer one has a larger cell).
std::span<const glm::vec3, kConeClusters> cone_centres(int max_ranges);

/// `AxisAligned` if every triangle with an area faces along an axis within 2^-16 (its `cluster_of` then has
/// the slab test, or a cone next to it), else `Cones`. No triangle: `AxisAligned`.
ClusterScheme choose_scheme(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

/// Clusters [first, end) of an order.
struct ClusterRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;

    friend bool operator==(const ClusterRange&, const ClusterRange&) = default;
};

/// What `cover_ranges` found.
struct ClusterCover {
    std::size_t range_count = 0;    ///< of the ranges that were handed in
    std::uint64_t index_count = 0;  ///< drawn, those of bridged clusters included
};

/// The fewest indices that at most `ranges.size()` (at least 1) ranges of consecutive clusters can hold and
/// still hold every cluster that is not skippable: all before the first of these, after the last, and the
/// largest gaps between are left out; of equal gaps the earlier. `index_counts`, at most 64, in order; bit i
/// of `skippable` is cluster i. Writes the ranges in order. Empty clusters may be skipped. Exact; no
/// allocation.
ClusterCover cover_ranges(std::span<const std::uint32_t> index_counts, std::uint64_t skippable,
                          std::span<ClusterRange> ranges);

}  // namespace rhview
