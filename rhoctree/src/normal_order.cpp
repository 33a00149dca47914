// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "normal_order.h"

namespace rhview {

void append_clusters(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                     std::span<const std::uint8_t> cluster_of_triangle, std::uint32_t min_record_indices,
                     std::vector<NormalCluster>& clusters) {
    const std::size_t count = indices.size() / 3;
    const std::size_t least = min_record_indices / 3;
    std::size_t begin = 0;
    for (std::size_t end = 1; end <= count; ++end) {
        const bool boundary = end == count || (!cluster_of_triangle.empty() &&
                                               cluster_of_triangle[end] != cluster_of_triangle[end - 1]);
        if (!boundary || (end < count && (end - begin < least || count - end < least))) continue;
        const std::span<const std::uint32_t> part = indices.subspan(3 * begin, 3 * (end - begin));
        clusters.push_back({bound_facing(positions, part), static_cast<std::uint32_t>(part.size())});
        begin = end;
    }
}

}  // namespace rhview
