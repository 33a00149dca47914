// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>

#include "rhview/baselines/grid_planner.h"
#include "rhview/scenes/scene.h"

namespace rhview::cli {

/// The regular grid for a scene, `scene` outlives it: cells are about cubes, as many as in 100 × 60 × 100.
/// Instances that stand still, and objects that move, hide by the ball that their closed mesh holds. Objects
/// that move are looked at in every frame: how fast they are is not known here.
std::unique_ptr<GridPlanner> make_grid_method(const Scene& scene);

}  // namespace rhview::cli
