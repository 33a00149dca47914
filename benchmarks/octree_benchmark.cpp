// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Building the octree of `town`, loading it baked, and planning its walkthrough, without drawing. Building
// and loading use all cores; they are timed on the wall clock.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "rhview/baselines/octree_leaves.h"
#include "rhview/pipeline/seed_planner.h"
#include "rhview/rhoctree/baked_octree.h"
#include "rhview/scenes/baked_scene.h"
#include "rhview/scenes/named_scene.h"

namespace rhview {
namespace {

const SceneAndPath& town() {
    static const SceneAndPath scene = make_named_scene("town").value();
    return scene;
}

/// The plain octree: leaves in source order.
OctreeOptions plain_options(std::int64_t max_leaf_triangles) {
    OctreeOptions options;
    options.max_leaf_triangles = static_cast<std::uint32_t>(max_leaf_triangles);
    options.normal_order = false;
    return options;
}

/// What the cheapest draw lists are planned with, at the default costs; with replicas of so many percent of
/// the source's index bytes.
OctreeOptions rhview_options(std::int64_t replica_percent) {
    OctreeOptions options =
        choose_octree_options({}, 3 * town().scene.static_triangles(), town().scene.batches.size());
    options.replica_budget = 0.01 * static_cast<double>(replica_percent);
    return options;
}

void build_town(benchmark::State& state, const OctreeOptions& options) {
    const std::vector<TriangleBatch> batches = town().scene.triangle_batches();
    std::size_t nodes = 0;
    for (auto _ : state) nodes = build_octree(batches, options).value().nodes().size();
    state.counters["nodes"] = static_cast<double>(nodes);
    state.counters["Mtri/s"] = benchmark::Counter(
        static_cast<double>(town().scene.static_triangles()) * 1e-6 * static_cast<double>(state.iterations()),
        benchmark::Counter::kIsRate);
}

void build_plain(benchmark::State& state) {
    build_town(state, plain_options(state.range(0)));
}
BENCHMARK(build_plain)->Arg(64)->Arg(512)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

void build_rhview(benchmark::State& state) {
    build_town(state, rhview_options(state.range(0)));
}
BENCHMARK(build_rhview)->Arg(0)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Mapping and checking everything of a baked file, scene and octree, that the page cache holds.
void load_baked(benchmark::State& state) {
    const std::filesystem::path name = std::filesystem::temp_directory_path() / "rhview_octree_benchmark.rho";
    {
        const OctreeOptions options = rhview_options(state.range(0));
        const std::vector<TriangleBatch> batches = town().scene.triangle_batches();
        const RhOctree octree = build_octree(batches, options).value();
        RhoWriter writer = RhoWriter::create(name).value();
        add_scene_sections(writer, town(), {"town", "a benchmark"});
        add_octree_sections(writer, octree, batches, options);
        if (!writer.finish()) state.SkipWithError("no room for a baked file in the temporary folder");
    }
    for (auto _ : state) {
        const RhoFile file = RhoFile::open(name).value();
        benchmark::DoNotOptimize(read_scene_sections(file).value());
        benchmark::DoNotOptimize(read_octree_sections(file).value());
    }
    state.counters["MiB"] = static_cast<double>(std::filesystem::file_size(name)) / (1024.0 * 1024.0);
    std::filesystem::remove(name);
}
BENCHMARK(load_baked)->Arg(0)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();

template <class Planner>
void plan_town(benchmark::State& state) {
    constexpr int kFrames = 120;
    const RhOctree octree =
        build_octree(town().scene.triangle_batches(), plain_options(state.range(0))).value();
    std::vector<FrameInput> inputs;
    for (int i = 0; i < kFrames; ++i)
        inputs.push_back({town().path.view_of_frame(i, kFrames, 16.0 / 9.0, ClipDepth::ReversedZeroToOne),
                          town().scene.origin,
                          {}});
    Planner planner(octree);
    FramePlan plan;
    double visited = 0.0, ranges = 0.0;
    std::size_t frame = 0;
    for (auto _ : state) {
        planner.plan(inputs[frame++ % kFrames], plan);
        visited += static_cast<double>(plan.nodes_visited);
        ranges += static_cast<double>(plan.opaque.size());
    }
    state.counters["nodes/frame"] = benchmark::Counter(visited, benchmark::Counter::kAvgIterations);
    state.counters["draws/frame"] = benchmark::Counter(ranges, benchmark::Counter::kAvgIterations);
    state.counters["nodes/s"] = benchmark::Counter(visited, benchmark::Counter::kIsRate);
}
BENCHMARK_TEMPLATE(plan_town, SeedPlanner)->Arg(64)->Arg(512)->Arg(4096)->Unit(benchmark::kMicrosecond);
BENCHMARK_TEMPLATE(plan_town, OctreeLeaves)->Arg(64)->Arg(512)->Arg(4096)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace rhview

BENCHMARK_MAIN();
