// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "grid_method.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "method.h"
#include "rhview/scenes/object_motion.h"

namespace rhview::cli {
namespace {

constexpr int kMostCells = 400;  ///< along an axis

glm::ivec3 cells_for(const Aabb& bounds, double cells) {
    const glm::dvec3 extent = glm::max(glm::dvec3(bounds.extent()), glm::dvec3(1e-3));
    const double side = std::cbrt(extent.x * extent.y * extent.z / cells);
    const glm::dvec3 wanted = glm::round(extent / side);
    return glm::ivec3(glm::clamp(wanted, glm::dvec3(1.0), glm::dvec3(kMostCells)));
}

/// A mesh's balls about the middle of its box, in its own space.
struct MeshBalls {
    float inner = 0.0f;
    float outer = 0.0f;
};

MeshBalls balls_of(const Scene& scene, const SceneMesh& mesh) {
    const glm::vec3 centre = mesh.bounds.centre();
    const auto& positions = scene.pools[mesh.pool].positions;
    MeshBalls balls;
    for (const std::uint32_t index : mesh.indices)
        balls.outer = std::max(balls.outer, glm::distance(centre, positions[index]));
    if (!scene.materials[index_of(mesh.material)].alpha_tested)
        balls.inner = enclosed_radius(positions, mesh.indices, centre);
    return balls;
}

/// How much a map stretches at least and at most: exact where it scales all ways alike, else bounds.
struct Stretch {
    double least = 0.0;
    double most = 0.0;
};

Stretch stretch_of(const glm::dmat4& map) {
    const glm::dmat3 m(map);
    const glm::dmat3 square = glm::transpose(m) * m;
    const double scale2 = (square[0][0] + square[1][1] + square[2][2]) / 3.0;
    double off = 0.0, sum = 0.0, inverse_sum = 0.0;
    const glm::dmat3 inverse = glm::inverse(m);
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) {
            off = std::max(off, std::abs(square[c][r] - (c == r ? scale2 : 0.0)));
            sum += m[c][r] * m[c][r];
            inverse_sum += inverse[c][r] * inverse[c][r];
        }
    if (off <= 1e-6 * scale2) return {std::sqrt(scale2) * (1.0 - 2e-6), std::sqrt(scale2) * (1.0 + 2e-6)};
    const bool usable = std::isfinite(inverse_sum) && inverse_sum > 0.0;
    return {usable ? 1.0 / std::sqrt(inverse_sum) : 0.0, std::sqrt(sum)};
}

/// The middle of its mesh's box, placed, less that of its own box; of what turns both are the same but for
/// rounding.
GridObject object_of(const glm::dmat4& placement, const glm::vec3& mesh_centre, const MeshBalls& balls,
                     const Aabb& bounds) {
    const Stretch stretch = stretch_of(placement);
    const glm::dvec3 centre(placement * glm::dvec4(mesh_centre, 1.0));
    const glm::dvec3 offset = centre - glm::dvec3(bounds.centre());
    const double rounding = 1e-6 * (glm::length(centre) + glm::length(glm::dvec3(bounds.extent())));
    GridObject object;
    object.bounds = bounds;
    object.inner_offset = glm::vec3(offset);
    object.inner_radius = static_cast<float>(std::max(0.0, balls.inner * stretch.least - rounding));
    object.outer_radius = static_cast<float>(balls.outer * stretch.most + glm::length(offset) + rounding);
    return object;
}

/// How far a face of the object's box goes from one plan to the next at most.
float step_of(const Scene& scene, ObjectId object, double frame_seconds) {
    const double speed = top_speed(scene, object);
    if (speed == 0.0) return 0.0f;
    return frame_seconds > 0.0 ? static_cast<float>(1.001 * speed * frame_seconds)
                               : std::numeric_limits<float>::infinity();
}

std::vector<GridObject> objects_of(const Scene& scene, double frame_seconds) {
    std::vector<MeshBalls> balls;
    for (const SceneMesh& mesh : scene.meshes) balls.push_back(balls_of(scene, mesh));
    const std::vector<Aabb> boxes = scene.object_boxes();
    std::vector<GridObject> objects;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const std::size_t mesh = index_of(scene.object_mesh(ObjectId{i}));
        GridObject object = object_of(scene.object_placement(ObjectId{i}), scene.meshes[mesh].bounds.centre(),
                                      balls[mesh], boxes[i]);
        object.max_step = step_of(scene, ObjectId{i}, frame_seconds);
        // Its box grows and shrinks as it turns; the middle of it stays the mesh's.
        if (object.max_step > 0.0f) object.inner_offset = glm::vec3(0.0f);
        objects.push_back(object);
    }
    return objects;
}

}  // namespace

std::unique_ptr<GridPlanner> make_grid_method(const Scene& scene, double cells, double frame_seconds) {
    std::vector<GridStatic> statics;
    for (const StaticObject& object : static_objects(scene)) statics.push_back({object.range, object.bounds});
    std::vector<bool> occludes;
    for (const SceneBatch& batch : scene.batches)
        occludes.push_back(!scene.materials[index_of(batch.material)].alpha_tested);
    GridOptions options;
    options.bounds = scene.bounds();
    options.cells = cells_for(options.bounds, cells);
    return std::make_unique<GridPlanner>(scene.triangle_batches(), occludes, std::move(statics),
                                         objects_of(scene, frame_seconds), options);
}

}  // namespace rhview::cli
