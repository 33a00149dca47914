// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/sphere_world.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "rhview/scenes/named_scene.h"
#include "rhview/scenes/object_motion.h"

namespace rhview {
namespace {

TEST(SphereWorld, spheres_stay_in_the_box_within_their_speed_and_those_at_rest_rest) {
    SphereWorldOptions options;
    options.spheres = 300;
    options.moving = 120;
    const SphereWorld world = make_sphere_world(options);
    ASSERT_EQ(world.spheres.size(), 300u);
    constexpr double kStep = 0.37;
    double longest = 0.0;
    for (std::size_t i = 0; i < world.spheres.size(); ++i) {
        const SphereWorld::Sphere& sphere = world.spheres[i];
        EXPECT_GE(sphere.radius, options.least_radius);
        EXPECT_LE(sphere.radius, options.greatest_radius);
        EXPECT_EQ(world.centre_at(sphere, 0.0), sphere.centre);
        for (int frame = 0; frame < 400; ++frame) {
            const glm::dvec3 now = world.centre_at(sphere, kStep * frame),
                             then = world.centre_at(sphere, kStep * (frame + 1));
            for (int a = 0; a < 3; ++a) {
                EXPECT_GE(now[a], sphere.radius);
                EXPECT_LE(now[a], world.size[a] - sphere.radius);
                EXPECT_LE(std::abs(then[a] - now[a]), kStep * options.top_speed * (1 + 1e-9));
                longest = std::max(longest, std::abs(then[a] - now[a]));
            }
            EXPECT_TRUE(i < 120 || now == sphere.centre);
        }
    }
    EXPECT_GT(longest, 0.9 * kStep * options.top_speed);
}

TEST(SphereWorld, way_is_closed_and_free_of_spheres_at_first) {
    const SphereWorld world = make_sphere_world({});
    EXPECT_LT(glm::distance(world.way(0.0), world.way(1.0)), 1e-9);
    for (int i = 0; i < 256; ++i)
        for (const SphereWorld::Sphere& sphere : world.spheres)
            EXPECT_GT(glm::distance(world.way(i / 256.0), sphere.centre), sphere.radius + 0.99);
}

TEST(SphereWorld, scene_shows_the_spheres_where_they_are) {
    const SceneAndPath made = make_named_scene("spheres:spheres=40,moving=25,sides=6,seed=4").value();
    SphereWorldOptions options;
    options.spheres = 40;
    options.moving = 25;
    options.seed = 4;
    const SphereWorld world = make_sphere_world(options);
    ASSERT_EQ(made.scene.dynamic_objects.size(), 25u);
    EXPECT_EQ(made.scene.static_objects(), 15u);
    for (const double time : {0.0, 1.7, 6.2, 14.9})
        for (std::uint32_t i = 0; i < 25; ++i) {
            const glm::dmat4 placement = placement_at(made.scene, ObjectId{i}, time);
            EXPECT_LT(glm::distance(glm::dvec3(placement[3]), world.centre_at(world.spheres[i], time)), 1e-5)
                << i << " at " << time;
        }
    // The walk is the round that the world keeps free, its length in seconds that of 150 frames at 30 Hz.
    EXPECT_DOUBLE_EQ(made.path.keys.back().time_s, 5.0);
    EXPECT_LT(glm::distance(made.path.keys[24].eye, world.way(0.25)), 1e-9);
}

}  // namespace
}  // namespace rhview
