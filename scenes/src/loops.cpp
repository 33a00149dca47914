// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "loops.h"

#include <glm/geometric.hpp>

#include "shapes.h"

namespace rhview {

ObjectMotion make_loop(SceneRandom& random, const LoopShape& shape,
                       const std::function<double(double x, double z)>& rise) {
    const double phase = random.unit();
    const double sense = random.chance(0.5) ? 1.0 : -1.0;
    const CosSin start = cos_sin_of_turns(phase);
    ObjectMotion motion;
    motion.keys.reserve(static_cast<std::size_t>(shape.keys) + 1);
    motion.keys.push_back({});
    for (int i = 1; i <= shape.keys; ++i) {
        const double part = static_cast<double>(i) / shape.keys;
        MotionKey key;
        if (i < shape.keys) {
            const CosSin at = cos_sin_of_turns(phase + sense * part);
            key.offset.x = shape.radius_x * (at.cos - start.cos);
            key.offset.z = shape.radius_z * (at.sin - start.sin);
            key.offset.y = rise(key.offset.x, key.offset.z);
        }
        // From x to z is the other way round than a turn about y.
        if (shape.turns) key.turns = -sense * part;
        const MotionKey& before = motion.keys.back();
        key.time_s = before.time_s + glm::length(key.offset - before.offset) / shape.speed;
        motion.keys.push_back(key);
    }
    return motion;
}

}  // namespace rhview
