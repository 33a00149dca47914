// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Static geometry as the engine owns it: nothing is copied, nothing is converted.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "rhview/base/ids.h"

namespace rhview {

/// Triangles that one material draws from one vertex buffer. The engine owns both arrays and keeps them while
/// they are read. `indices.size()` is a multiple of three and every index is below `positions.size()`.
/// Several batches may share one `positions` array; index values are into the batch's own.
struct TriangleBatch {
    MaterialId material{};
    std::span<const glm::vec3> positions;    ///< scene space, metres
    std::span<const std::uint32_t> indices;  ///< three per triangle, counter-clockwise seen from its front
    bool two_sided = false;                  ///< drawn from behind too: no triangle is ever turned away
};

}  // namespace rhview
