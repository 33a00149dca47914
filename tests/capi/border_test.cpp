// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// What comes over the border: structures of other sizes, and calls that are wrong.

#include <cstring>
#include <limits>
#include <string>
#include <thread>

#include "town.h"

namespace rhview {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Whether the last error's sentence holds `part`.
testing::AssertionResult says(const std::string& part) {
    const std::string sentence = rhview_last_error();
    if (sentence.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "it says: " << sentence;
}

TEST(Structures, of_an_older_header_are_taken_with_zeros_behind) {
    auto options = sized<rhview_scene_options>();
    options.max_objects = 5;  // beyond the size that is told: not there
    options.size = offsetof(rhview_scene_options, max_objects);
    rhview_scene* scene = nullptr;
    ASSERT_OK(rhview_scene_create(&options, &scene));
    auto object = sized<rhview_object>();
    std::uint32_t number = 0;
    EXPECT_EQ(rhview_scene_add_object(scene, &object, &number), RHVIEW_WRONG_STATE);
    rhview_scene_destroy(scene);
}

TEST(Structures, of_a_newer_header_are_taken_if_what_they_add_is_zero) {
    struct Newer {
        rhview_scene_options known;
        std::uint64_t added;
    } newer{};
    newer.known.size = sizeof(Newer);
    rhview_scene* scene = nullptr;
    ASSERT_OK(rhview_scene_create(&newer.known, &scene));
    rhview_scene_destroy(scene);
    newer.added = 1;
    EXPECT_EQ(rhview_scene_create(&newer.known, &scene), RHVIEW_INVALID_ARGUMENT);
    EXPECT_TRUE(says("rhview_scene_options: its size is " + std::to_string(sizeof(Newer))));
}

TEST(Structures, whose_size_was_not_set_are_refused) {
    rhview_scene_options options{};
    rhview_scene* scene = nullptr;
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1} << 20}) {
        options.size = size;
        EXPECT_EQ(rhview_scene_create(&options, &scene), RHVIEW_INVALID_ARGUMENT);
        EXPECT_TRUE(says("set it to zero, then size to sizeof"));
    }
    EXPECT_EQ(scene, nullptr);
}

TEST(Structures, that_end_within_a_field_are_refused) {
    auto options = sized<rhview_scene_options>();
    options.size = offsetof(rhview_scene_options, chains) + 4;  // half a pointer
    rhview_scene* scene = nullptr;
    EXPECT_EQ(rhview_scene_create(&options, &scene), RHVIEW_INVALID_ARGUMENT);
    EXPECT_TRUE(says("rhview_scene_options: its size is"));
    auto costs = costs_with_queries();
    costs.size = sizeof costs - 1;
    EXPECT_EQ(rhview_costs_load(RHVIEW_TEST_PROFILE, 0, &costs), RHVIEW_INVALID_ARGUMENT);
}

TEST(Structures, that_are_filled_are_filled_as_far_as_they_go) {
    Town town;
    rhview_view* view = town.add_view(RHVIEW_OCCLUSION_OFF);
    ASSERT_OK(town.status());
    ASSERT_OK(rhview_plan_views(&view, 1, nullptr));
    rhview_plan shorter;
    std::memset(&shorter, 0xab, sizeof shorter);
    shorter.size = offsetof(rhview_plan, objects);
    ASSERT_OK(rhview_view_plan(view, &shorter));
    EXPECT_EQ(shorter.draw_count, plan_of(view).draw_count);
    EXPECT_EQ(shorter.size, offsetof(rhview_plan, objects));
    EXPECT_EQ(shorter.object_count, 0xababababababababu);
    struct Newer {
        rhview_plan known;
        std::uint64_t added;
    } newer{};
    newer.known.size = sizeof(Newer);
    newer.added = 7;
    ASSERT_OK(rhview_view_plan(view, &newer.known));
    EXPECT_EQ(newer.known.hash, plan_of(view).hash);
    EXPECT_EQ(newer.added, 0u);
}

TEST(Versions, of_header_and_library_agree) {
    EXPECT_EQ(rhview_c_api_version(), RHVIEW_C_API_VERSION);
    EXPECT_EQ(std::string(rhview_version()).substr(0, 2), "0.");
}

TEST(LastError, belongs_to_its_thread) {
    EXPECT_EQ(rhview_scene_create(nullptr, nullptr), RHVIEW_INVALID_ARGUMENT);
    std::string other;
    std::thread([&] { other = rhview_last_error(); }).join();
    EXPECT_TRUE(says("rhview_scene_create"));
    EXPECT_EQ(other, "");
}

TEST(WrongCalls, with_null_are_told) {
    const std::uint32_t* numbers = nullptr;
    std::size_t count = 0;
    std::uint32_t number = 0;
    const rhview_box box{};
    const rhview_camera camera{};
    auto plan = sized<rhview_plan>();
    auto changes = sized<rhview_changes>();
    auto state = sized<rhview_object_state>();
    rhview_view* none = nullptr;
    EXPECT_EQ(rhview_scene_add_batch(nullptr, nullptr, nullptr), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_scene_build(nullptr, nullptr), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_scene_indices(nullptr, &numbers, &count), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_scene_add_object(nullptr, nullptr, &number), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_scene_remove_object(nullptr, 0), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_scene_begin_frame(nullptr, 0.0), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_scene_due_objects(nullptr, &numbers, &count), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_scene_move_object(nullptr, 0, &box), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_scene_jump_object(nullptr, 0, &box), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_scene_end_frame(nullptr), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_view_create(nullptr, nullptr, &none), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_view_set_camera(nullptr, &camera), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_plan_views(nullptr, 1, nullptr), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_plan_views(&none, 1, nullptr), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_view_plan(nullptr, &plan), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_view_absorb(nullptr, nullptr, 0), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_view_changes(nullptr, &changes), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_view_object_state(nullptr, 0, &state), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_costs_load(nullptr, 0, nullptr), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_costs_fit(nullptr, 1, nullptr), RHVIEW_INVALID_ARGUMENT);
    rhview_scene_destroy(nullptr);
    rhview_view_destroy(nullptr);
    EXPECT_OK(rhview_plan_views(nullptr, 0, nullptr));
}

TEST(WrongCalls, at_the_wrong_time_are_told) {
    rhview_scene* scene = nullptr;
    ASSERT_OK(rhview_scene_create(nullptr, &scene));
    const std::uint32_t* indices = nullptr;
    std::size_t count = 0;
    rhview_view* view = nullptr;
    EXPECT_EQ(rhview_scene_indices(scene, &indices, &count), RHVIEW_WRONG_STATE);
    EXPECT_EQ(rhview_view_create(scene, nullptr, &view), RHVIEW_WRONG_STATE);
    ASSERT_OK(rhview_scene_build(scene, nullptr));
    EXPECT_EQ(rhview_scene_build(scene, nullptr), RHVIEW_WRONG_STATE);
    auto batch = sized<rhview_batch>();
    EXPECT_EQ(rhview_scene_add_batch(scene, &batch, nullptr), RHVIEW_WRONG_STATE);
    ASSERT_OK(rhview_view_create(scene, nullptr, &view));
    auto plan = sized<rhview_plan>();
    EXPECT_EQ(rhview_view_plan(view, &plan), RHVIEW_WRONG_STATE);
    EXPECT_EQ(rhview_plan_views(&view, 1, nullptr), RHVIEW_WRONG_STATE);
    EXPECT_TRUE(says("no camera"));
    rhview_view_destroy(view);
    rhview_scene_destroy(scene);
}

TEST(WrongCalls, about_boxes_are_told) {
    Town town;
    rhview_view* view = town.add_view(RHVIEW_OCCLUSION_EXACT);
    ASSERT_OK(town.status());
    auto lens = sized<rhview_box_lens>();
    auto raster = sized<rhview_raster>();
    const rhview_wide_box* boxes = nullptr;
    std::size_t count = 0;
    EXPECT_EQ(rhview_view_widen_boxes(view, nullptr, &lens, &boxes, &count), RHVIEW_WRONG_STATE);
    ASSERT_OK(rhview_plan_views(&view, 1, nullptr));
    EXPECT_EQ(rhview_view_widen_boxes(nullptr, nullptr, &lens, &boxes, &count), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_view_widen_boxes(view, nullptr, nullptr, &boxes, &count), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_view_widen_boxes(view, nullptr, &lens, nullptr, &count), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_view_widen_boxes(view, nullptr, &lens, &boxes, nullptr), RHVIEW_INVALID_ARGUMENT);
    raster.subpixel_bits = 17;
    EXPECT_EQ(rhview_view_widen_boxes(view, &raster, &lens, &boxes, &count), RHVIEW_INVALID_ARGUMENT);
    for (const double wrong : {-1.0, 2.0, kNan}) {
        raster = sized<rhview_raster>();
        raster.depth_step = wrong;
        EXPECT_EQ(rhview_view_widen_boxes(view, &raster, &lens, &boxes, &count), RHVIEW_INVALID_ARGUMENT);
    }
    for (const double wrong : {-1.0, 0.5, kNan, std::numeric_limits<double>::infinity()}) {
        raster = sized<rhview_raster>();
        raster.rounding_growth = wrong;
        EXPECT_EQ(rhview_view_widen_boxes(view, &raster, &lens, &boxes, &count), RHVIEW_INVALID_ARGUMENT);
    }
    lens.size = 3;
    EXPECT_EQ(rhview_view_widen_boxes(view, nullptr, &lens, &boxes, &count), RHVIEW_INVALID_ARGUMENT);
    lens = sized<rhview_box_lens>();
    EXPECT_OK(rhview_view_widen_boxes(view, nullptr, &lens, &boxes, &count));
    EXPECT_EQ(count, plan_of(view).box_count);
}

TEST(WrongCalls, with_the_views_of_two_scenes_or_one_twice_are_told) {
    Town one, other;
    rhview_view* views[] = {one.add_view(RHVIEW_OCCLUSION_OFF), other.add_view(RHVIEW_OCCLUSION_OFF)};
    EXPECT_EQ(rhview_plan_views(views, 2, nullptr), RHVIEW_INVALID_ARGUMENT);
    EXPECT_TRUE(says("several scenes"));
    views[1] = views[0];
    EXPECT_EQ(rhview_plan_views(views, 2, nullptr), RHVIEW_INVALID_ARGUMENT);
    EXPECT_TRUE(says("twice"));
}

TEST(WrongCalls, with_numbers_that_cannot_be_are_told) {
    Town town;
    rhview_view* view = town.add_view(RHVIEW_OCCLUSION_OFF);
    rhview_camera camera = camera_at(0.0);
    camera.camera_from_world[5] = kNan;
    EXPECT_EQ(rhview_view_set_camera(view, &camera), RHVIEW_INVALID_DATA);
    camera = camera_at(0.0);
    camera.viewport_width = 0;
    EXPECT_EQ(rhview_view_set_camera(view, &camera), RHVIEW_INVALID_ARGUMENT);
    camera = camera_at(0.0);
    camera.clip_depth = 3;
    EXPECT_EQ(rhview_view_set_camera(view, &camera), RHVIEW_INVALID_ARGUMENT);

    auto options = sized<rhview_view_options>();
    rhview_view* other = nullptr;
    options.occlusion = RHVIEW_OCCLUSION_EXACT;
    EXPECT_EQ(rhview_view_create(town.scene, &options, &other), RHVIEW_INVALID_ARGUMENT);
    EXPECT_TRUE(says("has_hardware_queries"));
    options.occlusion = 3;
    EXPECT_EQ(rhview_view_create(town.scene, &options, &other), RHVIEW_INVALID_ARGUMENT);
    options.occlusion = RHVIEW_OCCLUSION_OFF;
    const double falling[] = {20.0, 10.0}, unknown[] = {kNan, 10.0};
    options.band_count = 2;
    for (const double* ends : {static_cast<const double*>(nullptr), falling, unknown}) {
        options.band_ends = ends;
        EXPECT_EQ(rhview_view_create(town.scene, &options, &other), RHVIEW_INVALID_ARGUMENT);
    }
    options.band_count = 0;
    options.band_hysteresis = 1.5;
    EXPECT_EQ(rhview_view_create(town.scene, &options, &other), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(other, nullptr);
}

TEST(WrongCalls, with_batches_that_cannot_be_are_told) {
    rhview_scene* scene = nullptr;
    ASSERT_OK(rhview_scene_create(nullptr, &scene));
    const float corner[3] = {};
    const std::uint32_t index = 0;
    const auto refuses = [&](auto change) {
        auto batch = sized<rhview_batch>();
        batch.positions = corner;
        batch.vertex_count = 1;
        batch.indices = &index;
        batch.index_count = 1;
        change(batch);
        return rhview_scene_add_batch(scene, &batch, nullptr) == RHVIEW_INVALID_ARGUMENT;
    };
    EXPECT_TRUE(refuses([](rhview_batch& batch) { batch.index_bytes = 1; }));
    EXPECT_TRUE(refuses([](rhview_batch& batch) { batch.position_stride = 8; }));
    EXPECT_TRUE(refuses([](rhview_batch& batch) { batch.positions = nullptr; }));
    EXPECT_TRUE(refuses([](rhview_batch& batch) { batch.indices = nullptr; }));
    EXPECT_FALSE(refuses([](rhview_batch&) {}));
    EXPECT_EQ(rhview_scene_build(scene, nullptr), RHVIEW_INVALID_DATA);  // one index is no triangle
    rhview_scene_destroy(scene);
}

TEST(Costs, that_cannot_be_are_told) {
    rhview_scene* scene = nullptr;
    ASSERT_OK(rhview_scene_create(nullptr, &scene));
    auto options = sized<rhview_build_options>();
    for (const double wrong : {-1.0, kNan, std::numeric_limits<double>::infinity()}) {
        rhview_costs costs = costs_with_queries();
        options.costs = &costs;
        costs.draw_ns = wrong;
        EXPECT_EQ(rhview_scene_build(scene, &options), RHVIEW_INVALID_ARGUMENT);
        costs = costs_with_queries();
        costs.hardware_queries.box_ns = wrong;
        EXPECT_EQ(rhview_scene_build(scene, &options), RHVIEW_INVALID_ARGUMENT);
    }
    const auto nothing = sized<rhview_costs>();
    options.costs = &nothing;
    EXPECT_EQ(rhview_scene_build(scene, &options), RHVIEW_INVALID_ARGUMENT);
    EXPECT_TRUE(says("costs anything"));
    rhview_scene_destroy(scene);
}

TEST(Costs, come_from_a_profile) {
    auto plain = sized<rhview_costs>(), multi = sized<rhview_costs>();
    ASSERT_OK(rhview_costs_load(RHVIEW_TEST_PROFILE, 0, &plain));
    ASSERT_OK(rhview_costs_load(RHVIEW_TEST_PROFILE, 1, &multi));
    EXPECT_NEAR(plain.index_ns, 3.5176, 1e-4);
    EXPECT_NEAR(plain.draw_ns, 119.893 + 104.420, 1e-3);
    EXPECT_EQ(plain.call_ns, 0.0);
    EXPECT_NEAR(multi.draw_ns, 104.420, 1e-3);
    EXPECT_NEAR(multi.call_ns, 119.893, 1e-3);
    EXPECT_NEAR(plain.shown_index_ns, 3.5176 + 32.1105 / 3.0, 1e-3);
    EXPECT_EQ(plain.has_hardware_queries, 1u);
    EXPECT_NEAR(plain.hardware_queries.box_ns, 711.614, 1e-3);
    EXPECT_EQ(rhview_costs_load("/nowhere/profile.json", 0, &plain), RHVIEW_INVALID_DATA);
    EXPECT_TRUE(says("/nowhere/profile.json: there is no such file"));
}

TEST(Costs, are_fitted_to_frames) {
    std::vector<rhview_frame_sample> frames;
    for (int i = 0; i < 24; ++i) {
        const double indices = 1e5 * (1 + i % 5), draws = 100.0 * (1 + i % 7);
        frames.push_back({indices, draws, 2e5 + 0.25 * indices + 900.0 * draws});
    }
    rhview_costs costs = costs_with_queries();
    ASSERT_OK(rhview_costs_fit(frames.data(), frames.size(), &costs));
    EXPECT_NEAR(costs.index_ns, 0.25, 1e-6);
    EXPECT_NEAR(costs.draw_ns, 900.0, 1e-3);
    EXPECT_EQ(costs.has_hardware_queries, 1u);
    EXPECT_EQ(costs.hardware_queries.query_ns, 300.0);
    EXPECT_EQ(rhview_costs_fit(frames.data(), 3, &costs), RHVIEW_INVALID_DATA);
    EXPECT_TRUE(says("3"));
}

}  // namespace
}  // namespace rhview
