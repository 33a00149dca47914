// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// What the C interface plans is what the C++ one plans.

#include <algorithm>
#include <span>

#include "job_system.h"
#include "rhview/pipeline/query_boxes.h"
#include "rhview/pipeline/rhview_planner.h"
#include "town.h"

namespace rhview {
namespace {

/// The C++ planner of the same town, the same camera.
class Twin {
  public:
    explicit Twin(const Town& town, bool asks) {
        OctreeOptions options = choose_octree_options(kCosts, index_count(town), 3);
        options.max_leaf_triangles = 40;
        octree = build_octree(town.balls.batches(), options).value();
        OcclusionOptions occlusion;
        occlusion.costs.hardware = {.query_ns = 300.0, .box_ns = 30.0, .pixel_ns = 1e-3, .draw_ns = 80.0};
        occlusion.costs.box_pass = {.query_ns = std::numeric_limits<double>::infinity()};
        planner.emplace(octree, kCosts, asks ? std::optional(occlusion) : std::nullopt);
    }

    const FramePlan& frame(double angle) {
        const rhview_camera given = camera_at(angle);
        FrameInput input;
        for (int i = 0; i < 16; ++i) {
            input.culling_view.camera_from_world[i / 4][i % 4] = given.camera_from_world[i];
            input.culling_view.clip_from_camera[i / 4][i % 4] = given.clip_from_camera[i];
        }
        input.culling_view.clip_depth = ClipDepth::ReversedZeroToOne;
        camera = input.culling_view;
        planner->plan(input, plan);
        return plan;
    }

    static std::uint64_t index_count(const Town& town) {
        std::uint64_t count = 0;
        for (const auto& indices : town.balls.indices) count += indices.size();
        return count;
    }

    static constexpr DrawCosts kCosts{1.0, 60.0, 0.0};
    RhOctree octree;
    std::optional<RhviewPlanner> planner;
    FramePlan plan;
    View camera;
};

void expect_equal(const rhview_plan& c, const FramePlan& plan) {
    EXPECT_EQ(c.hash, plan_hash(plan));
    EXPECT_EQ(c.predicted_ns, plan.predicted_ns);
    EXPECT_EQ(c.nodes_visited, plan.nodes_visited);
    ASSERT_EQ(c.draw_count, plan.opaque.size());
    for (std::size_t i = 0; i < c.draw_count; ++i)
        EXPECT_EQ((DrawRange{BatchId{c.draws[i].batch}, c.draws[i].first_index, c.draws[i].index_count}),
                  plan.opaque[i]);
    ASSERT_EQ(c.query_count, plan.queries.size());
    for (std::size_t i = 0; i < c.query_count; ++i) {
        EXPECT_EQ(c.queries[i].ticket, plan.queries[i].ticket);
        EXPECT_EQ(c.queries[i].first_box, plan.queries[i].first_box);
        EXPECT_EQ(c.queries[i].box_count, plan.queries[i].box_count);
        EXPECT_EQ(c.queries[i].way, std::uint32_t{RHVIEW_HARDWARE_QUERY});
    }
    ASSERT_EQ(c.box_count, plan.query_boxes.size());
    for (std::size_t i = 0; i < c.box_count; ++i) {
        const rhview_box& box = c.boxes[i];
        EXPECT_EQ((Aabb{{box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2]}}),
                  plan.query_boxes[i]);
    }
    ASSERT_EQ(c.conditional_draw_count, plan.conditional.size());
    for (std::size_t i = 0; i < c.conditional_draw_count; ++i) {
        EXPECT_EQ(c.conditional_draws[i].query, plan.conditional[i].query);
        EXPECT_EQ(c.conditional_draws[i].draw.first_index, plan.conditional[i].range.first_index);
    }
}

TEST(Plan, is_that_of_the_planner_in_cpp) {
    Town town;
    Twin twin(town, false);
    rhview_view* view = town.add_view(RHVIEW_OCCLUSION_OFF);
    ASSERT_OK(town.status());
    for (int i = 0; i < 10; ++i) {
        const rhview_camera camera = camera_at(0.6 * i);
        ASSERT_OK(rhview_view_set_camera(view, &camera));
        ASSERT_OK(rhview_plan_views(&view, 1, nullptr));
        expect_equal(plan_of(view), twin.frame(0.6 * i));
        EXPECT_GT(plan_of(view).draw_count, 0u);
    }
    const std::uint32_t* indices = nullptr;
    std::size_t count = 0;
    ASSERT_OK(rhview_scene_indices(town.scene, &indices, &count));
    EXPECT_TRUE(std::ranges::equal(std::span(indices, count), twin.octree.indices()));
}

TEST(Plan, with_queries_is_that_of_the_planner_in_cpp_whatever_the_answers) {
    Town town;
    Twin twin(town, true);
    rhview_view* view = town.add_view(RHVIEW_OCCLUSION_EXACT);
    ASSERT_OK(town.status());
    std::size_t asked = 0, conditional = 0;
    for (int i = 0; i < 60; ++i) {
        const rhview_camera camera = camera_at(0.01 * i);
        ASSERT_OK(rhview_view_set_camera(view, &camera));
        ASSERT_OK(rhview_plan_views(&view, 1, nullptr));
        const rhview_plan plan = plan_of(view);
        expect_equal(plan, twin.frame(0.01 * i));
        std::vector<rhview_answer> answers;
        std::vector<QueryAnswer> twin_answers;
        for (const rhview_query& query : std::span(plan.queries, plan.query_count)) {
            const bool visible = plan.boxes[query.first_box].min[0] < 30.0f;
            answers.push_back({query.ticket, visible ? 1u : 0u, 0});
            twin_answers.push_back({query.ticket, visible});
        }
        ASSERT_OK(rhview_view_absorb(view, answers.data(), answers.size()));
        twin.planner->absorb(twin_answers);
        asked += plan.query_count;
        conditional += plan.conditional_draw_count;
    }
    EXPECT_GT(asked, 0u);
    EXPECT_GT(conditional, 0u);
}

void expect_wide_boxes_of_cpp(rhview_view* view, const FramePlan& plan, const View& camera) {
    auto raster = sized<rhview_raster>();
    raster.subpixel_bits = 4;
    raster.depth_step = 0x1p-24;
    raster.rounding_growth = 1.5;
    auto lens = sized<rhview_box_lens>();
    const rhview_wide_box* boxes = nullptr;
    std::size_t count = 0;
    ASSERT_OK(rhview_view_widen_boxes(view, &raster, &lens, &boxes, &count));
    const BoxWidener widener(camera, glm::dvec3(0.0), {1280, 720, 4, 0x1p-24}, 1.5);
    ASSERT_EQ(count, plan.query_boxes.size());
    for (std::uint32_t q = 0; q < plan.queries.size(); ++q)
        for (std::uint32_t b = 0; b < plan.queries[q].box_count; ++b) {
            const rhview_wide_box& box = boxes[plan.queries[q].first_box + b];
            const BoxInstance expected = widener.widen(plan.query_boxes[plan.queries[q].first_box + b], q);
            EXPECT_EQ(glm::vec3(box.low[0], box.low[1], box.low[2]), expected.low);
            EXPECT_EQ(glm::vec3(box.high[0], box.high[1], box.high[2]), expected.high);
            EXPECT_EQ(box.shift, expected.shift);
            EXPECT_EQ(box.faces, expected.faces_and_slot);
        }
    for (int i = 0; i < 16; ++i)
        EXPECT_EQ(lens.clip_from_relative[i], widener.clip_from_relative()[i / 4][i % 4]);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(lens.depth_error[i], widener.depth_error()[i]);
    EXPECT_EQ(lens.nearer, widener.nearer());
    EXPECT_EQ(lens.nearest, widener.nearest());
}

TEST(Plan, has_its_boxes_widened_as_in_cpp) {
    Town town;
    Twin twin(town, true);
    rhview_view* view = town.add_view(RHVIEW_OCCLUSION_EXACT);
    ASSERT_OK(town.status());
    std::size_t boxes = 0;
    for (int i = 0; i < 40; ++i) {
        const rhview_camera camera = camera_at(0.01 * i), later = camera_at(0.5);
        ASSERT_OK(rhview_view_set_camera(view, &camera));
        ASSERT_OK(rhview_plan_views(&view, 1, nullptr));
        ASSERT_OK(rhview_view_set_camera(view, &later));  // of the next plan
        const FramePlan& plan = twin.frame(0.01 * i);
        expect_wide_boxes_of_cpp(view, plan, twin.camera);
        std::vector<QueryAnswer> answers;
        std::vector<rhview_answer> c_answers;
        for (const PlannedQuery& query : plan.queries) {
            answers.push_back({query.ticket, false, 0});
            c_answers.push_back({query.ticket, 0, 0});
        }
        twin.planner->absorb(answers);
        ASSERT_OK(rhview_view_absorb(view, c_answers.data(), c_answers.size()));
        boxes += plan.query_boxes.size();
    }
    EXPECT_GT(boxes, 50u);
}

TEST(Plan, of_many_views_is_that_of_each_on_any_threads) {
    std::vector<std::uint64_t> alone;
    JobSystem jobs;
    auto given = sized<rhview_workers>();
    given.thread_count = 4;
    given.run = JobSystem::run;
    given.user = &jobs;
    auto own = sized<rhview_workers>();
    own.thread_count = 2;
    for (const rhview_workers* workers :
         std::initializer_list<const rhview_workers*>{nullptr, &given, &own}) {
        Town town;
        for (int i = 0; i < 5; ++i) town.add_view(RHVIEW_OCCLUSION_EXACT, 0.9 * i);
        ASSERT_OK(town.status());
        ASSERT_OK(rhview_plan_views(town.views.data(), town.views.size(), workers));
        std::vector<std::uint64_t> hashes;
        for (const rhview_view* view : town.views) hashes.push_back(plan_of(view).hash);
        if (alone.empty()) alone = hashes;
        EXPECT_EQ(hashes, alone);
    }
    EXPECT_EQ(jobs.given.size(), 5u);
}

TEST(Build, takes_the_threads_it_is_given_and_the_same_octree_comes_out) {
    std::vector<std::uint32_t> alone;
    JobSystem jobs;
    auto workers = sized<rhview_workers>();
    workers.thread_count = 3;
    workers.run = JobSystem::run;
    workers.user = &jobs;
    auto options = sized<rhview_build_options>();
    for (const rhview_workers* given : std::initializer_list<const rhview_workers*>{nullptr, &workers}) {
        options.workers = given;
        Town town(0, &options);
        ASSERT_OK(town.status());
        const std::uint32_t* indices = nullptr;
        std::size_t count = 0;
        ASSERT_OK(rhview_scene_indices(town.scene, &indices, &count));
        if (alone.empty()) alone.assign(indices, indices + count);
        EXPECT_TRUE(std::ranges::equal(std::span(indices, count), alone));
    }
    EXPECT_EQ(jobs.calls, 1u);
    EXPECT_EQ(jobs.given.size(), 3u);
}

TEST(Build, takes_narrow_indices_and_positions_between_other_things) {
    struct Vertex {
        std::uint16_t colour[2];
        float position[3];
        float normal[3];
    };
    Town town;
    ASSERT_OK(town.status());
    std::vector<Vertex> vertices;
    for (const glm::vec3& p : town.balls.positions) vertices.push_back({{7, 7}, {p.x, p.y, p.z}, {8, 8, 8}});
    rhview_scene* scene = nullptr;
    ASSERT_OK(rhview_scene_create(nullptr, &scene));
    std::vector<std::vector<std::uint16_t>> indices;
    for (const auto& wide : town.balls.indices) indices.emplace_back(wide.begin(), wide.end());
    for (std::uint32_t i = 0; i < 3; ++i) {
        auto batch = sized<rhview_batch>();
        batch.positions = vertices[0].position;
        batch.position_stride = sizeof(Vertex);
        batch.vertex_count = vertices.size();
        batch.indices = indices[i].data();
        batch.index_count = indices[i].size();
        batch.index_bytes = 2;
        batch.is_two_sided = i == 2 ? 1 : 0;
        std::uint32_t number = 7;
        ASSERT_OK(rhview_scene_add_batch(scene, &batch, &number));
        EXPECT_EQ(number, i);
    }
    const rhview_costs costs = costs_with_queries();
    auto options = sized<rhview_build_options>();
    options.costs = &costs;
    options.max_leaf_triangles = 40;
    ASSERT_OK(rhview_scene_build(scene, &options));
    const std::uint32_t *narrow = nullptr, *wide = nullptr;
    std::size_t narrow_count = 0, wide_count = 0;
    ASSERT_OK(rhview_scene_indices(scene, &narrow, &narrow_count));
    ASSERT_OK(rhview_scene_indices(town.scene, &wide, &wide_count));
    EXPECT_TRUE(std::ranges::equal(std::span(narrow, narrow_count), std::span(wide, wide_count)));
    EXPECT_GE(narrow_count, Twin::index_count(town));
    rhview_scene_destroy(scene);
}

TEST(Build, names_the_triangle_that_is_wrong_and_can_be_tried_again) {
    const float positions[6][3] = {{5, 0, 0}, {5, 0, 1}, {5, 1, 0}, {-5, 0, 0}, {-5, 0, 1}, {-5, 1, 0}};
    std::uint32_t indices[] = {0, 1, 2, 3, 6, 5};
    auto batch = sized<rhview_batch>();
    batch.positions = positions[0];
    batch.vertex_count = 6;
    batch.indices = indices;
    batch.index_count = 6;
    rhview_scene* scene = nullptr;
    ASSERT_OK(rhview_scene_create(nullptr, &scene));
    ASSERT_OK(rhview_scene_add_batch(scene, &batch, nullptr));
    EXPECT_EQ(rhview_scene_build(scene, nullptr), RHVIEW_INVALID_DATA);
    EXPECT_NE(std::string(rhview_last_error()).find("triangle 1"), std::string::npos) << rhview_last_error();
    indices[4] = 4;
    EXPECT_OK(rhview_scene_build(scene, nullptr));
    rhview_scene_destroy(scene);
}

TEST(Build, is_stopped_by_its_progress) {
    auto options = sized<rhview_build_options>();
    options.progress = [](void*, double) { return std::int32_t{0}; };
    const Town town(0, &options);
    EXPECT_EQ(town.status(), RHVIEW_INVALID_DATA);
    EXPECT_NE(std::string(rhview_last_error()).find("stopped"), std::string::npos) << rhview_last_error();
}

TEST(Views, keep_a_scene_that_was_destroyed_before_them) {
    auto* town = new Town();
    rhview_view* view = town->add_view(RHVIEW_OCCLUSION_OFF);
    town->views.clear();
    delete town;
    ASSERT_OK(rhview_plan_views(&view, 1, nullptr));
    EXPECT_GT(plan_of(view).draw_count, 0u);
    rhview_view_destroy(view);
}

}  // namespace
}  // namespace rhview
