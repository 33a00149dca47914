// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "normal_order.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rhview {

void classify_normals(ClusterScheme scheme, std::span<const glm::vec3> positions,
                      std::span<const std::uint32_t> indices, std::span<std::uint8_t> cluster_of_triangle) {
    for (std::size_t t = 0; t < cluster_of_triangle.size(); ++t) {
        const std::uint32_t* corner = indices.data() + 3 * t;
        const glm::dvec3 normal =
            face_normal(positions[corner[0]], positions[corner[1]], positions[corner[2]]);
        cluster_of_triangle[t] = static_cast<std::uint8_t>(cluster_of(scheme, normal));
    }
}

void ClusterSorter::sort(std::span<std::uint32_t> indices, std::span<std::uint8_t> cluster_of_triangle) {
    std::array<std::uint32_t, 256> place{};
    for (const std::uint8_t cluster : cluster_of_triangle) ++place[cluster];
    std::uint32_t sum = 0;
    for (std::uint32_t& first : place) sum += std::exchange(first, sum);
    sorted_.resize(indices.size());
    sorted_cluster_.resize(cluster_of_triangle.size());
    for (std::size_t t = 0; t < cluster_of_triangle.size(); ++t) {
        const std::size_t to = place[cluster_of_triangle[t]]++;
        sorted_cluster_[to] = cluster_of_triangle[t];
        std::copy_n(indices.data() + 3 * t, 3, sorted_.data() + 3 * to);
    }
    std::ranges::copy(sorted_, indices.begin());
    std::ranges::copy(sorted_cluster_, cluster_of_triangle.begin());
}

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
