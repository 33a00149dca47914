// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "rhview/base/triangle_batch.h"
#include "rhview/baselines/frustum_objects.h"
#include "uniform.h"

namespace rhview {

/// Upright square tiles of two triangles, each an object of the scene, in several batches.
class TileWorld {
  public:
    explicit TileWorld(std::size_t batches) : indices_(batches), objects_(batches) {}

    void add(std::size_t batch, const glm::vec3& centre, float half) {
        const auto first = static_cast<std::uint32_t>(positions_.size());
        for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
            positions_.push_back(centre + glm::vec3(half * corner.x, half * corner.y, 0.0f));
        const auto at = static_cast<std::uint32_t>(indices_[batch].size());
        for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) indices_[batch].push_back(first + i);
        Aabb box;
        for (std::size_t i = first; i < positions_.size(); ++i) box.grow(positions_[i]);
        objects_[batch].push_back({{BatchId{static_cast<std::uint32_t>(batch)}, at, 6}, box});
    }
    /// Small ones all over the view, `depth` deep, and some large in front of them.
    void scatter(std::uint32_t seed, int count, int walls, double depth) {
        Uniform uniform(seed);
        for (int i = 0; i < count; ++i)
            add(static_cast<std::size_t>(i) % indices_.size(),
                glm::vec3(uniform(-90, 90), uniform(-90, 90), uniform(-depth, 0)),
                static_cast<float>(uniform(1, 5)));
        for (int i = 0; i < walls; ++i)
            add(0, glm::vec3(uniform(-80, 80), uniform(-80, 80), uniform(-0.3 * depth, 0.1 * depth)),
                static_cast<float>(uniform(20, 50)));
    }

    [[nodiscard]] std::vector<TriangleBatch> batches() const {
        std::vector<TriangleBatch> result;
        for (std::uint32_t b = 0; b < indices_.size(); ++b)
            result.push_back({MaterialId{b}, positions_, indices_[b]});
        return result;
    }
    /// With ranges into all batches' indices, one batch after the other.
    [[nodiscard]] std::vector<StaticObject> objects() const {
        std::vector<StaticObject> result;
        std::uint32_t first = 0;
        for (std::size_t b = 0; b < indices_.size(); ++b) {
            for (StaticObject object : objects_[b]) {
                object.range.first_index += first;
                result.push_back(object);
            }
            first += static_cast<std::uint32_t>(indices_[b].size());
        }
        return result;
    }

  private:
    std::vector<glm::vec3> positions_;
    std::vector<std::vector<std::uint32_t>> indices_;
    std::vector<std::vector<StaticObject>> objects_;
};

}  // namespace rhview
