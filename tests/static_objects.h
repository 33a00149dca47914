// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "rhview/baselines/frustum_objects.h"
#include "rhview/scenes/scene.h"

namespace rhview {

/// What the author placed, by where it stands in the index buffer of a scene whose batches follow one
/// another.
inline std::vector<StaticObject> objects_of(const Scene& scene) {
    std::vector<StaticObject> objects;
    std::uint32_t first = 0;
    for (std::uint32_t b = 0; b < scene.batches.size(); ++b) {
        for (const SceneObject& object : scene.batches[b].objects)
            objects.push_back({{BatchId{b}, first + object.first_index, object.index_count}, object.bounds});
        first += static_cast<std::uint32_t>(scene.batches[b].indices.size());
    }
    return objects;
}

}  // namespace rhview
