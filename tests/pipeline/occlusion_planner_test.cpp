// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The planner with occlusion culling on a device without graphics, in a world of balls where all that lies
// beyond a plane is hidden.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "allocations.h"
#include "balls.h"
#include "fake_gpu.h"
#include "rhview/pipeline/rhview_planner.h"
#include "rhview/pipeline/seed_planner.h"

namespace rhview {
namespace {

constexpr DrawCosts kCosts{1.0, 60.0, 0.0};
constexpr QueryCosts kQueryCosts{{.query_ns = 300.0, .box_ns = 30.0, .pixel_ns = 1e-3, .draw_ns = 80.0},
                                 {.query_ns = 10.0, .box_ns = 90.0, .pixel_ns = 1e-3, .draw_ns = 60.0}};

View view_at(double time) {
    return {
        look_along({5 * std::sin(3 * time), 0, 20 * time}, {std::cos(time), 0, std::sin(time)}, {0, 1, 0}),
        perspective(1.0, 1.5, 0.1, 500.0, ClipDepth::ReversedZeroToOne), ClipDepth::ReversedZeroToOne};
}

RhOctree octree_of(const Balls& balls, std::uint32_t leaf = 40) {
    OctreeOptions options;
    options.max_leaf_triangles = leaf;
    options.costs = kCosts;
    return build_octree(balls.batches(), options).value();
}

OcclusionOptions options_of(OcclusionMode mode = OcclusionMode::Exact) {
    OcclusionOptions options;
    options.settings.mode = mode;
    options.costs = kQueryCosts;
    return options;
}

/// A device that sees nothing of what lies wholly beyond `x`.
class World {
  public:
    World(FramePlanner& planner, double x, const FakeGpuHabits& habits = {})
        : planner_(planner), x_(x), gpu_(habits) {}

    const FramePlan& frame(double time, std::span<const Aabb> objects = {}) {
        planner_.absorb(gpu_.next_frame());
        planner_.plan({.culling_view = view_at(time), .object_boxes = objects}, plan);
        seen.clear();
        for (const PlannedQuery& query : plan.queries) {
            seen.push_back(sees(query));
            gpu_.ask({query.ticket, seen.back(), 1});
        }
        return plan;
    }

    FramePlan plan;
    std::vector<bool> seen;  ///< by query

  private:
    [[nodiscard]] bool sees(const PlannedQuery& query) const {
        const auto boxes = std::span(plan.query_boxes).subspan(query.first_box, query.box_count);
        return std::ranges::any_of(boxes,
                                   [&](const Aabb& box) { return static_cast<double>(box.min.x) < x_; });
    }

    FramePlanner& planner_;
    double x_;
    FakeGpu gpu_;
};

/// Where a frame leaves each triangle in view that faces the eye.
struct Fates {
    std::size_t at_once = 0, on_query = 0, left_out = 0;
    std::size_t outside_its_boxes = 0;  ///< hangs on a query none of whose boxes holds it
};

Fates fates_of(const Balls& balls, const RhOctree& octree, const FramePlan& plan, double time) {
    constexpr std::uint32_t kNone = 0xffffffffu;
    std::vector<bool> at_once(balls.positions.size());
    std::vector<std::uint32_t> query(balls.positions.size(), kNone);
    const auto each = [&](const DrawRange& range, const auto& mark) {
        for (std::uint32_t k = 0; k < range.index_count; k += 3)
            mark(octree.indices()[range.first_index + k]);
    };
    for (const DrawRange& range : plan.opaque) each(range, [&](std::uint32_t i) { at_once[i] = true; });
    for (const ConditionalRange& conditional : plan.conditional)
        each(conditional.range, [&](std::uint32_t i) { query[i] = conditional.query; });
    std::vector<DrawRange> to_show;
    const View view = view_at(time);
    append_ranges_to_show(octree, make_frustum(view), make_viewpoint(view), to_show);
    Fates fates;
    const auto holds = [&](const PlannedQuery& asked, const glm::vec3& p) {
        const auto boxes = std::span(plan.query_boxes).subspan(asked.first_box, asked.box_count);
        return std::ranges::any_of(boxes, [&](const Aabb& box) {
            return glm::all(glm::lessThanEqual(box.min, p)) && glm::all(glm::lessThanEqual(p, box.max));
        });
    };
    for (const DrawRange& range : to_show)
        each(range, [&](std::uint32_t i) {
            if (at_once[i]) return ++fates.at_once, void();
            if (query[i] == kNone) {
                const glm::dvec3 a(balls.positions[i]), b(balls.positions[i + 1]), c(balls.positions[i + 2]);
                fates.left_out += glm::dot(glm::cross(b - a, c - a), view.eye() - a) > 0.0;
                return;
            }
            ++fates.on_query;
            for (std::uint32_t corner = i; corner < i + 3; ++corner)
                fates.outside_its_boxes += !holds(plan.queries[query[i]], balls.positions[corner]);
        });
    return fates;
}

class ExactOcclusion : public testing::TestWithParam<FakeGpuHabits> {};

TEST_P(ExactOcclusion, all_that_faces_the_eye_is_drawn_or_hangs_on_a_query_whose_boxes_hold_it) {
    const Balls balls(211, 4, 70, 200);
    const RhOctree octree = octree_of(balls);
    RhviewPlanner planner(octree, kCosts, options_of());
    World world(planner, 20.0, GetParam());
    std::size_t on_query = 0;
    for (int i = 0; i < 300; ++i) {
        // A walk that turns round, and jumps now and then.
        const double time = 0.004 * i + (i % 67 == 0 ? 2.0 : 0.0);
        const FramePlan& plan = world.frame(time);
        const Fates fates = fates_of(balls, octree, plan, time);
        EXPECT_EQ(fates.left_out, 0u) << "frame " << i;
        EXPECT_EQ(fates.outside_its_boxes, 0u) << "frame " << i;
        on_query += fates.on_query;
        for (const PlannedQuery& query : plan.queries) EXPECT_GT(query.box_count, 0u);
        for (const ConditionalRange& conditional : plan.conditional)
            EXPECT_LT(conditional.query, plan.queries.size());
        EXPECT_TRUE(std::ranges::is_sorted(plan.conditional, {}, [](const ConditionalRange& c) {
            return std::pair(c.range.batch, c.range.first_index);
        }));
    }
    EXPECT_GT(on_query, 1000u);
}

INSTANTIATE_TEST_SUITE_P(Devices, ExactOcclusion,
                         testing::Values(FakeGpuHabits{}, FakeGpuHabits{.latency = 3, .latency_spread = 2},
                                         FakeGpuHabits{.lost = 0.3, .duplicated = 0.1, .shuffled = true}));

TEST(OcclusionPlanner, what_stays_hidden_soon_hangs_on_few_queries) {
    const Balls balls(212, 3, 80, 300);
    const RhOctree octree = octree_of(balls);
    RhviewPlanner planner(octree, kCosts, options_of());
    World world(planner, 25.0);
    std::size_t first_queries = 0;
    for (int i = 0; i < 40; ++i) {
        world.frame(0.001 * i);
        if (i == 1) first_queries = world.plan.queries.size();
    }
    std::size_t hidden = 0, drawn = 0, skipped = 0;
    for (const DrawRange& range : world.plan.opaque) drawn += range.index_count;
    for (const ConditionalRange& conditional : world.plan.conditional)
        (world.seen[conditional.query] ? drawn : skipped) += conditional.range.index_count;
    std::vector<DrawRange> to_show;
    append_ranges_to_show(octree, make_frustum(view_at(0.039)), make_viewpoint(view_at(0.039)), to_show);
    for (const DrawRange& range : to_show)
        for (std::uint32_t k = 0; k < range.index_count; k += 3)
            hidden += balls.positions[octree.indices()[range.first_index + k]].x > 25.0f ? 3 : 0;
    EXPECT_GT(hidden, 1000u);
    EXPECT_GT(skipped, hidden * 8 / 10);
    EXPECT_LT(world.plan.queries.size(), first_queries);
    ASSERT_TRUE(world.plan.occlusion.has_value());
    EXPECT_GT(world.plan.occlusion->saved_ns, 0.0);
    EXPECT_GE(*world.plan.predicted_ns, world.plan.occlusion->query_ns);
}

TEST(OcclusionPlanner, latent_mode_leaves_out_what_was_hidden_and_nothing_else) {
    const Balls balls(213, 3, 70, 200);
    const RhOctree octree = octree_of(balls);
    RhviewPlanner planner(octree, kCosts, options_of(OcclusionMode::Latent));
    World world(planner, 20.0);
    std::size_t left_out = 0;
    for (int i = 0; i < 100; ++i) {
        const double time = 0.001 * i;
        world.frame(time);
        const Fates fates = fates_of(balls, octree, world.plan, time);
        left_out += fates.left_out;
        EXPECT_EQ(fates.outside_its_boxes, 0u);
        // A box that reaches before the plane is seen: what lies before it is never left out.
        std::vector<bool> kept(balls.positions.size());
        const auto keep = [&](const DrawRange& range) {
            for (std::uint32_t k = 0; k < range.index_count; k += 3)
                kept[octree.indices()[range.first_index + k]] = true;
        };
        for (const DrawRange& range : world.plan.opaque) keep(range);
        for (const ConditionalRange& conditional : world.plan.conditional) keep(conditional.range);
        std::vector<DrawRange> to_show;
        append_ranges_to_show(octree, make_frustum(view_at(time)), make_viewpoint(view_at(time)), to_show);
        for (const DrawRange& range : to_show)
            for (std::uint32_t k = 0; k < range.index_count; k += 3) {
                const std::uint32_t t = octree.indices()[range.first_index + k];
                const glm::dvec3 a(balls.positions[t]), b(balls.positions[t + 1]), c(balls.positions[t + 2]);
                const bool faces = glm::dot(glm::cross(b - a, c - a), view_at(time).eye() - a) > 0.0;
                const bool before = a.x < 20.0 && b.x < 20.0 && c.x < 20.0;
                EXPECT_TRUE(kept[t] || !faces || !before);
            }
    }
    EXPECT_GT(left_out, 1000u);
}

TEST(OcclusionPlanner, equal_frames_and_answers_give_equal_plans) {
    const Balls balls(214, 3, 60, 200);
    const RhOctree octree = octree_of(balls);
    RhviewPlanner one(octree, kCosts, options_of()), two(octree, kCosts, options_of());
    World a(one, 20.0), b(two, 20.0);
    for (int i = 0; i < 60; ++i) EXPECT_EQ(plan_hash(a.frame(0.01 * i)), plan_hash(b.frame(0.01 * i)));
}

TEST(OcclusionPlanner, two_views_share_an_octree_and_nothing_else) {
    const Balls balls(218, 3, 60, 200);
    const RhOctree octree = octree_of(balls);
    RhviewPlanner one(octree, kCosts, options_of()), other(octree, kCosts, options_of());
    RhviewPlanner alone(octree, kCosts, options_of());
    World a(one, 20.0), b(other, -5.0, {.latency = 2}), c(alone, 20.0);
    for (int i = 0; i < 60; ++i) {
        const std::uint64_t hash = plan_hash(a.frame(0.01 * i));
        b.frame(3.0 - 0.02 * i);
        EXPECT_EQ(hash, plan_hash(c.frame(0.01 * i)));
    }
}

TEST(OcclusionPlanner, warm_planner_allocates_nothing) {
    const Balls balls(215, 3, 60, 200);
    const RhOctree octree = octree_of(balls);
    const std::vector<Aabb> boxes(30, Aabb{glm::vec3(30, -1, -1), glm::vec3(32, 1, 1)});
    const std::vector<std::uint32_t> object_indices(30, 3000);
    OcclusionOptions options = options_of();
    options.object_indices = object_indices;
    RhviewPlanner planner(octree, kCosts, options);
    World world(planner, 20.0);
    const auto walk = [&] {
        for (int i = 0; i < 80; ++i) world.frame(0.02 * i, boxes);
    };
    for (int round = 0; round < 3; ++round) walk();
    long in_planner = 0;
    for (int i = 0; i < 80; ++i) {
        const View view = view_at(0.02 * i);
        world.frame(0.02 * i, boxes);
        const long before = allocations();
        planner.plan({.culling_view = view, .object_boxes = boxes}, world.plan);
        in_planner += allocations() - before;
    }
    EXPECT_EQ(in_planner, 0);
}

TEST(OcclusionPlanner, objects_are_asked_about_and_those_of_unknown_size_are_drawn) {
    const RhOctree nothing;
    const std::vector<Aabb> boxes{{glm::vec3(9, -1, -1), glm::vec3(11, 1, 1)},
                                  {glm::vec3(30, -1, -1), glm::vec3(32, 1, 1)},
                                  {glm::vec3(40, -1, -1), glm::vec3(42, 1, 1)},
                                  {glm::vec3(-1, -1, -1), glm::vec3(1, 1, 1)}};
    const std::vector<std::uint32_t> object_indices{90000, 90000, 0, 90000};
    OcclusionOptions options = options_of();
    options.object_indices = std::span(object_indices).first(2);
    RhviewPlanner planner(nothing, kCosts, options);
    World world(planner, 20.0);
    for (int i = 0; i < 20; ++i) {
        world.frame(0.0, boxes);
        std::vector<bool> there(boxes.size());
        for (const ObjectId id : world.plan.objects) there[index_of(id)] = true;
        for (const ConditionalObject& conditional : world.plan.conditional_objects)
            there[index_of(conditional.object)] = true;
        EXPECT_TRUE(there[0] && there[1] && there[2] && there[3]);  // the last holds the eye
        EXPECT_TRUE(std::ranges::is_sorted(world.plan.objects));
    }
    ASSERT_EQ(world.plan.conditional_objects.size(), 1u);
    EXPECT_EQ(world.plan.conditional_objects[0].object, ObjectId{1});
    EXPECT_EQ(world.plan.query_boxes[world.plan.queries[world.plan.conditional_objects[0].query].first_box],
              boxes[1]);
}

TEST(OcclusionPlanner, a_box_that_holds_the_eye_or_crosses_the_near_plane_is_never_asked_about) {
    const Balls balls(216, 2, 80, 200);
    const RhOctree octree = octree_of(balls);
    RhviewPlanner planner(octree, kCosts, options_of());
    World world(planner, -1e9);  // nothing is ever seen
    for (int i = 0; i < 100; ++i) {
        const double time = 0.05 * i;
        world.frame(time);
        const Frustum frustum = make_frustum(view_at(time));
        const FrustumPlane& near = frustum.planes[Frustum::Near];
        for (const PlannedQuery& query : world.plan.queries) {
            Aabb whole;
            for (std::uint32_t b = 0; b < query.box_count; ++b)
                whole.grow(world.plan.query_boxes[query.first_box + b]);
            for (std::uint32_t b = 0; b < query.box_count; ++b) {
                const Aabb& box = world.plan.query_boxes[query.first_box + b];
                double nearest = std::numeric_limits<double>::infinity();
                for (int corner = 0; corner < 8; ++corner) {
                    const glm::dvec3 p((corner & 1 ? box.max : box.min).x, (corner & 2 ? box.max : box.min).y,
                                       (corner & 4 ? box.max : box.min).z);
                    nearest = std::min(nearest, glm::dot(glm::dvec3(near.normal), p - frustum.eye) +
                                                    static_cast<double>(near.distance));
                }
                EXPECT_GT(nearest, 0.0);
            }
        }
    }
}

TEST(OcclusionPlanner, without_a_price_that_pays_nothing_is_asked) {
    const Balls balls(217, 2, 60, 200);
    const RhOctree octree = octree_of(balls);
    OcclusionOptions options = options_of();
    const double never = std::numeric_limits<double>::infinity();
    options.costs = {{.query_ns = never}, {.query_ns = never}};
    RhviewPlanner planner(octree, kCosts, options), plain(octree, kCosts);
    FramePlan with, without;
    for (int i = 0; i < 20; ++i) {
        planner.plan({.culling_view = view_at(0.1 * i)}, with);
        plain.plan({.culling_view = view_at(0.1 * i)}, without);
        EXPECT_TRUE(with.queries.empty());
        EXPECT_EQ(with.opaque, without.opaque);
    }
}

TEST(SeedPlanner, asks_about_all_objects_once_they_take_too_long_and_about_none_before) {
    const RhOctree nothing;
    const std::vector<Aabb> boxes{{glm::vec3(9, -1, -1), glm::vec3(11, 1, 1)},
                                  {glm::vec3(30, -1, -1), glm::vec3(32, 1, 1)}};
    for (const std::uint32_t count : {1000u, 9'000'000u}) {
        const std::vector<std::uint32_t> object_indices{count, count};  // 1 ns each: 18 ms together
        OcclusionOptions options = options_of();
        options.settings.policy = OcclusionPolicy::Paper;
        options.object_indices = object_indices;
        SeedPlanner planner(nothing, kCosts, options);
        World world(planner, 20.0);
        for (int i = 0; i < 3; ++i) world.frame(0.0, boxes);
        EXPECT_EQ(world.plan.conditional_objects.size(), count > 1000 ? 2u : 0u);
        EXPECT_EQ(world.plan.objects.size(), count > 1000 ? 0u : 2u);
    }
}

}  // namespace
}  // namespace rhview
