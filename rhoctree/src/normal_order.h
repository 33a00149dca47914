// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Triangles of one batch ordered by normal cluster, and the records of those clusters.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// Appends records that cover `indices`. `cluster_of_triangle` is of the order they stand in; empty: there
/// is no order, one record for all. Neighbours are joined until each record has `min_record_indices`.
void append_clusters(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                     std::span<const std::uint8_t> cluster_of_triangle, std::uint32_t min_record_indices,
                     std::vector<NormalCluster>& clusters);

}  // namespace rhview
