// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// The paths that the named scenes bring, walked through their triangles.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "rhview/scenes/named_scene.h"

namespace rhview {
namespace {

using Vec = glm::dvec3;

/// Whether the segment meets the triangle. Source: Möller and Trumbore, 1997.
bool meets(const Vec& from, const Vec& to, const Vec& a, const Vec& b, const Vec& c) {
    const Vec along = to - from, ab = b - a, ac = c - a, p = glm::cross(along, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0.0) return false;
    const Vec s = from - a, q = glm::cross(s, ab);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(along, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 && t <= 1.0;
}

bool overlap(const Aabb& a, const Aabb& b) {
    for (int axis = 0; axis < 3; ++axis)
        if (a.max[axis] < b.min[axis] || b.max[axis] < a.min[axis]) return false;
    return true;
}

bool meets_scene(const Scene& scene, const Vec& from, const Vec& to) {
    Aabb box;
    box.grow(glm::vec3(from));
    box.grow(glm::vec3(to));
    for (const SceneBatch& batch : scene.batches) {
        const auto& positions = scene.pools[batch.pool].positions;
        for (const SceneObject& object : batch.objects) {
            if (!overlap(object.bounds, box)) continue;
            for (std::uint32_t i = object.first_index; i < object.first_index + object.index_count; i += 3)
                if (meets(from, to, Vec(positions[batch.indices[i]]), Vec(positions[batch.indices[i + 1]]),
                          Vec(positions[batch.indices[i + 2]])))
                    return true;
        }
    }
    return false;
}

/// Steps of at most half a metre along the path, with feelers of 20 cm on all sides: a near plane of 10 cm
/// stays clear.
void expect_free_way(const std::string& spec) {
    const Result<SceneAndPath> made = make_named_scene(spec);
    ASSERT_TRUE(made.ok()) << made.error().message;
    int hits = 0;
    for (std::size_t k = 0; k + 1 < made->path.keys.size(); ++k) {
        const Vec a = made->path.keys[k].eye, b = made->path.keys[k + 1].eye;
        const int steps = static_cast<int>(std::ceil(glm::distance(a, b) / 0.5)) + 1;
        for (int step = 0; step < steps && hits < 5; ++step) {
            const Vec eye = a + (b - a) * (static_cast<double>(step) / steps);
            const Vec next = a + (b - a) * (static_cast<double>(step + 1) / steps);
            bool hit = meets_scene(made->scene, eye, next);
            for (int axis = 0; axis < 3; ++axis) {
                Vec feeler(0.0);
                feeler[axis] = 0.2;
                hit = hit || meets_scene(made->scene, eye - feeler, eye + feeler);
            }
            hits += hit ? 1 : 0;
            EXPECT_FALSE(hit) << spec << " after key " << k << " at " << eye.x << ' ' << eye.y << ' '
                              << eye.z;
        }
    }
}

TEST(Walkthrough, a_way_through_a_wall_is_noticed) {
    const Result<SceneAndPath> city = make_named_scene("city:blocks=2");
    ASSERT_TRUE(city.ok());
    EXPECT_TRUE(meets_scene(city->scene, {0, 2, 10}, {5, 2, 10}));
    EXPECT_FALSE(meets_scene(city->scene, {0, 2, 10}, {0, 2, 9}));
    // The room's outer wall, beside and through its window.
    const Result<SceneAndPath> indoor = make_named_scene("indoor:rooms=2,floors=1");
    ASSERT_TRUE(indoor.ok());
    EXPECT_TRUE(meets_scene(indoor->scene, {4.2, 1.9, 1.0}, {4.2, 1.9, -1.0}));
    EXPECT_FALSE(meets_scene(indoor->scene, {6.0, 1.9, 0.3}, {6.0, 1.9, -1.0}));
}

TEST(Walkthrough, camera_goes_through_doors_and_not_through_walls) {
    expect_free_way("indoor:rooms=2,floors=2");
    expect_free_way("indoor:rooms=5,floors=4,seed=3");
}

TEST(Walkthrough, camera_keeps_to_the_streets_of_the_city) {
    expect_free_way("city:blocks=2");
    expect_free_way("city:blocks=6");
}

TEST(Walkthrough, camera_keeps_to_the_streets_of_the_town_and_above_its_roofs) {
    for (const char* spec :
         {"town:size=16", "town:size=48", "town:size=70", "town:size=120", "town:size=200"})
        expect_free_way(spec);
    expect_free_way("town:size=150,seed=2");
}

TEST(Walkthrough, culling_to_the_frustum_leaves_a_fair_part_of_the_town) {
    const Result<SceneAndPath> made = make_named_scene("town:size=260");
    ASSERT_TRUE(made.ok());
    constexpr int kFrames = 40;
    double sum = 0.0;
    for (int frame = 0; frame < kFrames; ++frame) {
        const View view = made->path.view_of_frame(frame, kFrames, 16.0 / 9.0, ClipDepth::NegativeOneToOne);
        const glm::dmat4 clip = view.clip_from_camera * view.camera_from_world;
        double inside = 0.0;
        for (const SceneBatch& batch : made->scene.batches) {
            for (const SceneObject& object : batch.objects) {
                const glm::dvec4 p = clip * glm::dvec4(Vec(object.bounds.centre()), 1.0);
                if (p.w > 0.0 && std::abs(p.x) < p.w && std::abs(p.y) < p.w)
                    inside += object.index_count / 3.0;
            }
        }
        sum += inside / static_cast<double>(made->scene.static_triangles());
    }
    EXPECT_GT(sum / kFrames, 0.10);
    EXPECT_LT(sum / kFrames, 0.35);
}

}  // namespace
}  // namespace rhview
