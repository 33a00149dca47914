// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/grid_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <set>

#include "allocations.h"
#include "sphere_objects.h"
#include "uniform.h"

namespace rhview {
namespace {

constexpr double kNear = 0.05;

FrameInput seen_from(const glm::dvec3& eye, const glm::dvec3& forward, std::span<const Aabb> boxes) {
    return {{look_along(eye, forward, {0, 1, 0}),
             perspective(glm::radians(55.0), 1.5, kNear, 1000.0, ClipDepth::NegativeOneToOne),
             ClipDepth::NegativeOneToOne},
            glm::dvec3(0.0),
            boxes};
}

GridOptions with_cells(const glm::ivec3& cells, const Aabb& bounds) {
    GridOptions options;
    options.cells = cells;
    options.bounds = bounds;
    options.face_pixels = 512;
    options.nothing_leaves = true;
    return options;
}

/// `count` spheres, half as large or more, of which the first `moving` fly; a plan a second.
SphereWorld spheres_in(const glm::dvec3& size, std::size_t count, std::size_t moving, double radius,
                       double step, std::uint64_t seed) {
    return make_sphere_world({size, count, moving, 0.5 * radius, radius, step, false, seed});
}

Aabb bounds_of(const SphereWorld& world) {
    return {glm::vec3(0.0f), glm::vec3(world.size)};
}

GridPlanner planner_of(const SphereWorld& world, double step, const glm::ivec3& cells) {
    return {{}, {}, {}, grid_objects(world, step, 1.0), with_cells(cells, bounds_of(world))};
}

std::set<std::size_t> objects_of(const FramePlan& plan) {
    std::set<std::size_t> result;
    for (const ObjectId object : plan.objects) result.insert(index_of(object));
    return result;
}

/// Spheres that rays through random points of the picture meet first, and that `plan` lacks.
std::size_t missing_spheres(const SphereWorld& world, double time_s, const FrameInput& input,
                            const FramePlan& plan, unsigned seed, int rays) {
    Uniform uniform(seed);
    const std::set<std::size_t> drawn = objects_of(plan);
    const glm::dmat4 relative_from_clip = glm::inverse(input.culling_view.clip_from_eye_relative());
    std::size_t missing = 0;
    for (int i = 0; i < rays; ++i) {
        const glm::dvec4 clip(uniform(-1.0, 1.0), uniform(-1.0, 1.0), -1.0, 1.0);
        const glm::dvec4 near = relative_from_clip * clip;
        const glm::dvec3 direction = glm::dvec3(near) / near.w;
        const auto hit =
            first_hit(world, time_s, input.culling_view.eye(), direction, glm::length(direction));
        if (hit && !drawn.contains(*hit)) ++missing;
    }
    return missing;
}

TEST(GridPlanner, draws_every_sphere_that_a_ray_meets_first_while_spheres_and_eye_move) {
    std::uint64_t drawn = 0, in_view = 0, revealed = 0, volumes = 0;
    for (const unsigned seed : {1u, 2u, 3u}) {
        const SphereWorld world = spheres_in({40, 24, 40}, 900, 450, 3.0, 0.12, seed);
        GridPlanner planner = planner_of(world, 0.12, {80, 48, 80});
        FramePlan plan;
        for (int frame = 0; frame < 40; ++frame) {
            const double turn = 0.04 * frame;
            const std::vector<Aabb> boxes = world.boxes_at(frame);
            const FrameInput input = seen_from({20 + 6 * std::cos(turn), 12.3, 20.1 + 6 * std::sin(turn)},
                                               {std::cos(2 * turn), 0.1, std::sin(2 * turn)}, boxes);
            planner.plan(input, plan);
            EXPECT_EQ(missing_spheres(world, frame, input, plan, seed + static_cast<unsigned>(frame), 3000),
                      0u)
                << "frame " << frame;
            std::vector<ObjectId> all;
            append_visible_objects(make_frustum(input.culling_view), boxes, all);
            drawn += plan.objects.size();
            in_view += all.size();
            revealed += planner.statistics().volumes_revealed;
            volumes += planner.statistics().volumes;
        }
    }
    EXPECT_LT(drawn, in_view / 2);
    EXPECT_GT(volumes, 120u * 200u);
    EXPECT_GT(revealed, 100u);
}

TEST(GridPlanner, keeps_its_promise_when_the_camera_jumps) {
    const SphereWorld world = spheres_in({40, 24, 40}, 900, 900, 2.2, 0.3, 5);
    GridPlanner planner = planner_of(world, 0.3, {80, 48, 80});
    FramePlan plan;
    Uniform uniform(6);
    for (int frame = 0; frame < 60; ++frame) {
        const std::vector<Aabb> boxes = world.boxes_at(frame);
        const glm::dvec3 eye(uniform(-10.0, 50.0), uniform(-5.0, 30.0), uniform(-10.0, 50.0));
        const FrameInput input =
            seen_from(eye, {uniform(-1.0, 1.0), uniform(-0.5, 0.5), uniform(-1.0, 1.0)}, boxes);
        planner.plan(input, plan);
        EXPECT_EQ(missing_spheres(world, frame, input, plan, static_cast<unsigned>(frame), 2000), 0u)
            << "frame " << frame;
    }
}

TEST(GridPlanner, costs_nothing_for_what_is_hidden_until_its_volume_is_over) {
    // All behind the eye.
    SphereWorld world = spheres_in({40, 24, 40}, 500, 500, 1.0, 0.01, 7);
    std::erase_if(world.spheres, [](const SphereWorld::Sphere& sphere) { return sphere.centre.x > 15.0; });
    GridPlanner planner = planner_of(world, 0.01, {80, 48, 80});
    FramePlan plan;
    std::uint64_t renewed = 0;
    for (int frame = 0; frame < 100; ++frame) {
        const std::vector<Aabb> boxes = world.boxes_at(frame);
        planner.plan(seen_from({20.5, 12.5, 20.5}, {1, 0, 0}, boxes), plan);
        EXPECT_TRUE(plan.objects.empty());
        EXPECT_EQ(planner.statistics().volumes, world.spheres.size());
        renewed += planner.statistics().volumes_renewed;
    }
    // Periods of up to 8, 16, 32, 64 … frames, and no less than half of that.
    EXPECT_GE(renewed, 3 * world.spheres.size());
    EXPECT_LE(renewed, 4 * world.spheres.size());
}

TEST(GridPlanner, plans_twice_the_same_and_allocates_nothing_after_warm_up) {
    const auto run = [](std::vector<std::uint64_t>& hashes) {
        const SphereWorld world = spheres_in({30, 20, 30}, 500, 250, 2.0, 0.1, 8);
        GridPlanner planner = planner_of(world, 0.1, {30, 20, 30});
        FramePlan plan;
        long allocated = 0;
        for (int frame = 0; frame < 2000; ++frame) {
            const std::vector<Aabb> boxes = world.boxes_at(frame);
            const double turn = 6.283185307179586 * frame / 100;
            const FrameInput input =
                seen_from({15.2, 10.1, 15.3}, {std::cos(turn), 0.0, std::sin(turn)}, boxes);
            const long before = allocations();
            planner.plan(input, plan);
            if (frame >= 1900) allocated += allocations() - before;
            if (frame < 200) hashes.push_back(plan_hash(plan));
        }
        return allocated;
    };
    std::vector<std::uint64_t> a, b;
    EXPECT_EQ(run(a), 0);
    run(b);
    EXPECT_EQ(a, b);
}

TEST(GridPlanner, tracks_what_leaves_the_grid_and_what_has_no_known_speed) {
    std::vector<GridObject> objects(2);
    objects[0].max_step = 0.5f;
    objects[1].max_step = std::numeric_limits<float>::infinity();
    const Aabb bounds{glm::vec3(0.0f), glm::vec3(10.0f)};
    GridOptions options = with_cells({10, 10, 10}, bounds);
    options.nothing_leaves = false;
    GridPlanner planner({}, {}, {}, objects, options);
    FramePlan plan;
    const std::vector<Aabb> away{{glm::vec3(20, 4, 4), glm::vec3(21, 5, 5)}, {glm::vec3(3), glm::vec3(4)}};
    planner.plan(seen_from({1, 5, 5}, {1, 0, 0}, away), plan);
    EXPECT_EQ(objects_of(plan), (std::set<std::size_t>{0, 1}));
    EXPECT_EQ(planner.statistics().volumes, 0u);
}

TEST(GridPlanner, tests_boxes_alone_where_no_eye_is_the_centre_of_rays) {
    const SphereWorld world = spheres_in({20, 20, 20}, 200, 100, 2.0, 0.1, 9);
    GridPlanner planner = planner_of(world, 0.1, {20, 20, 20});
    FramePlan plan;
    const std::vector<Aabb> boxes = world.boxes_at(0);
    FrameInput input = seen_from({-5, 10, 10}, {1, 0, 0}, boxes);
    input.culling_view.clip_from_camera = orthographic(8, 8, 0.1, 50, ClipDepth::NegativeOneToOne);
    planner.plan(input, plan);
    std::vector<ObjectId> expected;
    append_visible_objects(make_frustum(input.culling_view), boxes, expected);
    EXPECT_EQ(plan.objects, expected);
}

/// A closed box of 12 triangles around [low, high].
struct BoxMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    BoxMesh(const glm::vec3& low, const glm::vec3& high) {
        for (unsigned i = 0; i < 8; ++i)
            positions.push_back({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                                 (i & 4) != 0 ? high.z : low.z});
        indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                   2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    }
    [[nodiscard]] TriangleBatch batch() const { return {MaterialId{0}, positions, indices, false}; }
    [[nodiscard]] Aabb bounds() const {
        Aabb box;
        for (const glm::vec3& p : positions) box.grow(p);
        return box;
    }
};

/// A wall in front of a thing.
class BehindAWall : public testing::Test {
  protected:
    [[nodiscard]] GridPlanner planner(bool occludes = true) const {
        const std::array<TriangleBatch, 2> batches{wall_.batch(), thing_.batch()};
        const std::vector<bool> flags{occludes, true};
        const Aabb bounds{glm::vec3(0.0f), glm::vec3(30.0f)};
        return {batches,
                flags,
                {{{BatchId{0}, 0, 36}, wall_.bounds()}, {{BatchId{1}, 36, 36}, thing_.bounds()}},
                {},
                with_cells({30, 30, 30}, bounds)};
    }
    static std::vector<std::uint32_t> seen(GridPlanner& planner, const glm::dvec3& eye,
                                           const glm::dvec3& forward) {
        FramePlan plan;
        planner.plan(seen_from(eye, forward, {}), plan);
        return plan.chosen;
    }

    BoxMesh wall_{glm::vec3(9.5f, 2.0f, 2.0f), glm::vec3(12.5f, 28.0f, 28.0f)};
    BoxMesh thing_{glm::vec3(20.0f, 14.0f, 14.0f), glm::vec3(22.0f, 16.0f, 16.0f)};
};

using Items = std::vector<std::uint32_t>;

TEST_F(BehindAWall, a_thing_is_left_out) {
    GridPlanner grid = planner();
    EXPECT_GT(grid.static_opaque_cells(), 1000u);
    EXPECT_EQ(seen(grid, {2.5, 15, 15}, {1, 0, 0}), (Items{0}));
}

TEST_F(BehindAWall, a_thing_is_drawn_if_the_wall_has_holes) {
    GridPlanner grid = planner(false);
    EXPECT_EQ(seen(grid, {2.5, 15, 15}, {1, 0, 0}), (Items{0, 1}));
}

TEST_F(BehindAWall, a_thing_is_drawn_from_inside_of_the_wall) {
    GridPlanner grid = planner();
    EXPECT_EQ(seen(grid, {10.6, 15.3, 15.4}, {1, 0, 0}), (Items{0, 1}));
    EXPECT_EQ(seen(grid, {9.7, 15.3, 15.4}, {1, 0, 0}), (Items{0, 1}));  // in a cell that is not opaque
}

TEST_F(BehindAWall, a_thing_is_drawn_where_the_near_plane_cuts_the_wall) {
    GridPlanner grid = planner();
    EXPECT_EQ(seen(grid, {9.5 - 0.5 * kNear, 15.3, 15.4}, {1, 0, 0}), (Items{0, 1}));
    EXPECT_EQ(seen(grid, {9.5 - 3 * kNear, 15.3, 15.4}, {1, 0, 0}), (Items{0}));
}

TEST_F(BehindAWall, a_wall_with_one_triangle_less_hides_nothing) {
    wall_.indices.resize(33);
    const std::array<TriangleBatch, 2> batches{wall_.batch(), thing_.batch()};
    const std::vector<bool> flags{true, true};
    GridPlanner grid(batches, flags,
                     {{{BatchId{0}, 0, 33}, wall_.bounds()}, {{BatchId{1}, 33, 36}, thing_.bounds()}}, {},
                     with_cells({30, 30, 30}, {glm::vec3(0.0f), glm::vec3(30.0f)}));
    EXPECT_EQ(seen(grid, {2.5, 15, 15}, {1, 0, 0}), (Items{0, 1}));
}

}  // namespace
}  // namespace rhview
