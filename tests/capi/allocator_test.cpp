// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <set>
#include <string>

#include "ball.h"
#include "job_system.h"
#include "town.h"

namespace rhview {
namespace {

/// Memory that knows what it gave, and fails when it is told to.
class Memory {
  public:
    Memory() {
        auto allocator = sized<rhview_allocator>();
        allocator.user = this;
        allocator.allocate = allocate;
        allocator.release = release;
        EXPECT_OK(rhview_set_allocator(&allocator));
    }
    ~Memory() {
        EXPECT_OK(rhview_set_allocator(nullptr));
        EXPECT_TRUE(blocks_.empty()) << blocks_.size() << " blocks were not given back";
        EXPECT_EQ(strangers, 0u) << "blocks that are not ours came back";
    }
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;

    std::size_t given = 0;
    std::size_t strangers = 0;
    std::size_t fails_at = std::numeric_limits<std::size_t>::max();  ///< this one, and all after it

  private:
    static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
        auto& memory = *static_cast<Memory*>(user);
        const std::lock_guard lock(memory.mutex_);
        if (memory.given++ >= memory.fails_at) return nullptr;
        void* block = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
        memory.blocks_.insert(block);
        return block;
    }
    static void release(void* user, void* block) {
        auto& memory = *static_cast<Memory*>(user);
        const std::lock_guard lock(memory.mutex_);
        if (memory.blocks_.erase(block) == 0) {
            ++memory.strangers;
            return;
        }
        std::free(block);
    }

    std::mutex mutex_;
    std::set<void*> blocks_;
};

/// Build, views, objects and answers; the status of the first call that fails.
rhview_status live_through(Town& town, const rhview_workers* workers) {
    rhview_view* view = town.add_view(RHVIEW_OCCLUSION_EXACT);
    if (town.status() != RHVIEW_OK) return town.status();
    auto object = sized<rhview_object>();
    object.box = {{9, -1, -1}, {11, 1, 1}};
    object.index_count = 900;
    std::uint32_t number = 0;
    if (const auto status = rhview_scene_add_object(town.scene, &object, &number); status != RHVIEW_OK)
        return status;
    for (int i = 0; i < 5; ++i) {
        if (const auto status = rhview_scene_begin_frame(town.scene, 0.1 * i); status != RHVIEW_OK)
            return status;
        if (const auto status = rhview_plan_views(&view, 1, workers); status != RHVIEW_OK) return status;
        const rhview_plan plan = plan_of(view);
        std::vector<rhview_answer> answers;
        for (std::size_t q = 0; q < plan.query_count; ++q)
            answers.push_back({plan.queries[q].ticket, q % 2 == 0 ? 1u : 0u, 0});
        if (const auto status = rhview_view_absorb(view, answers.data(), answers.size()); status != RHVIEW_OK)
            return status;
        if (const auto status = rhview_scene_end_frame(town.scene); status != RHVIEW_OK) return status;
    }
    return RHVIEW_OK;
}

TEST(Allocator, gives_all_memory_and_gets_it_back) {
    Memory memory;
    {
        Town town(4);
        EXPECT_OK(live_through(town, nullptr));
        auto costs = sized<rhview_costs>();
        EXPECT_OK(rhview_costs_load(RHVIEW_TEST_PROFILE, 0, &costs));
        EXPECT_EQ(rhview_costs_load("/nowhere", 0, &costs), RHVIEW_INVALID_DATA);
        std::vector<rhview_frame_sample> frames;
        for (int i = 0; i < 24; ++i) {
            const double indices = 1e5 * (1 + i % 5), draws = 100.0 * (1 + i % 7);
            frames.push_back({indices, draws, 2e5 + 0.25 * indices + 900.0 * draws});
        }
        EXPECT_OK(rhview_costs_fit(frames.data(), frames.size(), &costs));
    }
    EXPECT_GT(memory.given, 100u);
}

TEST(Allocator, serves_files_too) {
    // A name too long for a string or a path to keep inside itself.
    const std::string file =
        testing::TempDir() + "rhview_levels_in_a_file_whose_name_takes_memory_of_its_own.rho";
    Memory memory;
    const Ball ball(24);
    const rhview_mesh mesh = ball.mesh();
    rhview_chains* built = nullptr;
    ASSERT_OK(rhview_chains_build(&mesh, 1, nullptr, &built));
    EXPECT_OK(rhview_chains_save(built, file.c_str()));
    EXPECT_OK(rhview_chains_save(built, file.c_str()));  // replaces it
    rhview_chains* loaded = nullptr;
    EXPECT_OK(rhview_chains_load(file.c_str(), &loaded));
    EXPECT_EQ(rhview_chains_load((file + ".not").c_str(), &loaded), RHVIEW_INVALID_DATA);
    EXPECT_EQ(rhview_chains_save(built, "/no/such/folder/whose/name/is/long/enough.rho"),
              RHVIEW_INVALID_DATA);
    rhview_chains_destroy(loaded);
    rhview_chains_destroy(built);
    std::remove(file.c_str());
}

TEST(Allocator, serves_the_threads_of_a_build_too) {
    JobSystem jobs;
    auto workers = sized<rhview_workers>();
    workers.thread_count = 3;
    workers.run = JobSystem::run;
    workers.user = &jobs;
    auto options = sized<rhview_build_options>();
    options.workers = &workers;
    Memory memory;
    Town town(4, &options);
    EXPECT_OK(live_through(town, &workers));
}

TEST(Allocator, that_runs_out_ends_any_call_with_a_status_and_leaks_nothing) {
    std::size_t failed = 0;
    for (std::size_t fails_at = 0;; fails_at += 1 + fails_at / 8) {
        Memory memory;
        memory.fails_at = fails_at;
        rhview_status status = RHVIEW_OK;
        {
            rhview_scene* scene = nullptr;
            auto options = sized<rhview_scene_options>();
            options.max_objects = 4;
            if (rhview_scene_create(&options, &scene) == RHVIEW_OUT_OF_MEMORY) {
                EXPECT_EQ(scene, nullptr);
                ++failed;
                continue;
            }
            rhview_scene_destroy(scene);
            Town town(4);
            status = town.scene == nullptr ? town.status() : live_through(town, nullptr);
        }
        if (status == RHVIEW_OK) break;
        EXPECT_EQ(status, RHVIEW_OUT_OF_MEMORY) << "at " << fails_at << ": " << rhview_last_error();
        ++failed;
    }
    EXPECT_GT(failed, 20u);
}

TEST(Allocator, is_not_changed_while_its_memory_is_in_use) {
    Town town;
    auto allocator = sized<rhview_allocator>();
    EXPECT_EQ(rhview_set_allocator(&allocator), RHVIEW_WRONG_STATE);
    allocator.allocate = [](void*, std::size_t, std::size_t) -> void* { return nullptr; };
    EXPECT_EQ(rhview_set_allocator(&allocator), RHVIEW_INVALID_ARGUMENT);
}

TEST(Allocator, is_not_asked_by_a_warm_view) {
    Memory memory;
    Town town;
    rhview_view* view = town.add_view(RHVIEW_OCCLUSION_OFF);
    for (int i = 0; i < 3; ++i) EXPECT_OK(rhview_plan_views(&view, 1, nullptr));
    const std::size_t before = memory.given;
    for (int i = 0; i < 3; ++i) EXPECT_OK(rhview_plan_views(&view, 1, nullptr));
    EXPECT_GT(plan_of(view).draw_count, 0u);
    EXPECT_EQ(memory.given, before);
}

/// A scene of objects with levels of detail, planned by a bound.
rhview_status live_with_levels(rhview_chains*& chains, rhview_scene*& scene, rhview_view*& view) {
    const Ball ball(8);
    const rhview_mesh mesh = ball.mesh();
    if (const auto status = rhview_chains_build(&mesh, 1, nullptr, &chains); status != RHVIEW_OK)
        return status;
    auto options = sized<rhview_scene_options>();
    options.max_objects = 20;
    options.chains = chains;
    if (const auto status = rhview_scene_create(&options, &scene); status != RHVIEW_OK) return status;
    if (const auto status = rhview_scene_build(scene, nullptr); status != RHVIEW_OK) return status;
    for (std::uint32_t i = 0; i < options.max_objects; ++i) {
        auto object = sized<rhview_object>();
        const float x = 5.0f + 10.0f * static_cast<float>(i);
        object.box = {{x - 1, -1, -1}, {x + 1, 1, 1}};
        object.index_count = static_cast<std::uint32_t>(mesh.index_count);
        object.has_chain = 1;
        std::uint32_t number = 0;
        if (const auto status = rhview_scene_add_object(scene, &object, &number); status != RHVIEW_OK)
            return status;
    }
    if (const auto status = rhview_view_create(scene, nullptr, &view); status != RHVIEW_OK) return status;
    const rhview_camera camera = camera_at(0.0);
    if (const auto status = rhview_view_set_camera(view, &camera); status != RHVIEW_OK) return status;
    auto bounds = sized<rhview_level_bounds>();
    bounds.max_error_px = 2.0;
    if (const auto status = rhview_view_set_levels(view, &bounds); status != RHVIEW_OK) return status;
    return rhview_plan_views(&view, 1, nullptr);
}

TEST(Allocator, serves_levels_of_detail_and_is_not_asked_once_they_are_warm) {
    Memory memory;
    rhview_chains* chains = nullptr;
    rhview_scene* scene = nullptr;
    rhview_view* view = nullptr;
    EXPECT_OK(live_with_levels(chains, scene, view));
    EXPECT_OK(rhview_plan_views(&view, 1, nullptr));
    const std::size_t before = memory.given;
    for (int i = 0; i < 3; ++i) EXPECT_OK(rhview_plan_views(&view, 1, nullptr));
    EXPECT_EQ(memory.given, before);
    const rhview_plan plan = plan_of(view);
    ASSERT_EQ(plan.object_count, 20u);
    EXPECT_NE(plan.objects[0].level, plan.objects[19].level);
    rhview_view_destroy(view);
    rhview_scene_destroy(scene);
    rhview_chains_destroy(chains);
}

TEST(Allocator, that_runs_out_while_levels_are_built_leaks_nothing) {
    std::size_t failed = 0;
    for (std::size_t fails_at = 0;; fails_at += 1 + fails_at / 8) {
        Memory memory;
        memory.fails_at = fails_at;
        rhview_chains* chains = nullptr;
        rhview_scene* scene = nullptr;
        rhview_view* view = nullptr;
        const rhview_status status = live_with_levels(chains, scene, view);
        rhview_view_destroy(view);
        rhview_scene_destroy(scene);
        rhview_chains_destroy(chains);
        if (status == RHVIEW_OK) break;
        EXPECT_EQ(status, RHVIEW_OUT_OF_MEMORY) << "at " << fails_at << ": " << rhview_last_error();
        ++failed;
    }
    EXPECT_GT(failed, 20u);
}

}  // namespace
}  // namespace rhview
