// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>

#include "rhview/baselines/grid_planner.h"
#include "rhview/scenes/scene.h"

namespace rhview::cli {

/// The regular grid for a scene, `scene` outlives it: cells are about cubes, `cells` of them.
/// Instances and dynamic objects hide by the ball that their closed mesh holds. From one plan to the next the
/// scene's time goes on by `frame_seconds` at most; 0: by any, and what moves is looked at in every frame.
std::unique_ptr<GridPlanner> make_grid_method(const Scene& scene, double cells, double frame_seconds);

}  // namespace rhview::cli
