// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// rhview_draw_list [SCENE…]: the draw lists of a scene's walkthrough, counted and priced by the model, and
// the time that planning takes on one core. Nothing is drawn. CSV to standard output; all but the times
// repeats exactly.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "rhview/rhoctree/draw_list.h"
#include "rhview/scenes/named_scene.h"

namespace rhview {
namespace {

constexpr int kFrames = 60;
constexpr int kRepeats = 5;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

struct Frame {
    Frustum frustum;
    Viewpoint viewpoint;
};

struct Counts {
    std::uint64_t nodes_visited = 0;
    std::uint64_t pieces_visited = 0;
    std::uint64_t replicas_drawn = 0;
};

/// Appends a frame's ranges.
using Plan = std::function<void(const Frame&, std::vector<DrawRange>&, Counts&)>;

struct Setting {
    std::string scene;
    std::string method;
    std::string leaf;  ///< as asked for
    DrawCosts costs;
    OctreeOptions options;
};

void measure(const Setting& setting, const std::vector<Frame>& frames, const RhOctree& octree,
             double build_ms, const Plan& plan) {
    std::vector<DrawRange> ranges;
    std::vector<double> times_us;
    std::vector<std::size_t> draws;
    std::uint64_t indices = 0, batches = 0;
    Counts counts;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
        for (const Frame& frame : frames) {
            Counts of_frame;
            ranges.clear();
            const auto start = std::chrono::steady_clock::now();
            plan(frame, ranges, of_frame);
            times_us.push_back(1e3 * milliseconds_since(start));
            if (repeat > 0) continue;
            counts.nodes_visited += of_frame.nodes_visited;
            counts.pieces_visited += of_frame.pieces_visited;
            counts.replicas_drawn += of_frame.replicas_drawn;
            draws.push_back(ranges.size());
            std::vector<bool> seen(octree.batch_count(), false);
            for (const DrawRange& range : ranges) {
                indices += range.index_count;
                batches += !seen[index_of(range.batch)];
                seen[index_of(range.batch)] = true;
            }
        }
    }
    std::size_t draw_sum = 0;
    for (const std::size_t count : draws) draw_sum += count;
    std::ranges::sort(times_us);
    std::ranges::sort(draws);
    const auto mean = [&](auto sum) { return static_cast<double>(sum) / static_cast<double>(frames.size()); };
    const double t_us =
        1e-3 * (setting.costs.index_ns * mean(indices) + setting.costs.draw_ns * mean(draw_sum));
    std::printf(
        "%s,%s,%g,%g,%s,%u,%u,%.0f,%zu,%zu,%zu,%zu,%.3f,%.2f,%zu,%.2f,%.0f,%.2f,%.0f,%.0f,%.1f,%.1f,%.1f\n",
        setting.scene.c_str(), setting.method.c_str(), setting.costs.index_ns, setting.costs.draw_ns,
        setting.leaf.c_str(), setting.options.max_leaf_triangles, setting.options.min_record_indices,
        build_ms, octree.nodes().size(), octree.pieces().size(), octree.clusters().size(),
        octree.replicas().size(),
        static_cast<double>(octree.indices().size() - octree.base_index_count()) /
            static_cast<double>(octree.base_index_count()),
        mean(draw_sum), draws.back(), mean(batches), mean(indices), t_us, mean(counts.nodes_visited),
        mean(counts.pieces_visited), mean(counts.replicas_drawn), times_us[times_us.size() / 2],
        times_us[times_us.size() * 95 / 100]);
    std::fflush(stdout);
}

void run(const Setting& setting, std::span<const TriangleBatch> batches, const std::vector<Frame>& frames) {
    const auto start = std::chrono::steady_clock::now();
    const Result<RhOctree> built = build_octree(batches, setting.options);
    if (!built) {
        std::fprintf(stderr, "%s\n", built.error().message.c_str());
        return;
    }
    const double build_ms = milliseconds_since(start);
    const RhOctree& octree = *built;
    NodeList nodes;
    DrawListSolver solver;
    DrawList list;
    Plan plan;
    if (setting.method == "rhview")
        plan = [&](const Frame& frame, std::vector<DrawRange>& ranges, Counts& counts) {
            solver.solve(octree, frame.frustum, frame.viewpoint, setting.costs, list);
            ranges = list.ranges;
            counts = {list.nodes_visited, list.pieces_visited, list.replicas_drawn};
        };
    else
        plan = [&](const Frame& frame, std::vector<DrawRange>& ranges, Counts& counts) {
            seed_draw_list(octree, frame.frustum, nodes);
            append_ranges(octree, nodes, ranges);
            counts.nodes_visited = nodes.nodes_visited;
        };
    measure(setting, frames, octree, build_ms, plan);
}

void run_scene(const std::string& name) {
    const Result<SceneAndPath> loaded = make_named_scene(name);
    if (!loaded) {
        std::fprintf(stderr, "%s\n", loaded.error().message.c_str());
        return;
    }
    const std::vector<TriangleBatch> batches = loaded->scene.triangle_batches();
    std::vector<Frame> frames;
    for (int i = 0; i < kFrames; ++i) {
        const View view = loaded->path.view_of_frame(i, kFrames, 16.0 / 9.0, ClipDepth::ReversedZeroToOne);
        frames.push_back(
            {make_frustum(view, loaded->scene.origin), make_viewpoint(view, loaded->scene.origin)});
    }
    for (const double ratio : {10.0, 1000.0, 8000.0, 50000.0}) {
        const DrawCosts costs{0.25, 0.25 * ratio, 0.0};
        const OctreeOptions chosen =
            choose_octree_options(costs, 3 * loaded->scene.static_triangles(), batches.size());
        for (const std::uint32_t leaf : {512u, 4096u}) {
            OctreeOptions seed;
            seed.max_leaf_triangles = leaf;
            seed.normal_order = false;
            run({name, "rhview-seed", std::to_string(leaf), costs, seed}, batches, frames);
        }
        run({name, "rhview", "chosen", costs, chosen}, batches, frames);
        OctreeOptions bare = chosen;
        bare.replica_budget = 0.0;
        run({name, "rhview", "chosen without replicas", costs, bare}, batches, frames);
        for (std::uint32_t leaf = 256; leaf <= 16384; leaf *= 4) {
            OctreeOptions options = chosen;
            options.max_leaf_triangles = leaf;
            run({name, "rhview", std::to_string(leaf), costs, options}, batches, frames);
        }
    }
}

}  // namespace
}  // namespace rhview

int main(int argc, char** argv) {
    std::puts(
        "scene,method,c1_ns,c3_ns,leaf,max_leaf_triangles,min_record_indices,build_ms,nodes,pieces,clusters,"
        "replicas,"
        "replica_share,draws_mean,draws_max,batches_mean,indices_mean,modelled_us,nodes_visited,pieces_"
        "visited,"
        "replicas_drawn,plan_us_median,plan_us_p95");
    std::vector<std::string> scenes(argv + 1, argv + argc);
    if (scenes.empty()) scenes = {"town", "town:materials=84"};
    for (const std::string& scene : scenes) rhview::run_scene(scene);
    return 0;
}
