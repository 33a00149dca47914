// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "ball.h"
#include "rhview/lod/baked_lod.h"
#include "rhview/lod/lod_chain.h"
#include "rhview/lod/projected_error.h"
#include "town.h"

namespace rhview {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

rhview_chain chain_of(const rhview_chains* chains, std::uint32_t number) {
    auto chain = sized<rhview_chain>();
    EXPECT_OK(rhview_chains_get(chains, number, &chain));
    return chain;
}

void expect_same(const rhview_chain& c, const LodChain& chain) {
    ASSERT_EQ(c.level_count, chain.levels.size());
    for (std::size_t i = 0; i < c.level_count; ++i) {
        EXPECT_EQ(c.levels[i].first_index, chain.levels[i].first_index);
        EXPECT_EQ(c.levels[i].index_count, chain.levels[i].index_count);
        EXPECT_EQ(c.levels[i].error, chain.levels[i].error);
        EXPECT_EQ(c.levels[i].is_sloppy, chain.levels[i].sloppy);
    }
    EXPECT_TRUE(std::equal(c.indices, c.indices + c.index_count, chain.indices.begin(), chain.indices.end()));
    EXPECT_EQ(c.vertex_count, chain.vertex_count);
    EXPECT_EQ(c.end, text_of(chain.end));
}

TEST(Chains, are_those_that_are_built_in_cpp) {
    const Ball small(6), large(24);
    std::vector<std::uint16_t> narrow(large.indices.begin(), large.indices.end());
    std::vector<glm::vec4> wide;
    for (const glm::vec3& p : large.positions) wide.emplace_back(p, 7.0f);
    const rhview_mesh meshes[] = {
        small.mesh(), {&wide.data()->x, sizeof(glm::vec4), wide.size(), narrow.data(), narrow.size(), 2, 0}};
    auto options = sized<rhview_chain_options>();
    options.ratio = 0.6;
    rhview_chains* chains = nullptr;
    ASSERT_OK(rhview_chains_build(meshes, 2, &options, &chains));
    const std::array<LodMesh, 2> sources{LodMesh{small.positions, small.indices},
                                         LodMesh{large.positions, large.indices}};
    const auto expected = build_lod_chains(sources, {.ratio = 0.6});
    ASSERT_TRUE(expected);
    expect_same(chain_of(chains, 0), (*expected)[0]);
    expect_same(chain_of(chains, 1), (*expected)[1]);
    EXPECT_GT(chain_of(chains, 1).level_count, 3u);
    rhview_chains_destroy(chains);
}

/// A file that is removed.
struct File {
    std::string path = (std::filesystem::temp_directory_path() /
                        ("rhview_capi_levels_" +
                         std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".rho"))
                           .string();
    File() = default;
    ~File() { std::filesystem::remove(path); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
};

TEST(Chains, that_were_saved_are_loaded_as_they_were) {
    const File file;
    const Ball ball(16);
    const rhview_mesh mesh = ball.mesh();
    rhview_chains *built = nullptr, *loaded = nullptr;
    ASSERT_OK(rhview_chains_build(&mesh, 1, nullptr, &built));
    ASSERT_OK(rhview_chains_save(built, file.path.c_str()));
    ASSERT_OK(rhview_chains_load(file.path.c_str(), &loaded));
    const std::array<LodMesh, 1> sources{LodMesh{ball.positions, ball.indices}};
    const auto expected = build_lod_chains(sources, {});
    ASSERT_TRUE(expected);
    rhview_chains_destroy(built);
    expect_same(chain_of(loaded, 0), (*expected)[0]);
    rhview_chains_destroy(loaded);
}

TEST(Chains, of_a_file_that_is_damaged_or_without_levels_are_told) {
    const File file;
    rhview_chains* chains = nullptr;
    EXPECT_EQ(rhview_chains_load(file.path.c_str(), &chains), RHVIEW_INVALID_DATA);
    EXPECT_NE(std::string(rhview_last_error()).find(file.path), std::string::npos) << rhview_last_error();
    const Ball ball(16);
    const rhview_mesh mesh = ball.mesh();
    ASSERT_OK(rhview_chains_build(&mesh, 1, nullptr, &chains));
    ASSERT_OK(rhview_chains_save(chains, file.path.c_str()));
    EXPECT_EQ(rhview_chains_save(chains, "/nowhere/at/all.rho"), RHVIEW_INVALID_DATA);
    rhview_chains_destroy(std::exchange(chains, nullptr));
    {
        std::fstream stream(file.path, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekp(-9, std::ios::end);
        stream.put('\x5a');
    }
    EXPECT_EQ(rhview_chains_load(file.path.c_str(), &chains), RHVIEW_INVALID_DATA);
    EXPECT_NE(std::string(rhview_last_error()).find(file.path), std::string::npos) << rhview_last_error();
    {
        auto writer = RhoWriter::create(file.path);
        ASSERT_TRUE(writer);
        ASSERT_TRUE(writer->finish());
    }
    EXPECT_EQ(rhview_chains_load(file.path.c_str(), &chains), RHVIEW_INVALID_DATA);
    EXPECT_NE(std::string(rhview_last_error()).find("no levels"), std::string::npos) << rhview_last_error();
    EXPECT_EQ(chains, nullptr);
}

TEST(Chains, that_cannot_be_are_told) {
    const Ball ball(4);
    rhview_mesh mesh = ball.mesh();
    rhview_chains* chains = nullptr;
    EXPECT_EQ(rhview_chains_build(nullptr, 1, nullptr, &chains), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_chains_build(&mesh, 1, nullptr, nullptr), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_chains_load(nullptr, &chains), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_chains_save(nullptr, "x"), RHVIEW_INVALID_ARGUMENT);
    for (const double ratio : {0.05, 0.9, -1.0, kNan}) {
        auto options = sized<rhview_chain_options>();
        options.ratio = ratio;
        EXPECT_EQ(rhview_chains_build(&mesh, 1, &options, &chains), RHVIEW_INVALID_ARGUMENT) << ratio;
    }
    mesh.index_bytes = 3;
    EXPECT_EQ(rhview_chains_build(&mesh, 1, nullptr, &chains), RHVIEW_INVALID_ARGUMENT);
    EXPECT_STREQ(rhview_last_error(), "rhview_mesh: index_bytes is 2 or 4");
    mesh = ball.mesh();
    mesh.position_stride = 8;
    EXPECT_EQ(rhview_chains_build(&mesh, 1, nullptr, &chains), RHVIEW_INVALID_ARGUMENT);
    mesh = ball.mesh();
    mesh.vertex_count = 5;  // fewer than the indices name
    EXPECT_EQ(rhview_chains_build(&mesh, 1, nullptr, &chains), RHVIEW_INVALID_DATA);
    mesh = ball.mesh();
    mesh.index_count -= 1;
    EXPECT_EQ(rhview_chains_build(&mesh, 1, nullptr, &chains), RHVIEW_INVALID_DATA);
    auto options = sized<rhview_chain_options>();
    options.progress = [](void*, double) -> std::int32_t { return 0; };
    mesh = ball.mesh();
    EXPECT_EQ(rhview_chains_build(&mesh, 1, &options, &chains), RHVIEW_INVALID_DATA);
    EXPECT_EQ(chains, nullptr);
    ASSERT_OK(rhview_chains_build(nullptr, 0, nullptr, &chains));
    auto chain = sized<rhview_chain>();
    EXPECT_EQ(rhview_chains_get(chains, 0, &chain), RHVIEW_INVALID_ARGUMENT);
    rhview_chains_destroy(chains);
    rhview_chains_destroy(nullptr);
}

/// Balls in a row ahead of the eye, farther and farther, and a view of them.
class Row : public testing::Test {
  protected:
    static constexpr std::uint32_t kBalls = 40;

    Row() {
        const Ball ball(32);
        const rhview_mesh mesh = ball.mesh();
        EXPECT_OK(rhview_chains_build(&mesh, 1, nullptr, &chains));
        auto options = sized<rhview_scene_options>();
        options.max_objects = kBalls + 1;
        options.chains = chains;
        EXPECT_OK(rhview_scene_create(&options, &scene));
        EXPECT_OK(rhview_scene_build(scene, nullptr));
        for (std::uint32_t i = 0; i < kBalls; ++i) add(distance(i), 1.0);
        view = add_view();
    }
    ~Row() override {
        rhview_view_destroy(view);
        rhview_scene_destroy(scene);
        rhview_chains_destroy(chains);
    }

    static float distance(std::uint32_t i) { return 4.0f * std::pow(1.1f, static_cast<float>(i)); }

    std::uint32_t add(float x, double scale) {
        auto object = sized<rhview_object>();
        const auto radius = static_cast<float>(scale);
        object.box = {{x - radius, -radius, -radius}, {x + radius, radius, radius}};
        object.index_count = chain_of(chains, 0).levels[0].index_count;
        object.has_chain = 1;
        object.scale = scale == 1.0 ? 0.0 : scale;
        std::uint32_t number = 0;
        EXPECT_OK(rhview_scene_add_object(scene, &object, &number));
        return number;
    }

    rhview_view* add_view() {
        const rhview_costs costs = costs_with_queries();
        auto options = sized<rhview_view_options>();
        options.costs = &costs;
        rhview_view* added = nullptr;
        EXPECT_OK(rhview_view_create(scene, &options, &added));
        const rhview_camera camera = camera_at(0.0);
        EXPECT_OK(rhview_view_set_camera(added, &camera));
        return added;
    }

    static void bound(rhview_view* view, double max_error_px, double budget_ns = 0.0) {
        auto bounds = sized<rhview_level_bounds>();
        bounds.max_error_px = max_error_px;
        bounds.budget_ns = budget_ns;
        EXPECT_OK(rhview_view_set_levels(view, &bounds));
    }

    rhview_plan frame(rhview_view* of) {
        EXPECT_OK(rhview_scene_begin_frame(scene, time_s += 0.01));
        EXPECT_OK(rhview_plan_views(&of, 1, nullptr));
        EXPECT_OK(rhview_scene_end_frame(scene));
        return plan_of(of);
    }

    /// By object.
    static std::vector<std::uint32_t> levels_of(const rhview_plan& plan) {
        std::vector<std::uint32_t> levels(kBalls + 1, 0);
        for (std::size_t i = 0; i < plan.object_count; ++i)
            levels[plan.objects[i].object] = plan.objects[i].level;
        return levels;
    }

    /// What a unit of a ball moves in the picture at most.
    static double pixels(float x) {
        const View camera{look_along({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                          perspective(1.0, 1.5, 0.1, 500.0, ClipDepth::ReversedZeroToOne),
                          ClipDepth::ReversedZeroToOne};
        return pixels_per_unit(camera.clip_from_eye_relative(), {{x, 0, 0}, std::sqrt(3.0)}, 1280, 720);
    }

    rhview_chains* chains = nullptr;
    rhview_scene* scene = nullptr;
    rhview_view* view = nullptr;
    double time_s = 0.0;
};

TEST_F(Row, is_drawn_in_full_detail_unless_a_bound_is_set) {
    EXPECT_EQ(levels_of(frame(view)), std::vector<std::uint32_t>(kBalls + 1, 0));
    bound(view, 2.0);
    EXPECT_GT(levels_of(frame(view)).at(kBalls - 1), 0u);
    EXPECT_OK(rhview_view_set_levels(view, nullptr));
    EXPECT_EQ(levels_of(frame(view)), std::vector<std::uint32_t>(kBalls + 1, 0));
}

TEST_F(Row, is_drawn_at_the_coarsest_levels_within_the_bound) {
    const rhview_chain chain = chain_of(chains, 0);
    bound(view, 1.0);
    const rhview_plan plan = frame(view);
    ASSERT_EQ(plan.object_count, kBalls);
    double worst = 0.0;
    std::uint64_t indices = 0;
    const std::vector<std::uint32_t> levels = levels_of(plan);
    for (std::uint32_t i = 0; i < kBalls; ++i) {
        const double error_px = projected_error_px(chain.levels[levels[i]].error, pixels(distance(i)));
        EXPECT_LE(error_px, 1.0);
        if (levels[i] + 1 < chain.level_count) {
            EXPECT_GT(projected_error_px(chain.levels[levels[i] + 1].error, pixels(distance(i))), 1.0) << i;
        }
        worst = std::max(worst, error_px);
        indices += chain.levels[levels[i]].index_count;
    }
    EXPECT_GT(levels[kBalls - 1], levels[0]);
    EXPECT_NEAR(plan.level_error_px, worst, 1e-6);
    EXPECT_EQ(plan.level_indices, indices);
    EXPECT_EQ(plan.misses_bound, 0u);
    EXPECT_EQ(plan.misses_budget, 0u);
    auto state = sized<rhview_object_state>();
    ASSERT_OK(rhview_view_object_state(view, kBalls - 1, &state));
    EXPECT_EQ(state.level, levels[kBalls - 1]);
}

TEST_F(Row, keeps_a_budget_and_says_what_that_costs) {
    bound(view, 0.0, 20'000.0);  // at 1 ns an index
    const rhview_plan within = frame(view);
    EXPECT_LE(within.level_ns, 20'000.0);
    EXPECT_GT(within.level_indices, 10'000u);
    EXPECT_EQ(within.misses_budget, 0u);
    EXPECT_EQ(within.misses_bound, 1u);
    EXPECT_GT(within.level_error_px, 0.0);
    bound(view, 0.0, 1.0);
    EXPECT_EQ(frame(view).misses_budget, 1u);
}

TEST_F(Row, is_judged_by_each_view_for_itself) {
    rhview_view* small = add_view();
    rhview_camera camera = camera_at(0.0);
    camera.viewport_width = 320;
    camera.viewport_height = 180;
    ASSERT_OK(rhview_view_set_camera(small, &camera));
    bound(view, 1.0);
    bound(small, 1.0);
    rhview_view* const both[] = {view, small};
    ASSERT_OK(rhview_scene_begin_frame(scene, 1.0));
    ASSERT_OK(rhview_plan_views(both, 2, nullptr));
    ASSERT_OK(rhview_scene_end_frame(scene));
    EXPECT_GT(levels_of(plan_of(small))[10], levels_of(plan_of(view))[10]);
    rhview_view_destroy(small);
}

TEST_F(Row, heeds_what_is_added_while_views_are_there) {
    bound(view, 1.0);
    frame(view);
    const std::uint32_t number = add(distance(kBalls - 1), 0.25);
    EXPECT_GT(levels_of(frame(view))[number], levels_of(plan_of(view))[10]);
    ASSERT_OK(rhview_scene_remove_object(scene, number));
    auto object = sized<rhview_object>();
    object.box = {{30, -1, -1}, {32, 1, 1}};
    std::uint32_t again = 0;
    ASSERT_OK(rhview_scene_add_object(scene, &object, &again));
    ASSERT_EQ(again, number);
    EXPECT_EQ(levels_of(frame(view))[number], 0u) << "it has no chain now";
}

TEST_F(Row, outlives_the_handle_of_its_chains) {
    rhview_chains_destroy(std::exchange(chains, nullptr));
    bound(view, 2.0);
    EXPECT_GT(levels_of(frame(view)).at(kBalls - 1), 0u);
}

TEST_F(Row, tells_bounds_and_chains_that_cannot_be) {
    auto bounds = sized<rhview_level_bounds>();
    EXPECT_EQ(rhview_view_set_levels(nullptr, &bounds), RHVIEW_INVALID_ARGUMENT);
    for (double rhview_level_bounds::*field :
         {&rhview_level_bounds::max_error_px, &rhview_level_bounds::budget_ns,
          &rhview_level_bounds::object_ns})
        for (const double wrong : {-1.0, kNan, std::numeric_limits<double>::infinity()}) {
            bounds = sized<rhview_level_bounds>();
            bounds.*field = wrong;
            EXPECT_EQ(rhview_view_set_levels(view, &bounds), RHVIEW_INVALID_ARGUMENT);
        }
    auto object = sized<rhview_object>();
    std::uint32_t number = 0;
    object.has_chain = 1;
    object.chain = 1;
    EXPECT_EQ(rhview_scene_add_object(scene, &object, &number), RHVIEW_INVALID_ARGUMENT);
    object.chain = 0;
    object.scale = -1.0;
    EXPECT_EQ(rhview_scene_add_object(scene, &object, &number), RHVIEW_INVALID_ARGUMENT);
    rhview_scene* without = nullptr;
    auto options = sized<rhview_scene_options>();
    options.max_objects = 1;
    ASSERT_OK(rhview_scene_create(&options, &without));
    object.scale = 1.0;
    EXPECT_EQ(rhview_scene_add_object(without, &object, &number), RHVIEW_INVALID_ARGUMENT);
    rhview_scene_destroy(without);
}

}  // namespace
}  // namespace rhview
