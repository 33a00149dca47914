// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// Records a player's walk through a town as a camera path, then walks it with two culling methods in turns,
// frame by frame, and compares what they drew and how long it took. It checks itself: either must have the
// depths of drawing everything.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "rhview/baselines/draw_everything.h"
#include "rhview/baselines/octree_leaves.h"
#include "rhview/gl/context.h"
#include "rhview/gl/executor.h"
#include "rhview/gl/render_target.h"
#include "rhview/gl/timer.h"
#include "rhview/pipeline/rhview_planner.h"
#include "rhview/scenes/named_scene.h"

namespace {

constexpr int kWidth = 640, kHeight = 360, kFrames = 96;
constexpr double kStep_s = 1.0 / 64.0;

/// The game's player, who walks ahead and looks around; in a game, mouse and keys would steer.
class Player {
  public:
    explicit Player(const rhview::CameraKey& start) : eye_(start.eye) {
        const glm::dvec3 ahead = start.target - start.eye;
        heading_ = std::atan2(ahead.x, -ahead.z);
    }

    void step(int frame) {
        heading_ += 0.02 * std::sin(0.1 * frame);
        eye_ += 0.4 * glm::dvec3(std::sin(heading_), 0.0, -std::cos(heading_));
    }
    [[nodiscard]] rhview::CameraKey key(double time_s) const {
        return {time_s, eye_, eye_ + glm::dvec3(std::sin(heading_), -0.05, -std::cos(heading_))};
    }

  private:
    glm::dvec3 eye_;
    double heading_ = 0.0;
};

/// A key a frame, 64ths of a second apart: `view_of_frame` gives exactly what the player saw.
rhview::Status record(const rhview::CameraPath& lens, const std::string& file) {
    rhview::CameraPath path = lens;
    Player player(lens.keys.front());
    path.keys.clear();
    for (int frame = 0; frame < kFrames; ++frame) {
        path.keys.push_back(player.key(kStep_s * frame));
        player.step(frame);
    }
    if (rhview::Status status = validate(path); !status) return status;
    std::ofstream out(file, std::ios::binary);
    out << rhview::to_json(path);
    out.close();
    return out ? rhview::success() : rhview::Error{file + ": can't be written"};
}

/// A method with its own octree, and its order of the indices on the device.
struct Method {
    const char* name;
    rhview::RhOctree octree;
    rhview::gl::SceneBuffers buffers;
    std::unique_ptr<rhview::FramePlanner> planner;
    double draw_calls = 0.0, indices = 0.0;
    std::vector<double> frame_ms;
    std::size_t missing = 0;
};

rhview::Result<std::unique_ptr<Method>> make_method(const char* name, const rhview::Scene& scene,
                                                    const rhview::OctreeOptions& options) {
    rhview::Result<rhview::RhOctree> octree = rhview::build_octree(scene.triangle_batches(), options);
    if (!octree) return octree.error();
    rhview::Result<rhview::gl::SceneBuffers> buffers =
        rhview::gl::SceneBuffers::upload(scene, octree->indices());
    if (!buffers) return buffers.error();
    return std::unique_ptr<Method>(
        new Method{name, std::move(octree).value(), std::move(buffers).value(), {}, 0.0, 0.0, {}, 0});
}

struct Stage {
    rhview::gl::Executor executor;
    rhview::gl::RenderTarget target;
    std::vector<float> depths;

    double draw(const rhview::FramePlan& plan, const rhview::gl::SceneBuffers& buffers,
                const rhview::View& view, const rhview::gl::WallTimer& timer) {
        target.begin(view.clip_depth, {0.7f, 0.8f, 0.9f});
        executor.draw(plan, buffers, view);
        rhview::gl::finish();
        const double ms = timer.elapsed_ms();
        target.read_depth(depths);
        return ms;
    }
};

void walk(Method& method, const rhview::Scene& scene, const rhview::View& view, Stage& stage,
          std::span<const float> reference) {
    rhview::FramePlan plan;
    const rhview::gl::WallTimer timer;
    method.planner->plan(
        {.culling_view = view, .scene_origin = scene.origin, .viewport_pixels = {kWidth, kHeight}}, plan);
    method.frame_ms.push_back(stage.draw(plan, method.buffers, view, timer));
    method.missing += rhview::gl::count_missing_pixels(stage.depths, reference);
    method.draw_calls += static_cast<double>(plan.opaque.size()) / kFrames;
    for (const rhview::DrawRange& range : plan.opaque)
        method.indices += static_cast<double>(range.index_count) / kFrames;
}

constexpr rhview::DrawCosts kCosts{.index_ns = 3, .draw_ns = 500};

/// Of a frame, by the prices that rhview plans with.
double model_ms(const Method& method) {
    return 1e-6 * (kCosts.index_ns * method.indices + kCosts.draw_ns * method.draw_calls);
}

void print(Method& method) {
    std::ranges::sort(method.frame_ms);
    std::printf("%-14s %12.1f %12.0f %12.3f %12.2f %14zu\n", method.name, method.draw_calls, method.indices,
                model_ms(method), method.frame_ms[method.frame_ms.size() / 2], method.missing);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string file = argc > 1 ? argv[1] : "walkthrough.path.json";
    const auto context = rhview::gl::Context::create_headless();
    if (!context) return std::puts(context.error().message.c_str()), 1;
    const rhview::ClipDepth clip_depth = context->device().clip_control ? rhview::ClipDepth::ReversedZeroToOne
                                                                        : rhview::ClipDepth::NegativeOneToOne;
    const auto loaded = rhview::make_named_scene("town:size=128");
    if (!loaded) return std::puts(loaded.error().message.c_str()), 1;
    const rhview::Scene& scene = loaded->scene;

    if (const auto status = record(loaded->path, file); !status)
        return std::puts(status.error().message.c_str()), 1;
    const auto path = rhview::load_camera_path(file);
    if (!path) return std::puts(path.error().message.c_str()), 1;

    std::uint64_t index_count = 3 * scene.batch_triangles();
    rhview::OctreeOptions plain;
    plain.normal_order = false;
    auto leaves = make_method("octree leaves", scene, plain);
    auto rhview = make_method("rhview", scene,
                              rhview::choose_octree_options(kCosts, index_count, scene.batches.size()));
    if (!leaves || !rhview) return std::puts((leaves ? rhview : leaves).error().message.c_str()), 1;
    (*leaves)->planner = std::make_unique<rhview::OctreeLeaves>((*leaves)->octree);
    (*rhview)->planner = std::make_unique<rhview::RhviewPlanner>((*rhview)->octree, kCosts);

    auto executor = rhview::gl::Executor::create();
    auto target = rhview::gl::RenderTarget::create(kWidth, kHeight);
    if (!executor || !target)
        return std::puts((executor ? target.error() : executor.error()).message.c_str()), 1;
    Stage stage{std::move(executor).value(), std::move(target).value(), {}};
    std::vector<std::uint32_t> counts;
    for (const rhview::SceneBatch& batch : scene.batches)
        counts.push_back(static_cast<std::uint32_t>(batch.indices.size()));
    rhview::DrawEverything everything(counts, scene.bounds());
    rhview::FramePlan whole;
    for (int frame = 0; frame < kFrames; ++frame) {
        const rhview::View view =
            path->view_of_frame(frame, kFrames, static_cast<double>(kWidth) / kHeight, clip_depth);
        everything.plan({.culling_view = view}, whole);
        stage.draw(whole, (*leaves)->buffers, view, {});
        const std::vector<float> reference = stage.depths;
        // In turns: what else the machine does hits both alike.
        const std::array order{frame % 2 == 0 ? leaves->get() : rhview->get(),
                               frame % 2 == 0 ? rhview->get() : leaves->get()};
        for (Method* method : order) walk(*method, scene, view, stage, reference);
    }
    std::printf("recorded %s; %d frames of %s, %llu triangles\n", file.c_str(), kFrames, scene.name.c_str(),
                static_cast<unsigned long long>(scene.static_triangles()));
    std::printf("%-14s %12s %12s %12s %12s %14s\n", "method", "draw calls", "indices", "model ms",
                "median ms", "missing pixels");
    print(**leaves);
    print(**rhview);
    const bool cheaper = model_ms(**rhview) < model_ms(**leaves);
    return (*leaves)->missing + (*rhview)->missing == 0 && cheaper ? 0 : 1;
}
