// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// rhview_draw_list [SCENE…]: the draw lists of a walkthrough, counted and priced by the model, and the time that
// planning takes. Nothing is drawn. Writes CSV to standard output.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "rhview/rhoctree/draw_list.h"
#include "rhview/scenes/named_scene.h"

namespace rhview {
namespace {

constexpr int kFrames = 60;
constexpr int kRepeats = 3;

struct Row {
    double draws = 0.0, indices = 0.0, t_ns = 0.0, nodes = 0.0, pieces = 0.0, plan_us = 0.0;
};

double milliseconds(std::chrono::steady_clock::time_point from) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count();
}

struct Walk {
    std::vector<Frustum> frusta;
    std::vector<Viewpoint> viewpoints;

    explicit Walk(const SceneAndPath& scene) {
        for (int i = 0; i < kFrames; ++i) {
            const View view = scene.path.view_of_frame(i, kFrames, 16.0 / 9.0, ClipDepth::ReversedZeroToOne);
            frusta.push_back(make_frustum(view, scene.scene.origin));
            viewpoints.push_back(make_viewpoint(view, scene.scene.origin));
        }
    }
};

template <class Plan>
Row measure(const Walk& walk, const DrawCosts& costs, const Plan& plan) {
    Row row;
    std::vector<DrawRange> ranges;
    std::vector<double> times;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
        for (int i = 0; i < kFrames; ++i) {
            std::uint64_t nodes = 0, pieces = 0;
            const auto start = std::chrono::steady_clock::now();
            const std::vector<DrawRange>& list = plan(walk.frusta[i], walk.viewpoints[i], nodes, pieces);
            times.push_back(1e3 * milliseconds(start));
            if (repeat > 0) continue;
            std::uint64_t indices = 0;
            for (const DrawRange& range : list) indices += range.index_count;
            row.draws += static_cast<double>(list.size()) / kFrames;
            row.indices += static_cast<double>(indices) / kFrames;
            row.nodes += static_cast<double>(nodes) / kFrames;
            row.pieces += static_cast<double>(pieces) / kFrames;
        }
    }
    row.t_ns = costs.index_ns * row.indices + costs.draw_ns * row.draws;
    std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
    row.plan_us = times[times.size() / 2];
    return row;
}

}  // namespace
}  // namespace rhview

using namespace rhview;
int main(int argc, char** argv) {
    const std::string spec = argc > 1 ? argv[1] : "town";
    const SceneAndPath scene = make_named_scene(spec).value();
    const Walk walk(scene);
    const auto batches = scene.scene.triangle_batches();
    const DrawCosts costs{0.25, argc > 2 ? atof(argv[2]) * 0.25 : 2000.0, 0.0};
    for (int a = 3; a < argc; ++a) {
        OctreeOptions o;
        int leaf = 4096, grain = 0; double budget = 0; int per = 0, order = 1;
        sscanf(argv[a], "%d,%d,%lf,%d,%d", &leaf, &grain, &budget, &per, &order);
        o.max_leaf_triangles = leaf; o.min_record_indices = grain; o.replica_budget = budget; o.count_leaf_per_batch = per; o.normal_order = order;
        o.costs = costs;
        const auto t = std::chrono::steady_clock::now();
        const RhOctree octree = build_octree(batches, o).value();
        const double build = milliseconds(t);
        NodeList nodes; std::vector<DrawRange> ranges;
        const Row s = measure(walk, costs, [&](const Frustum& f, const Viewpoint&, std::uint64_t& n, std::uint64_t&) -> const std::vector<DrawRange>& {
            seed_draw_list(octree, f, nodes); ranges.clear(); append_ranges(octree, nodes, ranges); n = nodes.nodes_visited; return ranges; });
        DrawListSolver solver; DrawList list; double replicas = 0, pred = 0;
        const Row r = measure(walk, costs, [&](const Frustum& f, const Viewpoint& v, std::uint64_t& n, std::uint64_t& p) -> const std::vector<DrawRange>& {
            solver.solve(octree, f, v, costs, list); n = list.nodes_visited; p = list.pieces_visited; replicas += list.replicas_drawn; pred += list.predicted_ns; return list.ranges; });
        printf("%s leaf %d grain %d budget %.2f per %d order %d: build %.0f ms nodes %zu pieces %zu clusters %zu replicas %zu bytes %.2f\n", spec.c_str(), leaf, grain, budget, per, order, build, octree.nodes().size(), octree.pieces().size(), octree.clusters().size(), octree.replicas().size(), octree.replica_bytes() / 4.0 / octree.base_index_count());
        printf("   seed  N %8.1f V %9.0f T %8.1f us nodes %.0f plan %.1f us\n", s.draws, s.indices, s.t_ns * 1e-3, s.nodes, s.plan_us);
        printf("   rhv   N %8.1f V %9.0f T %8.1f us (pred %.1f) nodes %.0f pieces %.0f plan %.1f us, replicas drawn %.1f  ratio %.3f\n", r.draws, r.indices, r.t_ns * 1e-3, pred / kFrames / kRepeats * 1e-3, r.nodes, r.pieces, r.plan_us, replicas / kFrames / kRepeats, r.t_ns / s.t_ns);
        fflush(stdout);
    }
}
