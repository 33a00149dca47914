// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Building the octree of `town`, and planning its walkthrough, on one core and without drawing.

#include <benchmark/benchmark.h>

#include "rhview/baselines/octree_leaves.h"
#include "rhview/pipeline/seed_planner.h"
#include "rhview/scenes/named_scene.h"

namespace rhview {
namespace {

const SceneAndPath& town() {
    static const SceneAndPath scene = make_named_scene("town").value();
    return scene;
}

void build_town(benchmark::State& state) {
    const std::vector<TriangleBatch> batches = town().scene.triangle_batches();
    std::size_t nodes = 0;
    for (auto _ : state) {
        const RhOctree octree = build_octree(batches, {static_cast<std::uint32_t>(state.range(0))}).value();
        nodes = octree.nodes().size();
    }
    state.counters["nodes"] = static_cast<double>(nodes);
    state.counters["Mtri/s"] = benchmark::Counter(
        static_cast<double>(town().scene.static_triangles()) * 1e-6 * static_cast<double>(state.iterations()),
        benchmark::Counter::kIsRate);
}
BENCHMARK(build_town)->Arg(64)->Arg(512)->Arg(4096)->Unit(benchmark::kMillisecond);

template <class Planner>
void plan_town(benchmark::State& state) {
    constexpr int kFrames = 120;
    const RhOctree octree =
        build_octree(town().scene.triangle_batches(), {static_cast<std::uint32_t>(state.range(0))}).value();
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
