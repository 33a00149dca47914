// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>

#include "random.h"
#include "rhview/scenes/scene.h"

namespace rhview {

struct LoopShape {
    double radius_x = 1.0;  ///< of the round, on the ground
    double radius_z = 1.0;
    double speed = 1.0;  ///< about, along the way
    int keys = 12;       ///< 3 or more
    bool turns = true;   ///< it turns about itself once a round
};

/// A round that begins anywhere on it, in a random sense. `rise(x, z)` is how much higher than the start the
/// object is at an offset from there.
ObjectMotion make_loop(SceneRandom& random, const LoopShape& shape,
                       const std::function<double(double x, double z)>& rise);

}  // namespace rhview
