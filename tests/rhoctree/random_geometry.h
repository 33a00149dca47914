// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "rhview/base/triangle_batch.h"

namespace rhview {

/// Small triangles scattered over a box, in several batches that share one vertex array.
struct RandomGeometry {
    RandomGeometry(std::uint32_t seed, std::size_t batch_count, std::size_t triangles_per_batch,
                   float reach = 100.0f) {
        std::mt19937 random(seed);
        const auto uniform = [&](float low, float high) {
            return low + (high - low) * (static_cast<float>(random() >> 8) / 16777216.0f);
        };
        for (std::size_t b = 0; b < batch_count; ++b) {
            indices.emplace_back();
            for (std::size_t t = 0; t < triangles_per_batch; ++t) {
                const glm::vec3 centre(uniform(-reach, reach), uniform(-reach / 4, reach / 4),
                                       uniform(-reach, reach));
                for (int corner = 0; corner < 3; ++corner) {
                    indices.back().push_back(static_cast<std::uint32_t>(positions.size()));
                    positions.push_back(centre + glm::vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
                }
            }
        }
    }

    [[nodiscard]] std::vector<TriangleBatch> batches() const {
        std::vector<TriangleBatch> result;
        for (std::uint32_t b = 0; b < indices.size(); ++b)
            result.push_back({MaterialId{b}, positions, indices[b]});
        return result;
    }

    std::vector<glm::vec3> positions;
    std::vector<std::vector<std::uint32_t>> indices;
};

}  // namespace rhview
