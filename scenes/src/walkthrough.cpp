// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <vector>

#include "placement.h"
#include "rhview/scenes/camera_path.h"
#include "rhview/scenes/scene.h"

namespace rhview {
namespace {

constexpr int kCells = 48;

/// Each once.
std::vector<std::uint32_t> used_vertices(const SceneMesh& mesh) {
    std::vector<std::uint32_t> vertices(mesh.indices.begin(), mesh.indices.end());
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

/// How low the static vertices reach in each cell of a grid over x and z: the ground, under houses and trees
/// too.
class Ground {
  public:
    explicit Ground(const Scene& scene) : bounds_(scene.bounds()), low_(kCells * kCells, kUnknown) {
        for (const SceneBatch& batch : scene.batches)
            for (const std::uint32_t index : batch.indices) add(scene.pools[batch.pool].positions[index]);
        std::vector<std::vector<std::uint32_t>> vertices(scene.meshes.size());
        for (const StaticInstance& instance : scene.static_instances) {
            const SceneMesh& mesh = scene.meshes[index_of(instance.mesh)];
            std::vector<std::uint32_t>& used = vertices[index_of(instance.mesh)];
            if (used.empty()) used = used_vertices(mesh);
            const Placement placement(instance.scene_from_mesh);
            for (const std::uint32_t vertex : used)
                add(placement.position(scene.pools[mesh.pool].positions[vertex]));
        }
        for (int i = 0; i < kCells && std::ranges::find(low_, kUnknown) != low_.end(); ++i) fill_gaps();
    }

    /// The highest ground in the cells around (x, z), relative to the scene's origin.
    [[nodiscard]] double height(double x, double z) const {
        float highest = bounds_.min.y;
        visit_neighbours(cell(static_cast<float>(x), static_cast<float>(z)), [&](std::size_t i) {
            if (low_[i] != kUnknown) highest = std::max(highest, low_[i]);
        });
        return static_cast<double>(highest);
    }

  private:
    static constexpr float kUnknown = std::numeric_limits<float>::infinity();

    void add(const glm::vec3& p) {
        float& low = low_[cell(p.x, p.z)];
        low = std::min(low, p.y);
    }

    [[nodiscard]] std::size_t cell(float x, float z) const {
        const auto place = [](float value, float low, float high) {
            const float share = high > low ? (value - low) / (high - low) : 0.0f;
            return static_cast<std::size_t>(glm::clamp(share * kCells, 0.0f, kCells - 1.0f));
        };
        return place(x, bounds_.min.x, bounds_.max.x) + kCells * place(z, bounds_.min.z, bounds_.max.z);
    }

    template <class Visitor>
    void visit_neighbours(std::size_t centre, Visitor visitor) const {
        const int x = static_cast<int>(centre % kCells), z = static_cast<int>(centre / kCells);
        for (int v = std::max(z - 1, 0); v <= std::min(z + 1, kCells - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, kCells - 1); ++u)
                visitor(static_cast<std::size_t>(u + kCells * v));
    }

    /// Cells without a vertex (inside large triangles) take the highest of their neighbours.
    void fill_gaps() {
        const std::vector<float> before = low_;
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (before[i] != kUnknown) continue;
            float highest = -kUnknown;
            visit_neighbours(i, [&](std::size_t n) {
                if (before[n] != kUnknown) highest = std::max(highest, before[n]);
            });
            if (highest != -kUnknown) low_[i] = highest;
        }
    }

    Aabb bounds_;
    std::vector<float> low_;
};

}  // namespace

CameraPath walkthrough_of_scene(const Scene& scene) {
    const CameraPath flat = walkthrough_of_bounds(scene.bounds(), scene.origin);
    const Ground ground(scene);
    const glm::dvec3 extent(scene.bounds().extent());
    // Eye level: 2 m in a castle of 200 m.
    const double clearance = 0.01 * std::max(extent.x, extent.z);
    const auto lifted = [&](const glm::dvec3& point) {
        const double level =
            scene.origin.y + ground.height(point.x - scene.origin.x, point.z - scene.origin.z) + clearance;
        return glm::dvec3(point.x, level, point.z);
    };

    CameraPath path = flat;
    path.keys.clear();
    constexpr int kSteps = 8;  // between two keys, to follow the ground
    for (std::size_t i = 0; i < flat.keys.size(); ++i) {
        const CameraKey& key = flat.keys[i];
        const bool walks = i + 3 < flat.keys.size();  // the last three keys climb to the overview
        path.keys.push_back(
            walks ? CameraKey{key.time_s, lifted(key.eye), lifted(key.eye) + (key.target - key.eye)} : key);
        if (i + 4 >= flat.keys.size()) continue;
        const CameraKey& next = flat.keys[i + 1];
        for (int step = 1; step < kSteps; ++step) {
            const double t = static_cast<double>(step) / kSteps;
            const glm::dvec3 eye = glm::mix(key.eye, next.eye, t);
            const glm::dvec3 direction = glm::mix(key.target - key.eye, next.target - next.eye, t);
            path.keys.push_back({glm::mix(key.time_s, next.time_s, t), lifted(eye), lifted(eye) + direction});
        }
    }
    return validate(path).ok() ? path : flat;
}

}  // namespace rhview
