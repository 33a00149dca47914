// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Cameras that a scene may be seen with, when nobody says with which it will be.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/triangle_batch.h"
#include "rhview/base/view.h"

namespace rhview {

/// `count` cameras in front of random triangles, since that is where free space is: at distances that are
/// spread evenly over the orders of magnitude from a person's in a room to an overview (1/500 to 1/2 of the
/// scene's size), looking in random directions that are nearer to the horizon than to the poles. Relative to
/// the scene's origin, +y up, 60° high, no far plane. Deterministic, the same on every machine. `bounds` is
/// that of the batches.
std::vector<View> sample_views(std::span<const TriangleBatch> batches, const Aabb& bounds, std::size_t count);

}  // namespace rhview
