// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A world of spheres as `GridPlanner` is told of it, and which of them a ray meets first.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "rhview/baselines/grid_planner.h"
#include "rhview/scenes/sphere_world.h"

namespace rhview {

/// `top_speed` as the world was made with; plans follow one another by `frame_seconds`.
inline std::vector<GridObject> grid_objects(const SphereWorld& world, double top_speed,
                                            double frame_seconds) {
    const std::vector<Aabb> boxes = world.boxes_at(0.0);
    // Boxes are rounded to floats.
    const auto step = static_cast<float>(1.001 * top_speed * frame_seconds);
    std::vector<GridObject> objects;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const auto radius = static_cast<float>(world.spheres[i].radius);
        const bool moves = world.spheres[i].velocity != glm::dvec3(0.0);
        objects.push_back(
            {boxes[i], moves ? step : 0.0f, glm::vec3(0.0f), radius * 0.9999f, radius * 1.0001f});
    }
    return objects;
}

/// The sphere that the ray meets first from outside, beyond `from`.
inline std::optional<std::size_t> first_hit(const SphereWorld& world, double time_s, const glm::dvec3& eye,
                                            const glm::dvec3& direction, double from) {
    std::optional<std::size_t> first;
    double least = std::numeric_limits<double>::infinity();
    const glm::dvec3 d = direction / glm::length(direction);
    for (std::size_t i = 0; i < world.spheres.size(); ++i) {
        const SphereWorld::Sphere& sphere = world.spheres[i];
        const glm::dvec3 to = world.centre_at(sphere, time_s) - eye;
        const double along = glm::dot(to, d);
        const double beside2 = glm::dot(to, to) - along * along, r2 = sphere.radius * sphere.radius;
        if (beside2 >= r2) continue;
        const double at = along - std::sqrt(r2 - beside2);
        if (at > from && at < least) least = at, first = i;
    }
    return first;
}

}  // namespace rhview
