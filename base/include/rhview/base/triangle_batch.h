// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Static geometry as the engine owns it: nothing is copied, nothing is converted.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "rhview/base/aabb.h"
#include "rhview/base/ids.h"

namespace rhview {

/// Triangles that the scene's author made as one thing: a chair, a house, a pipe. Part of a batch.
struct BatchObject {
    std::uint32_t first_index = 0;  ///< into the batch's `indices`
    std::uint32_t index_count = 0;
    Aabb bounds;  ///< of its triangles
};

/// Triangles that one material draws from one vertex buffer. The engine owns both arrays and keeps them while
/// they are read. `indices.size()` is a multiple of three and every index is below `positions.size()`.
/// Several batches may share one `positions` array; index values are into the batch's own.
struct TriangleBatch {
    MaterialId material{};
    std::span<const glm::vec3> positions;    ///< scene space, metres
    std::span<const std::uint32_t> indices;  ///< three per triangle, counter-clockwise seen from its front
    bool two_sided = false;                  ///< drawn from behind too: no triangle is ever turned away
    /// The author's objects where they are known, in order, not overlapping, of whole triangles: small ones
    /// are kept together, so that what is drawn and asked about is whole objects. A hint: nothing is proved
    /// by their boxes.
    std::span<const BatchObject> objects{};
};

}  // namespace rhview
