// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// An engine that learns what drawing costs at its first start, with its own renderer and its own triangles,
// saves it, and knows it from then on. The renderer is that of engine_loop.

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "renderer.h"
#include "rhview/gl/context.h"
#include "rhview/pipeline/rhview_planner.h"
#include "rhview/timing_model/fit.h"
#include "rhview/timing_model/profile.h"
#include "world.h"

namespace {

using engine::Renderer;
using engine::Target;

constexpr int kRounds = 5;

/// High above the world: its triangles are small, so that what is timed is indices and draw calls.
rhview::View view_of_calibration() {
    rhview::View view;
    view.clip_depth = rhview::ClipDepth::ReversedZeroToOne;
    view.camera_from_world = rhview::look_along({0, 3000, 0}, {0, -1, 0}, {0, 0, -1});
    view.clip_from_camera = rhview::perspective(1.0, 16.0 / 9.0, 1.0, 5000.0, view.clip_depth);
    return view;
}

/// Of a frame from an idle device until it is idle again.
double time_frame_ns(Renderer& renderer, const std::vector<rhview::DrawRange>& ranges) {
    glFinish();
    const auto start = std::chrono::steady_clock::now();
    renderer.begin(Target::Picture, view_of_calibration());
    for (const rhview::DrawRange& range : ranges) renderer.draw(range);
    glFinish();
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

/// Draws `draw_calls` parts of the walls and the furniture, `indices` together.
std::vector<rhview::DrawRange> frame_of(std::span<const rhview::DrawRange> batches, std::uint32_t draw_calls,
                                        std::uint32_t indices) {
    std::vector<rhview::DrawRange> ranges;
    const rhview::DrawRange& whole = batches.back();
    const std::uint32_t count = std::max(indices / draw_calls / 3, 1u) * 3;
    for (std::uint32_t i = 0; i < draw_calls; ++i) {
        const std::uint32_t places = (whole.index_count - count) / 3;
        const std::uint32_t place = static_cast<std::uint32_t>(std::uint64_t{i} * places / draw_calls);
        ranges.push_back({whole.batch, whole.first_index + 3 * place, count});
    }
    return ranges;
}

/// Indices and draw calls vary independently of each other: only then can a fit tell their prices apart.
/// Frames are timed in rounds, each in another order, and the median counts: what else the machine does
/// disturbs some of them.
std::vector<rhview::Sample> measure(Renderer& renderer, std::span<const rhview::DrawRange> batches) {
    std::vector<rhview::Sample> samples;
    std::vector<std::vector<rhview::DrawRange>> frames;
    for (const std::uint32_t draw_calls : {1u, 100u, 300u, 1000u, 2000u, 4000u})
        for (const std::uint32_t indices : {12'000u, 100'000u, 300'000u, 700'000u, 1'200'000u}) {
            frames.push_back(frame_of(batches, draw_calls, indices));
            rhview::Sample& sample = samples.emplace_back();
            sample.work.draw_calls = sample.work.sub_draws = draw_calls;
            for (const rhview::DrawRange& range : frames.back()) sample.work.indices += range.index_count;
        }
    std::vector<std::size_t> order(frames.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::vector<std::vector<double>> times(frames.size());
    std::mt19937 random(1);
    time_frame_ns(renderer, frames[0]);  // the first frame compiles shaders
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
        for (const std::size_t i : order) times[i].push_back(time_frame_ns(renderer, frames[i]));
    }
    for (std::size_t i = 0; i < samples.size(); ++i) {
        std::ranges::nth_element(times[i], times[i].begin() + kRounds / 2);
        samples[i].measured_ns = times[i][kRounds / 2];
    }
    // Neighbours in the design are not neighbours in the cross-validation.
    for (std::size_t i = samples.size(); i > 1; --i) std::swap(samples[i - 1], samples[random() % i]);
    return samples;
}

rhview::Result<rhview::TimingProfile> calibrate(Renderer& renderer,
                                                std::span<const rhview::DrawRange> batches,
                                                const rhview::gl::DeviceInfo& device) {
    const std::vector<rhview::Sample> samples = measure(renderer, batches);
    const std::vector<rhview::Term> terms{rhview::Term::Constant, rhview::Term::Indices,
                                          rhview::Term::DrawCalls};
    const rhview::Result<rhview::Fit> fit = rhview::fit_terms(samples, terms);
    if (!fit) return fit.error();
    rhview::TimingProfile profile = rhview::make_profile(*fit);
    profile.renderer = device.renderer;
    profile.version = device.version;
    profile.timer_name = "wall";
    profile.timer_why = "it is what a frame takes";
    return profile;
}

/// What was saved, if it is of this device and driver; a new one otherwise, which is then saved.
rhview::Result<rhview::TimingProfile> load_or_calibrate(const std::string& file, Renderer& renderer,
                                                        std::span<const rhview::DrawRange> batches,
                                                        const rhview::gl::DeviceInfo& device) {
    rhview::Result<rhview::TimingProfile> saved = rhview::load_profile(file);
    if (saved && saved->renderer == device.renderer && saved->version == device.version) {
        std::printf("reused %s\n", file.c_str());
        return saved;
    }
    rhview::Result<rhview::TimingProfile> measured = calibrate(renderer, batches, device);
    if (!measured) return measured;
    if (const rhview::Status status = rhview::save_profile(*measured, file); !status) return status.error();
    std::printf("measured, and saved %s\n", file.c_str());
    return measured;
}

/// From the ground, where the prices decide what is drawn.
rhview::View view_of_player() {
    rhview::View view;
    view.clip_depth = rhview::ClipDepth::ReversedZeroToOne;
    view.camera_from_world = rhview::look_along({0, 1.7, 200}, {0, 0, -1}, {0, 1, 0});
    view.clip_from_camera = rhview::perspective(1.0, 16.0 / 9.0, 0.1, 2000.0, view.clip_depth);
    return view;
}

std::vector<glm::vec3> positions_of(const auto& vertices) {
    std::vector<glm::vec3> positions;
    for (const auto& vertex : vertices) positions.push_back(vertex.position);
    return positions;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string file = argc > 1 ? argv[1] : "engine.profile.json";
    const auto context = rhview::gl::Context::create_headless();
    if (!context) return std::puts(context.error().message.c_str()), 1;
    if (!context->device().clip_control) return std::puts("skipped: reversed depth needs OpenGL 4.5"), 77;

    const engine::World world = engine::make_world();
    const std::vector<glm::vec3> ground = positions_of(world.ground.vertices),
                                 walls = positions_of(world.walls.vertices),
                                 furniture = positions_of(world.furniture.vertices);
    const std::vector<rhview::TriangleBatch> batches{
        {rhview::MaterialId{0}, ground, world.ground.indices},
        {rhview::MaterialId{1}, walls, world.walls.indices},
        {rhview::MaterialId{2}, furniture, world.furniture.indices}};
    std::vector<std::uint32_t> indices;
    std::vector<rhview::DrawRange> ranges;
    for (std::uint32_t b = 0; b < batches.size(); ++b) {
        ranges.push_back({rhview::BatchId{b}, static_cast<std::uint32_t>(indices.size()),
                          static_cast<std::uint32_t>(batches[b].indices.size())});
        indices.insert(indices.end(), batches[b].indices.begin(), batches[b].indices.end());
    }

    // [snippet]
    // Before the octree is built: the prices decide how fine it is.
    rhview::Result<rhview::TimingProfile> profile = [&] {
        Renderer renderer(world, indices);
        return load_or_calibrate(file, renderer, ranges, context->device());
    }();
    if (!profile) return std::puts(profile.error().message.c_str()), 1;
    const rhview::DrawCosts costs{.index_ns = profile->c1_ns, .draw_ns = profile->c3_ns};
    const auto octree =
        rhview::build_octree(batches, rhview::choose_octree_options(costs, indices.size(), batches.size()));
    // [/snippet]
    if (!octree) return std::puts(octree.error().message.c_str()), 1;

    rhview::RhviewPlanner planner(*octree, costs);
    rhview::FramePlan plan;
    planner.plan({.culling_view = view_of_player()}, plan);
    rhview::Work work;
    work.draw_calls = static_cast<double>(plan.opaque.size());
    for (const rhview::DrawRange& range : plan.opaque) work.indices += range.index_count;
    std::printf("c0 %.0f ns a frame, c1 %.3f ns an index, c3 %.1f ns a draw call\n", profile->c0_ns,
                profile->c1_ns, profile->c3_ns);
    std::printf("a frame: %.0f draw calls, %.0f of %zu indices, predicted %.2f ms\n", work.draw_calls,
                work.indices, indices.size(), 1e-6 * profile->predict_ns(work));
    return profile->c1_ns > 0.0 && work.indices > 0.0 && work.indices < static_cast<double>(indices.size())
               ? 0
               : 1;
}
