// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/sphere_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "random.h"
#include "rhview/base/assert.h"
#include "shapes.h"

namespace rhview {
namespace {

constexpr std::size_t kWayPoints = 256;
constexpr double kFreeOfWay = 1.0;  ///< metres from a sphere to the way, at least

/// Where a point is that turns back at `low` and `high`, had it gone straight on to `place`.
double turned_back(double place, double low, double high) {
    const double span = high - low;
    double along = std::fmod(place - low, 2.0 * span);
    if (along < 0.0) along += 2.0 * span;
    return low + (along <= span ? along : 2.0 * span - along);
}

using Way = std::array<glm::dvec3, kWayPoints>;

bool touches(const Way& way, const SphereWorld::Sphere& sphere) {
    const double free = sphere.radius + kFreeOfWay;
    return std::ranges::any_of(way, [&](const glm::dvec3& point) {
        const glm::dvec3 to = point - sphere.centre;
        return glm::dot(to, to) < free * free;
    });
}

}  // namespace

glm::dvec3 SphereWorld::centre_at(const Sphere& sphere, double time_s) const {
    glm::dvec3 centre = sphere.centre;
    for (int a = 0; a < 3; ++a)
        if (sphere.velocity[a] != 0.0)
            centre[a] =
                turned_back(centre[a] + sphere.velocity[a] * time_s, sphere.radius, size[a] - sphere.radius);
    return centre;
}

std::vector<Aabb> SphereWorld::boxes_at(double time_s) const {
    std::vector<Aabb> boxes;
    boxes.reserve(spheres.size());
    for (const Sphere& sphere : spheres) {
        const glm::dvec3 centre = centre_at(sphere, time_s);
        boxes.push_back({glm::vec3(centre - sphere.radius), glm::vec3(centre + sphere.radius)});
    }
    return boxes;
}

glm::dvec3 SphereWorld::way(double turn) const {
    const CosSin once = cos_sin_of_turns(turn), twice = cos_sin_of_turns(2.0 * turn);
    return size * glm::dvec3(0.5 + 0.28 * once.cos, 0.5 + 0.1 * twice.sin, 0.5 + 0.28 * once.sin);
}

SphereWorld make_sphere_world(const SphereWorldOptions& options) {
    RHVIEW_ASSERT(2.0 * options.greatest_radius < std::min({options.size.x, options.size.y, options.size.z}));
    SphereWorld world;
    world.size = options.size;
    world.spheres.reserve(options.spheres);
    Way way;
    for (std::size_t i = 0; i < kWayPoints; ++i) way[i] = world.way(static_cast<double>(i) / kWayPoints);
    SceneRandom random(options.seed);
    while (world.spheres.size() < options.spheres) {
        SphereWorld::Sphere sphere;
        sphere.radius = random.between(options.least_radius, options.greatest_radius);
        for (int a = 0; a < 3; ++a)
            sphere.centre[a] = random.between(sphere.radius, options.size[a] - sphere.radius);
        if (options.clears_way && touches(way, sphere)) continue;
        if (world.spheres.size() < options.moving)
            for (int a = 0; a < 3; ++a) sphere.velocity[a] = options.top_speed * random.between(-1.0, 1.0);
        world.spheres.push_back(sphere);
    }
    return world;
}

}  // namespace rhview
