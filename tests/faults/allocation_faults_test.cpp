// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Building, planning, loading and saving with each allocation failing in turn. What may come of it: the whole
// result as if nothing had failed, an error in a sentence, or `std::bad_alloc`; no leak, and nothing broken.
// What reads JSON (glTF, profiles, paths) is not here: nlohmann's values take memory in their destructors,
// and end the process where there is none (docs/security.md). RHVIEW_ALLOCATION_STRIDE=1 in the environment
// tries every single one; the tests by default every few.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <new>

#include "failing_memory.h"
#include "lod/meshes.h"
#include "plan_everything.h"
#include "rhoctree/random_geometry.h"
#include "rhview/base/workers.h"
#include "rhview/lod/baked_lod.h"
#include "rhview/pipeline/rhview_planner.h"
#include "rhview/rhoctree/baked_octree.h"
#include "rhview/scenes/baked_scene.h"
#include "scenes/import_test_files.h"

namespace rhview {
namespace {

/// What a piece of work came to: something to compare, or the error's sentence.
using Outcome = Result<std::uint64_t>;

std::uint64_t stride_of(std::uint64_t usual) {
    const char* text = std::getenv("RHVIEW_ALLOCATION_STRIDE");
    const long value = text == nullptr ? 0 : std::strtol(text, nullptr, 10);
    return value > 0 ? static_cast<std::uint64_t>(value) : usual;
}

/// Does `work` with every `stride`-th allocation failing in turn, until it needs fewer; `after` each. How
/// many failed.
std::uint64_t fail_each(const char* name, std::uint64_t stride, const std::function<Outcome()>& work,
                        const std::function<void()>& after = {}) {
    // Twice: what is made once and kept is made then.
    const Outcome warm = work();
    EXPECT_TRUE(warm.ok()) << warm.error().message;
    const std::uint64_t whole = work().value();
    stride = stride_of(stride);
    std::uint64_t faults = 0, thrown = 0, told = 0;
    for (const Shortage shortage : {Shortage::Once, Shortage::ForGood}) {
        bool failed = true;
        for (std::uint64_t index = 0; failed; index += stride) {
            const std::int64_t before = blocks_in_use();
            std::uint64_t got = whole;
            bool bad_alloc = false, sentence = true;
            {
                fail_allocation(index, shortage);
                try {
                    const Outcome outcome = work();
                    failed = stop_failing();
                    if (outcome) {
                        got = *outcome;
                    } else {
                        ++told;
                        sentence = outcome.error().message.size() > 10;
                    }
                } catch (const std::bad_alloc&) {
                    failed = stop_failing();
                    bad_alloc = true;
                }
            }
            thrown += bad_alloc ? 1 : 0;
            faults += failed ? 1 : 0;
            EXPECT_EQ(blocks_in_use(), before) << name << ": leak at allocation " << index;
            EXPECT_EQ(got, whole) << name << ": another result at allocation " << index;
            EXPECT_TRUE(sentence) << name << ": no sentence at allocation " << index;
            if (after) after();
            if (testing::Test::HasFailure()) return faults;
        }
    }
    EXPECT_EQ(work().value(), whole) << name << ": afterwards";
    std::cout << name << ": " << faults << " allocations failed; " << thrown << " thrown, " << told
              << " told in a sentence\n";
    return faults;
}

OctreeOptions octree_options() {
    OctreeOptions options;
    options.max_leaf_triangles = 16;
    options.replica_budget = 1.0;
    options.costs = {1.0, 300.0, 0.0};
    return options;
}

TEST(AllocationFaults, build_an_octree_whole_or_not_at_all_on_any_threads) {
    const RandomGeometry geometry(1, 3, 120);
    const std::vector<TriangleBatch> batches = geometry.batches();
    const auto build = [&]() -> Outcome {
        const Result<RhOctree> octree = build_octree(batches, octree_options());
        if (!octree) return octree.error();
        std::uint64_t hash = octree->nodes().size();
        for (const std::uint32_t index : octree->indices()) hash = (hash ^ index) * 0x100000001b3ull;
        return hash;
    };
    EXPECT_GT(fail_each("build, one thread", 7, [&] { return run_on(Workers{}, build); }), 500u);
    EXPECT_GT(fail_each("build, two threads", 23, [&] { return run_on(Workers{2}, build); }), 20u);
}

TEST(AllocationFaults, build_levels_of_detail_whole_or_not_at_all) {
    const TestMesh mesh = wavy_sheet(12);
    const auto build = [&]() -> Outcome {
        const LodMesh source = mesh.mesh();
        const Result<std::vector<LodChain>> chains = build_lod_chains({&source, 1}, {});
        if (!chains) return chains.error();
        std::uint64_t hash = chains->at(0).levels.size();
        for (const std::uint32_t index : chains->at(0).indices) hash = (hash ^ index) * 0x100000001b3ull;
        return hash;
    };
    EXPECT_GT(fail_each("levels of detail", 1, [&] { return run_on(Workers{}, build); }), 20u);
}

FrameInput input_at(int frame) {
    const double angle = 0.2 * frame;
    return {.culling_view = {look_along({0, 0, 0}, {std::cos(angle), 0, std::sin(angle)}, {0, 1, 0}),
                             perspective(1.0, 1.5, 0.1, 500.0, ClipDepth::ZeroToOne), ClipDepth::ZeroToOne}};
}

/// Triangles of `octree` in view that the plan neither draws nor hangs on a query. Corners are not shared: a
/// triangle is known by its first index.
std::size_t left_out(const RandomGeometry& geometry, const RhOctree& octree, const FrameInput& input,
                     const FramePlan& plan) {
    std::vector<bool> there(geometry.positions.size());
    const auto mark = [&](const DrawRange& range) {
        for (std::uint32_t k = 0; k < range.index_count; k += 3)
            there.at(octree.indices()[range.first_index + k]) = true;
    };
    std::ranges::for_each(plan.opaque, mark);
    for (const ConditionalRange& conditional : plan.conditional)
        if (conditional.query < plan.queries.size()) mark(conditional.range);
    const View& view = input.culling_view;
    std::vector<DrawRange> to_show;
    append_ranges_to_show(octree, make_frustum(view), make_viewpoint(view), to_show);
    std::size_t missing = 0;
    for (const DrawRange& range : to_show) {
        for (std::uint32_t k = 0; k < range.index_count; k += 3) {
            const std::uint32_t i = octree.indices()[range.first_index + k];
            const glm::dvec3 a(geometry.positions[i]), b(geometry.positions[i + 1]);
            const glm::dvec3 c(geometry.positions[i + 2]);
            const bool faces = glm::dot(glm::cross(b - a, c - a), view.eye() - a) > 0.0;
            missing += faces && !there[i] ? 1 : 0;
        }
    }
    return missing;
}

TEST(AllocationFaults, a_planner_that_ran_out_of_memory_plans_the_next_frames_without_a_gap) {
    const RandomGeometry geometry(2, 3, 300);
    const RhOctree octree = build_octree(geometry.batches(), octree_options()).value();
    OcclusionOptions occlusion;
    occlusion.costs = {{.query_ns = 300.0, .box_ns = 30.0, .pixel_ns = 1e-3, .draw_ns = 80.0},
                       {.query_ns = 10.0, .box_ns = 90.0, .pixel_ns = 1e-3, .draw_ns = 60.0}};
    std::uint64_t faults = 0, queries = 0;
    const std::uint64_t stride = stride_of(1);
    bool failed = true;
    for (std::uint64_t index = 0; failed; index += stride) {
        const std::int64_t before = blocks_in_use();
        {
            std::optional<RhviewPlanner> planner;
            FramePlan plan;
            std::vector<QueryAnswer> answers;
            const auto frame = [&](int number) {
                planner->absorb(answers);
                planner->plan(input_at(number), plan);
                answers.clear();
                for (const PlannedQuery& query : plan.queries)
                    answers.push_back({query.ticket, query.ticket % 3 == 0, 1});
            };
            fail_allocation(index, Shortage::Once);
            int number = 0;
            try {
                planner.emplace(octree, DrawCosts{100.0, 60.0, 0.0}, occlusion);
                for (; number < 6; ++number) frame(number);
            } catch (const std::bad_alloc&) {
            }
            failed = stop_failing();
            faults += failed ? 1 : 0;
            if (!planner) planner.emplace(octree, DrawCosts{100.0, 60.0, 0.0}, occlusion);
            for (int i = 0; i < 6; ++i) {
                frame(number + i);
                queries += plan.queries.size();
                ASSERT_EQ(left_out(geometry, octree, input_at(number + i), plan), 0u)
                    << "after allocation " << index << ", frame " << i;
            }
        }
        ASSERT_EQ(blocks_in_use(), before) << "leak at allocation " << index;
    }
    EXPECT_GT(faults, 50u);
    EXPECT_GT(queries, 100u);
    std::cout << "planning: " << faults << " allocations failed\n";
}

TEST(AllocationFaults, baked_files_are_loaded_whole_or_not_at_all) {
    const TestFolder folder;
    const std::filesystem::path file = folder.path() / "scene.rho";
    const SceneAndPath farm = make_named_scene("farm:instances=3,mesh=1000").value();
    const std::vector<TriangleBatch> batches = farm.scene.triangle_batches();
    const RhOctree octree = build_octree(batches, octree_options()).value();
    const auto save = [&]() -> Outcome {
        Result<RhoWriter> writer = RhoWriter::create(file);
        if (!writer) return writer.error();
        add_scene_sections(*writer, farm, {"farm", "the tests"});
        add_octree_sections(*writer, octree, batches, octree_options());
        return writer->finish();
    };
    ASSERT_TRUE(save().ok());
    const auto load = [&]() -> Outcome {
        const Result<RhoFile> rho = RhoFile::open(file);
        if (!rho) return rho.error();
        const Result<BakedOctree> baked_octree = read_octree_sections(*rho);
        if (!baked_octree) return baked_octree.error();
        const Result<BakedScene> baked_scene = read_scene_sections(*rho);
        if (!baked_scene) return baked_scene.error();
        return baked_octree->octree.indices().size() + baked_scene->scene.scene.index_bytes();
    };
    EXPECT_GT(fail_each("loading a baked file", 1, load), 20u);
    const auto bytes = FileBytes::open(file).value();
    const auto parse = [&]() -> Outcome {
        const Result<RhoFile> rho = RhoFile::parse(FileBytes::copy_of(bytes->bytes()), "copy.rho");
        if (!rho) return rho.error();
        return rho->section({'M', 'E', 'S', 'H'}, 1).ok() ? 2u : 1u;
    };
    EXPECT_GT(fail_each("parsing a copy", 1, parse), 3u);
    // The old file stays readable, and no temporary one stays behind.
    const auto intact = [&] {
        EXPECT_TRUE(load().ok());
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
    };
    EXPECT_GT(fail_each("saving a baked file", 2, save, intact), 20u);
}

TEST(AllocationFaults, scene_files_and_named_scenes_are_loaded_whole_or_not_at_all) {
    const TestFolder folder;
    const auto loads = [&](const char* name, std::uint64_t stride, const auto& load) {
        return fail_each(name, stride, [&]() -> Outcome {
            const Result<Scene> scene = load();
            if (!scene) return scene.error();
            return scene->vertex_bytes() + 3 * scene->index_bytes();
        });
    };
    const auto obj = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 3 4\n");
    EXPECT_GT(loads("OBJ", 1, [&] { return import_scene(obj); }), 20u);
    const auto ply =
        folder.write("a.ply",
                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                     "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                     "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    EXPECT_GT(loads("PLY", 1, [&] { return import_scene(ply); }), 20u);
    EXPECT_GT(loads("soup", 1,
                    [&]() -> Result<Scene> {
                        Result<SceneAndPath> scene = make_named_scene("soup:triangles=1000");
                        if (!scene) return scene.error();
                        return std::move(scene->scene);
                    }),
              20u);
}

}  // namespace
}  // namespace rhview
