// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "vertex_reuse.h"

#include <algorithm>

namespace rhview {

std::size_t shaded_vertices(std::span<const std::uint32_t> indices) {
    VertexCache cache;
    std::size_t shaded = 0;
    for (const std::uint32_t index : indices) shaded += cache.misses(index);
    return shaded;
}

double expected_share(std::span<const NormalCluster> clusters) {
    double drawn = 0.0, all = 0.0;
    for (const NormalCluster& cluster : clusters) {
        const double sine = std::clamp(static_cast<double>(cluster.facing.cutoff), 0.0, 1.0);
        drawn += static_cast<double>(cluster.index_count) * (0.5 + 0.5 * sine);
        all += static_cast<double>(cluster.index_count);
    }
    return all > 0.0 ? drawn / all : 1.0;
}

}  // namespace rhview
