// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "rhview/base/triangle_batch.h"
#include "uniform.h"

namespace rhview {

/// Balls of small triangles that face outwards: most of a ball's far side can be skipped. Corners are not
/// shared: a triangle is known by its first index. Batch 2 is two-sided.
struct Balls {
    std::vector<glm::vec3> positions;
    std::vector<std::vector<std::uint32_t>> indices;

    Balls(std::uint32_t seed, std::size_t batch_count, int balls, int triangles_per_ball) {
        Uniform uniform(seed);
        indices.resize(batch_count);
        for (int i = 0; i < balls; ++i) {
            const glm::vec3 centre(uniform(-90, 90), uniform(-15, 15), uniform(-90, 90));
            const auto radius = static_cast<float>(uniform(2, 12));
            for (int t = 0; t < triangles_per_ball; ++t) {
                glm::dvec3 direction = uniform.point(1.0);
                while (!(glm::length(direction) > 0.1 && glm::length(direction) < 1.0))
                    direction = uniform.point(1.0);
                add(static_cast<std::size_t>(i) % batch_count, centre, radius,
                    glm::vec3(glm::normalize(direction)));
            }
        }
    }

    void add(std::size_t batch, const glm::vec3& centre, float radius, const glm::vec3& out) {
        const glm::vec3 side =
            glm::normalize(glm::cross(out, std::abs(out.y) < 0.8f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
        const glm::vec3 up = glm::cross(out, side);
        const glm::vec3 foot = centre + radius * out;
        for (const glm::vec3& corner : {foot, foot + 0.3f * side, foot + 0.3f * up}) {
            indices[batch].push_back(static_cast<std::uint32_t>(positions.size()));
            positions.push_back(corner);
        }
    }

    [[nodiscard]] std::vector<TriangleBatch> batches() const {
        std::vector<TriangleBatch> result;
        for (std::uint32_t b = 0; b < indices.size(); ++b)
            result.push_back({MaterialId{b}, positions, indices[b], b == 2});
        return result;
    }
};

}  // namespace rhview
