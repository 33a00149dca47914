// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Triangles of one batch ordered by normal cluster, and the records of those clusters.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "rhview/rhoctree/normal_clusters.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// The cluster of each triangle of `indices`, three each into `positions`.
void classify_normals(ClusterScheme scheme, std::span<const glm::vec3> positions,
                      std::span<const std::uint32_t> indices, std::span<std::uint8_t> cluster_of_triangle);

/// Stable counting sort of whole triangles by cluster. Reuse it: it keeps its memory.
class ClusterSorter {
  public:
    /// Orders `indices` and `cluster_of_triangle` alike. Cost: linear.
    void sort(std::span<std::uint32_t> indices, std::span<std::uint8_t> cluster_of_triangle);

  private:
    std::vector<std::uint32_t> sorted_;
    std::vector<std::uint8_t> sorted_cluster_;
};

/// Appends records that cover `indices`. `cluster_of_triangle` is sorted; empty: there is no order, one
/// record for all. Neighbours are joined until each record has `min_record_indices`, as far as that can be.
void append_clusters(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                     std::span<const std::uint8_t> cluster_of_triangle, std::uint32_t min_record_indices,
                     std::vector<NormalCluster>& clusters);

}  // namespace rhview
