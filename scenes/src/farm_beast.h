// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The beast of the scene `farm`: a closed, smooth, knotted body of any number of triangles.
#pragma once

#include <cstdint>

#include "shapes.h"

namespace rhview {

inline constexpr double kBeastFoot = 1.0;  ///< how far its origin is above the ground it lies on

/// About 2.2 m in radius about +y. Within 1 % of `triangles`, which is at least 1,000; a closed manifold.
ShapeBuffer make_beast(std::int64_t triangles);

}  // namespace rhview
