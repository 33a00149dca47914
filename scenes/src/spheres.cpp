// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <optional>

#include "rhview/scenes/sphere_world.h"
#include "scene_recipe.h"
#include "shapes.h"

namespace rhview {
namespace {

constexpr double kHalfPeriod = 15.0;  ///< seconds after which what moves goes back the way it came
constexpr double kRound = 5.0;        ///< seconds of the camera's way: 150 frames at 30 Hz
constexpr int kWayKeys = 96;
constexpr double kAhead = 0.06;  ///< turns that the camera looks ahead on its way

/// Times at which the sphere meets a face of the box.
std::vector<double> turning_times(const SphereWorld& world, const SphereWorld::Sphere& sphere) {
    std::vector<double> times;
    for (int a = 0; a < 3; ++a) {
        const double speed = sphere.velocity[a];
        if (speed == 0.0) continue;
        const double low = sphere.radius, high = world.size[a] - sphere.radius;
        const double first = ((speed > 0.0 ? high : low) - sphere.centre[a]) / speed;
        const double step = (high - low) / std::abs(speed);
        for (double time = first; time < kHalfPeriod; time += step) times.push_back(time);
    }
    std::ranges::sort(times);
    return times;
}

/// Straight from turn to turn, and after `kHalfPeriod` back again.
ObjectMotion motion_of(const SphereWorld& world, const SphereWorld::Sphere& sphere) {
    constexpr double kApart = 1e-6;  // keys of a motion have times that rise
    ObjectMotion motion;
    motion.keys.push_back({});
    const auto add = [&](double time) {
        if (time > motion.keys.back().time_s + kApart)
            motion.keys.push_back({time, world.centre_at(sphere, time) - sphere.centre, 0.0});
    };
    for (const double time : turning_times(world, sphere))
        if (time < kHalfPeriod - kApart) add(time);
    add(kHalfPeriod);
    for (std::size_t i = motion.keys.size() - 1; i-- > 0;)
        motion.keys.push_back({2.0 * kHalfPeriod - motion.keys[i].time_s, motion.keys[i].offset, 0.0});
    return motion;
}

glm::dmat4 placed(const SphereWorld::Sphere& sphere) {
    const double r = sphere.radius;
    return {{r, 0, 0, 0}, {0, r, 0, 0}, {0, 0, r, 0}, {sphere.centre, 1.0}};
}

CameraPath walk_through(const SphereWorld& world) {
    CameraPath path;
    path.fov_y_deg = 55.0;
    path.near_m = 0.1;
    path.far_m = 1000.0;
    for (int i = 0; i <= kWayKeys; ++i) {
        const double turn = static_cast<double>(i) / kWayKeys;
        add_key(path, kRound / kWayKeys, world.way(turn), world.way(turn + kAhead) - world.way(turn));
    }
    return path;
}

SphereWorldOptions options_of(ParameterValues values) {
    SphereWorldOptions options;
    options.spheres = static_cast<std::size_t>(values[0]);
    options.moving = static_cast<std::size_t>(values[1]);
    options.seed = static_cast<std::uint64_t>(values[3]);
    return options;
}

Result<SceneAndPath> build_spheres(ParameterValues values, const std::string& name) {
    const SphereWorld world = make_sphere_world(options_of(values));
    SceneBuilder builder;
    const std::array<MaterialId, 3> still{builder.add_material({"slate", {0.25f, 0.30f, 0.36f}}),
                                          builder.add_material({"sand", {0.62f, 0.53f, 0.36f}}),
                                          builder.add_material({"moss", {0.25f, 0.36f, 0.16f}})};
    const MaterialId flying = builder.add_material({"coral", {0.75f, 0.22f, 0.16f}});
    const int sides = static_cast<int>(values[2]);
    ShapeBuffer buffer;
    add_sphere(buffer, {}, 1.0, 1.0, sides, sides / 2);
    const std::optional<MeshId> mesh = builder.add_mesh(flying, buffer.piece());
    const std::size_t moving = std::min(world.spheres.size(), static_cast<std::size_t>(values[1]));
    for (std::size_t i = 0; i < world.spheres.size(); ++i) {
        const SphereWorld::Sphere& sphere = world.spheres[i];
        if (i < moving)
            builder.add_dynamic(*mesh, placed(sphere), motion_of(world, sphere));
        else
            builder.add_static(still[i % still.size()], buffer.piece(), placed(sphere));
    }
    return with_path(builder.finish(name), walk_through(world));
}

SceneSize spheres_size(ParameterValues values) {
    const auto spheres = static_cast<std::uint64_t>(values[0]), sides = static_cast<std::uint64_t>(values[2]);
    const std::uint64_t triangles = spheres * sides * sides;
    return {triangles, spheres * (sides + 1) * (sides / 2 + 1), sizeof(glm::vec3) + sizeof(PackedNormal),
            spheres * 4096};
}

constexpr std::array<SceneParameter, 4> kParameters{{
    {"spheres", 5000, 1, 100000, "in a box of 100 × 60 × 100 m"},
    {"moving", 200, 0, 100000, "of them, that fly about"},
    {"sides", 16, 6, 128, "of a sphere's outline"},
    {"seed", 1, 0, kLargestSeed, "other spheres"},
}};

}  // namespace

const SceneRecipe& spheres_recipe() {
    static const SceneRecipe recipe{
        {"spheres", "spheres in a box, some of which fly about, and a round through it",
         "1,075,200 triangles in 4,800 objects, and 200 dynamic objects of 224 triangles", kParameters},
        spheres_size,
        build_spheres};
    return recipe;
}

}  // namespace rhview
