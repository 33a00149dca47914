// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// rhview_planning PROFILE [SCENE…]: the time that `rhview` takes to plan frames, queries included, on one
// core. A walk is drawn once, to have the device's answers; then it is planned again and again with these
// answers, without drawing. CSV to standard output; all but the times repeats exactly.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "rhview/gl/context.h"
#include "rhview/gl/executor.h"
#include "rhview/gl/render_target.h"
#include "rhview/pipeline/rhview_planner.h"
#include "rhview/scenes/named_scene.h"
#include "rhview/timing_model/profile.h"

namespace rhview {
namespace {

constexpr int kFrames = 120;
constexpr int kRepeats = 7;
constexpr int kWidth = 1280, kHeight = 720;

/// What a walk was planned from: equal inputs give equal plans.
struct RecordedFrame {
    FrameInput input;
    std::vector<QueryAnswer> answers;  ///< absorbed before it
    double median_us = 0.0;
};

struct Totals {
    double queries = 0.0, candidates = 0.0, draws = 0.0, nodes = 0.0;
};

Status record(RhviewPlanner& planner, const SceneAndPath& scene, const RhOctree& octree,
              std::vector<RecordedFrame>& frames, Totals& totals) {
    Result<gl::RenderTarget> target = gl::RenderTarget::create(kWidth, kHeight);
    if (!target) return target.error();
    Result<gl::Executor> executor = gl::Executor::create();
    if (!executor) return executor.error();
    const Result<gl::SceneBuffers> buffers = gl::SceneBuffers::upload(scene.scene, octree.indices());
    if (!buffers) return buffers.error();
    FramePlan plan;
    std::vector<QueryAnswer> answers;
    for (int i = 0; i < kFrames; ++i) {
        const View view = scene.path.view_of_frame(i, kFrames, static_cast<double>(kWidth) / kHeight,
                                                   ClipDepth::NegativeOneToOne);
        const FrameInput input{view, scene.scene.origin, {}, {kWidth, kHeight}};
        frames.push_back({input, answers});
        planner.absorb(answers);
        planner.plan(input, plan);
        totals.queries += static_cast<double>(plan.queries.size()) / kFrames;
        totals.candidates += plan.occlusion ? static_cast<double>(plan.occlusion->candidates) / kFrames : 0.0;
        totals.draws += static_cast<double>(plan.opaque.size()) / kFrames;
        totals.nodes += static_cast<double>(plan.nodes_visited) / kFrames;
        target->begin(ClipDepth::NegativeOneToOne, glm::vec3(0.0f));
        executor->draw(plan, *buffers, view);
        answers.clear();
        executor->wait_for_answers(answers);
    }
    return success();
}

double percentile(std::vector<double> values, std::size_t percent) {
    std::ranges::sort(values);
    return values[(values.size() - 1) * percent / 100];
}

Status run_scene(const std::string& name, const TimingProfile& profile) {
    const Result<SceneAndPath> scene = make_named_scene(name);
    if (!scene) return scene.error();
    const DrawCosts costs{profile.c1_ns, profile.c3_ns + profile.sub_draw_ns.value_or(0.0), 0.0};
    const std::vector<TriangleBatch> batches = scene->scene.triangle_batches();
    const Result<RhOctree> octree = build_octree(
        batches, choose_octree_options(costs, 3 * scene->scene.batch_triangles(), batches.size()));
    if (!octree) return octree.error();
    OcclusionOptions occlusion;
    if (profile.answer_costs) occlusion.costs = *profile.answer_costs;
    occlusion.shown_index_ns = profile.c1_ns + profile.primitive_ns.value_or(0.0) / 3.0;

    std::vector<RecordedFrame> frames;
    Totals totals;
    RhviewPlanner first(*octree, costs, occlusion);
    if (Status status = record(first, *scene, *octree, frames, totals); !status) return status;
    std::vector<std::vector<double>> times(frames.size());
    FramePlan plan;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
        RhviewPlanner planner(*octree, costs, occlusion);
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const auto start = std::chrono::steady_clock::now();
            planner.absorb(frames[i].answers);
            planner.plan(frames[i].input, plan);
            times[i].push_back(
                std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
        }
    }
    std::vector<double> medians;
    for (const std::vector<double>& of_frame : times) medians.push_back(percentile(of_frame, 50));
    std::printf("%s,%zu,%.0f,%.0f,%.0f,%.0f,%.1f,%.1f\n", name.c_str(), octree->nodes().size(), totals.nodes,
                totals.candidates, totals.queries, totals.draws, percentile(medians, 50),
                percentile(medians, 95));
    std::fflush(stdout);
    return success();
}

int run(const std::vector<std::string>& arguments) {
    const Result<TimingProfile> profile = load_profile(arguments[0]);
    const Result<gl::Context> context = gl::Context::create_headless();
    if (!profile || !context) {
        std::fprintf(stderr, "%s\n", (!profile ? profile.error() : context.error()).message.c_str());
        return 2;
    }
    std::puts("scene,nodes,nodes_visited,candidates,queries,draws,plan_us_median,plan_us_p95");
    std::vector<std::string> scenes(arguments.begin() + 1, arguments.end());
    if (scenes.empty()) scenes = {"town", "indoor", "plant"};
    for (const std::string& scene : scenes)
        if (const Status status = run_scene(scene, *profile); !status) {
            std::fprintf(stderr, "%s\n", status.error().message.c_str());
            return 2;
        }
    return 0;
}

}  // namespace
}  // namespace rhview

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fputs("usage: rhview_planning PROFILE [SCENE…]\n", stderr);
        return 2;
    }
    return rhview::run(std::vector<std::string>(argv + 1, argv + argc));
}
