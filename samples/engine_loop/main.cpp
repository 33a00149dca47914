// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// An engine that draws with its own renderer, its own vertex formats and materials, into two views: the
// camera's picture, with occlusion queries, and a shadow map. It checks itself: each view must have the
// depths of drawing everything.

#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "renderer.h"
#include "rhview/gl/context.h"
#include "rhview/pipeline/rhview_planner.h"
#include "world.h"

namespace {

using engine::Renderer;
using engine::Target;

constexpr int kFrames = 60;

template <class Vertex>
std::vector<glm::vec3> positions_of(const std::vector<Vertex>& vertices) {
    std::vector<glm::vec3> positions;
    for (const Vertex& vertex : vertices) positions.push_back(vertex.position);
    return positions;
}

/// What drawing and asking cost, ns. These are guesses; `rhview calibrate` measures them.
rhview::OcclusionOptions occlusion_options() {
    rhview::OcclusionOptions options;
    options.costs.hardware = {.query_ns = 4000, .box_ns = 300, .pixel_ns = 0.1, .draw_ns = 500};
    // This renderer has no box pass.
    options.costs.box_pass = {.query_ns = std::numeric_limits<double>::infinity()};
    return options;
}

rhview::View camera_of(int frame) {
    const double way = static_cast<double>(frame) / kFrames;
    rhview::View view;
    view.clip_depth = rhview::ClipDepth::ReversedZeroToOne;
    view.camera_from_world =
        rhview::look_along({0.0, 1.7, 200.0 - 60.0 * way}, {std::sin(2.0 * way), 0.0, -1.0}, {0, 1, 0});
    view.clip_from_camera = rhview::perspective(
        1.0, static_cast<double>(Renderer::kWidth) / Renderer::kHeight, 0.1, 2000.0, view.clip_depth);
    return view;
}

/// Of a sun high in the south, over what is near the camera.
rhview::View sun_of(const rhview::View& camera) {
    rhview::View view;
    view.clip_depth = camera.clip_depth;
    view.camera_from_world =
        rhview::look_along(camera.eye() + glm::dvec3(100, 200, 50), {-1, -2, -0.5}, {0, 1, 0});
    view.clip_from_camera = rhview::orthographic(120.0, 120.0, 1.0, 500.0, view.clip_depth);
    return view;
}

// [snippet]
/// What is drawn at once, then the questions against that depth, then what hangs on their answers.
void execute(const rhview::FramePlan& plan, Renderer& renderer) {
    for (const rhview::DrawRange& range : plan.opaque) renderer.draw(range);
    for (const rhview::PlannedQuery& query : plan.queries)
        renderer.ask(query.ticket, std::span(plan.query_boxes).subspan(query.first_box, query.box_count));
    for (const rhview::ConditionalRange& conditional : plan.conditional)
        renderer.draw_if_seen(plan.queries[conditional.query].ticket, conditional.range);
}
// [/snippet]

/// Pixels that differ from drawing every batch whole.
std::size_t missing_pixels(Renderer& renderer, Target target, const rhview::View& view,
                           const rhview::RhOctree& octree) {
    const std::vector<float> culled = renderer.read_depths();
    renderer.begin(target, view);
    for (const rhview::DrawRange& batch : octree.ranges(rhview::NodeId{0})) renderer.draw(batch);
    const std::vector<float> everything = renderer.read_depths();
    std::size_t missing = 0;
    for (std::size_t i = 0; i < culled.size(); ++i) missing += culled[i] != everything[i];
    return missing;
}

struct Totals {
    std::size_t camera_draws = 0, shadow_draws = 0, queries = 0, conditional = 0, missing = 0;
};

void print(const Totals& totals) {
    const auto per_frame = [](std::size_t sum) { return static_cast<double>(sum) / kFrames; };
    std::printf("camera: %.1f draws at once, %.1f that hang on %.1f queries, a frame\n",
                per_frame(totals.camera_draws), per_frame(totals.conditional), per_frame(totals.queries));
    std::printf("shadow map: %.1f draws a frame\n", per_frame(totals.shadow_draws));
    std::printf("%zu missing pixels in %d frames of both views\n", totals.missing, kFrames);
}

}  // namespace

int main() {
    // The engine's own context, in an engine; here one without a window.
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
    std::size_t index_count = 0;
    for (const rhview::TriangleBatch& batch : batches) index_count += batch.indices.size();

    const rhview::DrawCosts costs{.index_ns = 3, .draw_ns = 500};
    const auto octree =
        rhview::build_octree(batches, rhview::choose_octree_options(costs, index_count, batches.size()));
    if (!octree) return std::puts(octree.error().message.c_str()), 1;
    Renderer renderer(world, octree->indices());

    // One planner a view; the octree is shared.
    rhview::RhviewPlanner camera_planner(*octree, costs, occlusion_options());
    rhview::RhviewPlanner shadow_planner(*octree, costs);
    rhview::FramePlan plan;
    Totals totals;
    for (int frame = 0; frame < kFrames; ++frame) {
        const rhview::View camera = camera_of(frame), sun = sun_of(camera);

        shadow_planner.plan({.culling_view = sun}, plan);
        renderer.begin(Target::ShadowMap, sun);
        execute(plan, renderer);
        totals.shadow_draws += plan.opaque.size();
        totals.missing += missing_pixels(renderer, Target::ShadowMap, sun, *octree);

        camera_planner.absorb(renderer.answers());
        camera_planner.plan(
            {.culling_view = camera, .viewport_pixels = {Renderer::kWidth, Renderer::kHeight}}, plan);
        renderer.begin(Target::Picture, camera);
        execute(plan, renderer);
        totals.camera_draws += plan.opaque.size();
        totals.queries += plan.queries.size();
        totals.conditional += plan.conditional.size();
        totals.missing += missing_pixels(renderer, Target::Picture, camera, *octree);
    }
    print(totals);
    return totals.missing == 0 && totals.queries > 0 ? 0 : 1;
}
