// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Joins triangles into surfaces by equal corners and says which of them are closed.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace rhview {

/// Triangles by their corners, in the order they are numbered.
using Corners = std::array<glm::vec3, 3>;

struct ClosedSurfaces {
    std::vector<std::uint32_t> surface_of;  ///< of a triangle; `SolidCells::kOpen`
    std::uint32_t count = 0;
    bool opened_below = false;
};

/// `joins[t]`: whether triangle t may be part of a surface. Edges whose ends lie at `open_y` need not close.
ClosedSurfaces find_closed_surfaces(const std::vector<Corners>& triangles, const std::vector<bool>& joins,
                                    float open_y);

}  // namespace rhview
