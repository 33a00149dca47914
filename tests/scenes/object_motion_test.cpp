// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/object_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "../uniform.h"
#include "rhview/scenes/named_scene.h"
#include "rhview/scenes/scene_builder.h"

namespace rhview {
namespace {

constexpr double kPeriod = 7.0;

/// A stretched, tilted and mirrored thing on a way of three segments, and one that stands.
Scene two_objects() {
    const std::vector<glm::vec3> positions{{-1, 0, 0}, {1, 0, 0}, {0, 2, 0.5f}};
    const std::vector<std::uint32_t> indices{0, 1, 2};
    SceneBuilder builder(glm::dvec3(1e6, 0, 3));
    const MeshId mesh = *builder.add_mesh(builder.add_material({}), {positions, {}, {}, indices});
    glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(1e6 + 5, 1, 2));
    builder.add_dynamic(mesh, place);
    place = glm::scale(glm::rotate(place, 0.4, glm::dvec3(1, 0.2, 0)), glm::dvec3(-2, 1, 0.5));
    builder.add_dynamic(mesh, place,
                        {{{}, {2.0, {3, 0, 0}, 0.5}, {5.0, {3, 1, 4}, 0.25}, {kPeriod, {0, 0, 0}, 1.0}}});
    return builder.finish("two").value();
}

TEST(ObjectMotion, at_time_zero_everything_stands_where_it_was_placed) {
    for (const char* spec : {"farm:mesh=1000,instances=40", "crowd:objects=200", "swarm:objects=100",
                             "spheres:spheres=80,moving=60,sides=6"}) {
        const Scene scene = make_named_scene(spec)->scene;
        ObjectPlacements placements;
        place_objects(scene, 0.0, placements);
        EXPECT_EQ(placements.boxes, scene.object_boxes()) << spec;
        for (std::uint32_t i = 0; i < scene.object_count(); ++i) {
            ASSERT_EQ(placement_at(scene, ObjectId{i}, 0.0), scene.object_placement(ObjectId{i})) << spec;
            ASSERT_EQ(placements.scene_from_mesh[i], scene.object_placement(ObjectId{i})) << spec;
        }
    }
}

TEST(ObjectMotion, ways_pass_their_keys_and_repeat) {
    const Scene scene = two_objects();
    const glm::dmat4 start = scene.object_placement(ObjectId{1});
    EXPECT_EQ(placement_at(scene, ObjectId{0}, 3.3), scene.object_placement(ObjectId{0}));
    const glm::dmat4 half_turned = placement_at(scene, ObjectId{1}, 2.0);
    EXPECT_LT(glm::distance(glm::dvec3(half_turned[3]), glm::dvec3(start[3]) + glm::dvec3(3, 0, 0)), 1e-12);
    EXPECT_LT(glm::distance(glm::dvec3(half_turned[0]), glm::dvec3(-start[0].x, start[0].y, -start[0].z)),
              1e-12);
    // A turn about +y brings z to x.
    const glm::dmat4 quarter = placement_at(scene, ObjectId{1}, 5.0);
    EXPECT_LT(glm::distance(glm::dvec3(quarter[1]), glm::dvec3(start[1].z, start[1].y, -start[1].x)), 1e-12);
    for (const double time : {0.5, 2.5, 6.9})
        for (const double periods : {-3.0, 1.0, 10.0}) {
            const glm::dmat4 later = placement_at(scene, ObjectId{1}, time + periods * kPeriod);
            for (int column = 0; column < 4; ++column)
                EXPECT_LT(glm::distance(later[column], placement_at(scene, ObjectId{1}, time)[column]), 1e-9);
        }
}

TEST(ObjectMotion, ways_that_remember_where_they_are_place_to_the_last_bit) {
    Uniform random(8);
    std::vector<Scene> scenes{two_objects()};
    for (const char* spec : {"crowd:objects=100", "farm:mesh=1000,instances=20"})
        scenes.push_back(make_named_scene(spec)->scene);
    for (const Scene& scene : scenes) {
        ObjectWays ways(scene);
        double time = -20.0;
        for (int i = 0; i < 20'000; ++i) {
            // Mostly a little later, at times anywhere, and at the keys themselves.
            time = i % 50 == 0 ? random(-100, 1000) : time + random(0, 0.002);
            const ObjectId object{
                static_cast<std::uint32_t>(random(0, static_cast<double>(scene.object_count())))};
            const double asked = i % 7 == 0 ? std::round(time) : time;
            ASSERT_EQ(ways.placement_at(object, asked), placement_at(scene, object, asked)) << asked;
        }
    }
}

TEST(ObjectMotion, nothing_moves_faster_than_its_top_speed) {
    Uniform random(5);
    std::vector<Scene> scenes{two_objects()};
    for (const char* spec : {"farm:mesh=1000,instances=30", "crowd:objects=100", "swarm:objects=100",
                             "spheres:spheres=80,moving=60,sides=6"})
        scenes.push_back(make_named_scene(spec)->scene);
    for (const Scene& scene : scenes) {
        double closest = 0.0;
        for (int i = 0; i < 4000; ++i) {
            const ObjectId object{
                static_cast<std::uint32_t>(random(0, static_cast<double>(scene.object_count())))};
            const Aabb& box = scene.meshes[index_of(scene.object_mesh(object))].bounds;
            const glm::dvec3 share = random.point(0.5) + 0.5;
            const glm::dvec3 place = glm::dvec3(box.min) + share * glm::dvec3(box.max - box.min);
            const double from = random(0, 50), step = random(1e-3, 2);
            const glm::dvec3 before(placement_at(scene, object, from) * glm::dvec4(place, 1));
            const glm::dvec3 after(placement_at(scene, object, from + step) * glm::dvec4(place, 1));
            const double allowed = top_speed(scene, object) * step;
            ASSERT_LE(glm::distance(before, after), allowed + 1e-9);
            if (allowed > 0.0) closest = std::max(closest, glm::distance(before, after) / allowed);
        }
        EXPECT_GT(closest, 0.5) << "the bound says little";
    }
}

TEST(ObjectMotion, nothing_leaves_its_range_and_the_range_is_no_larger_than_its_way) {
    std::vector<Scene> scenes{two_objects()};
    for (const char* spec : {"farm:mesh=1000,instances=30", "crowd:objects=60", "swarm:objects=40"})
        scenes.push_back(make_named_scene(spec)->scene);
    for (const Scene& scene : scenes) {
        std::vector<Aabb> seen(scene.object_count());
        ObjectPlacements placements;
        for (double time = 0.0; time < 200.0; time += 0.7) {
            place_objects(scene, time, placements);
            for (std::uint32_t i = 0; i < seen.size(); ++i) seen[i].grow(placements.boxes[i]);
        }
        for (std::uint32_t i = 0; i < seen.size(); ++i) {
            const Aabb range = motion_range(scene, ObjectId{i});
            EXPECT_TRUE(glm::all(glm::lessThanEqual(range.min, seen[i].min)) &&
                        glm::all(glm::lessThanEqual(seen[i].max, range.max)))
                << scene.name << i;
            // What turns may turn farther than it was seen: by less than its own size.
            EXPECT_LT(glm::length(range.extent()),
                      glm::length(seen[i].extent()) + glm::length(scene.object_boxes()[i].extent()) + 0.1f);
        }
    }
}

TEST(ObjectMotion, boxes_hold_their_objects_at_any_time) {
    const Scene scene = two_objects();
    ObjectPlacements placements;
    for (double time = 0.0; time < 15.0; time += 0.37) {
        place_objects(scene, time, placements);
        for (std::uint32_t i = 0; i < 2; ++i)
            for (const glm::vec3& position : scene.pools[0].positions) {
                const glm::dvec3 place(placements.scene_from_mesh[i] * glm::dvec4(position, 1));
                const Aabb& box = placements.boxes[i];
                ASSERT_TRUE(glm::all(glm::lessThanEqual(glm::dvec3(box.min), place)) &&
                            glm::all(glm::lessThanEqual(place, glm::dvec3(box.max))));
            }
    }
}

TEST(ObjectMotion, groups_tell_mesh_and_mirroring) {
    const Scene scene = two_objects();
    EXPECT_EQ(object_groups(scene), (std::vector<std::uint32_t>{0, 1}));
    const Scene swarm = make_named_scene("swarm:objects=60")->scene;
    const std::vector<std::uint32_t> groups = object_groups(swarm);
    EXPECT_EQ(*std::ranges::max_element(groups), 5u);
    for (std::uint32_t i = 0; i < 60; ++i)
        EXPECT_EQ(groups[i], 2 * index_of(swarm.object_mesh(ObjectId{i})) + i % 2);
}

TEST(ObjectMotion, ways_that_are_none_are_told) {
    const ObjectMotion good{{{}, {1.0, {1, 0, 0}, 0.2}, {2.0, {0, 0, 0}, -2.0}}};
    EXPECT_EQ(problem_of(good), nullptr);
    const auto problem = [&](auto change) {
        ObjectMotion motion = good;
        change(motion.keys);
        const char* text = problem_of(motion);
        return std::string(text == nullptr ? "nothing" : text);
    };
    EXPECT_EQ(problem([](auto& keys) { keys.resize(1); }), "it has fewer than two keys");
    EXPECT_EQ(problem([](auto& keys) { keys[0].offset.x = 1; }), "its first key is not the start");
    EXPECT_EQ(problem([](auto& keys) { keys[0].time_s = -1; }), "its first key is not the start");
    EXPECT_EQ(problem([](auto& keys) { keys[2].turns = 0.5; }), "its last key does not close it");
    EXPECT_EQ(problem([](auto& keys) { keys[1].time_s = 2; }), "its times don't rise");
    EXPECT_EQ(problem([](auto& keys) { keys[1].offset.z = NAN; }), "a key is not finite");
}

}  // namespace
}  // namespace rhview
