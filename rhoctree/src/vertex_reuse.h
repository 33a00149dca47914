// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What an order of triangles costs in vertices: the reason not to order by normal.
///
/// An index costs what the vertices cost that it makes the device shade. Neighbours on a smooth surface share
/// vertices but not their normal cluster: ordered by normal, the shared ones are shaded twice.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// A cache of the vertices shaded last, direct-mapped: about what the caches of devices keep.
class VertexCache {
  public:
    VertexCache() { vertices_.fill(kNone); }
    /// Whether `vertex` must be shaded.
    bool misses(std::uint32_t vertex) {
        std::uint32_t& entry = vertices_[vertex % vertices_.size()];
        const bool missing = entry != vertex;
        entry = vertex;
        return missing;
    }

  private:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    std::array<std::uint32_t, 64> vertices_;
};

/// Vertices shaded for all of `indices` in this order.
std::size_t shaded_vertices(std::span<const std::uint32_t> indices);

/// The share of the clusters' indices that an eye far away in any direction, all alike, would have drawn: a
/// cone of half-angle a faces away from (1 - sin a) / 2 of all directions.
double expected_share(std::span<const NormalCluster> clusters);

/// Ordered by normal must be cheaper by this factor to be worth it.
inline constexpr double kOrderPays = 0.95;

}  // namespace rhview
