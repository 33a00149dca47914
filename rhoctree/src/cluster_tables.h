// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Cells of normals in the orders that benchmarks/cluster_order_search found: generated, not to be edited.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "rhview/rhoctree/normal_clusters.h"

namespace rhview {

/// By ranges allowed, less one.
extern const std::array<std::array<glm::vec3, kConeClusters>, kMaxClusterRanges> kConeCentres;

}  // namespace rhview
