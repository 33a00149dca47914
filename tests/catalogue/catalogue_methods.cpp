// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "catalogue_methods.h"

#include "rhview/baselines/chc.h"
#include "rhview/baselines/chc_plus_plus.h"
#include "rhview/baselines/draw_everything.h"
#include "rhview/baselines/grid_planner.h"
#include "rhview/baselines/nested_grid.h"
#include "rhview/baselines/octree_leaves.h"
#include "rhview/gl/context.h"
#include "rhview/pipeline/rhview_planner.h"
#include "static_objects.h"

namespace rhview {
namespace {

// A draw for the price of 40 triangles, a question for less than one: gaps are bridged, and much is asked.
constexpr DrawCosts kCosts{1.0, 120.0, 0.0};
// Latent mode trusts answers that are 8 frames old at most (`OcclusionSettings::latent_max_age`), and one
// more passes until they are there: after that, all that it trusts was said of the camera where it stands.
constexpr int kLatentFrames = 10;

std::vector<std::uint32_t> object_indices_of(const Scene& scene) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < scene.object_count(); ++i)
        indices.push_back(static_cast<std::uint32_t>(
            scene.meshes[index_of(scene.object_mesh(ObjectId{i}))].indices.size()));
    return indices;
}

OcclusionOptions occlusion_of(OcclusionMode mode, bool box_pass, std::span<const std::uint32_t> indices) {
    OcclusionOptions options;
    options.settings.mode = mode;
    options.shown_index_ns = 4.0;
    options.costs = {{.query_ns = 20.0, .box_ns = 1.0, .draw_ns = 3.0},
                     {.query_ns = 10.0, .box_ns = 2.0, .draw_ns = 3.0}};
    if (!box_pass) options.costs.box_pass.frame_ns = 1e12;
    options.object_indices = indices;
    return options;
}

std::unique_ptr<FramePlanner> grid_of(const Scene& scene) {
    std::vector<GridStatic> statics;
    for (const StaticObject& object : objects_of(scene)) statics.push_back({object.range, object.bounds});
    std::vector<GridObject> objects;
    for (const Aabb& box : scene.object_boxes()) objects.push_back({.bounds = box});
    GridOptions options;
    options.cells = glm::ivec3(24);
    options.bounds = scene.bounds();
    return std::make_unique<GridPlanner>(scene.triangle_batches(),
                                         std::vector<bool>(scene.batches.size(), true), std::move(statics),
                                         std::move(objects), options);
}

CatalogueMethod planned(std::string name, const Scene& scene, std::unique_ptr<FramePlanner> planner,
                        std::unique_ptr<RhOctree> octree = nullptr) {
    CatalogueMethod method;
    method.name = std::move(name);
    method.buffers = octree ? gl::SceneBuffers::upload(scene, octree->indices()).value()
                            : gl::SceneBuffers::upload(scene).value();
    method.octree = std::move(octree);
    method.planner = std::move(planner);
    return method;
}

CatalogueMethod interactive(std::string name, const Scene& scene, std::unique_ptr<InteractiveMethod> of,
                            std::span<const std::uint32_t> indices) {
    CatalogueMethod method;
    method.name = std::move(name);
    method.buffers = gl::SceneBuffers::upload(scene, indices).value();
    method.interactive = std::move(of);
    return method;
}

/// `make(octree)` gives a planner over an octree of its own.
template <class Make>
CatalogueMethod over_octree(std::string name, const Scene& scene, const Make& make) {
    auto octree = std::make_unique<RhOctree>(catalogue_octree(scene));
    std::unique_ptr<FramePlanner> planner = make(*octree);
    return planned(std::move(name), scene, std::move(planner), std::move(octree));
}

/// `rhview` that asks by one way or the other.
CatalogueMethod asking(std::string name, const Scene& scene, OcclusionMode mode, bool box_pass) {
    std::vector<std::uint32_t> indices = object_indices_of(scene);
    CatalogueMethod method = over_octree(std::move(name), scene, [&](const RhOctree& octree) {
        return std::make_unique<RhviewPlanner>(octree, kCosts, occlusion_of(mode, box_pass, indices));
    });
    if (mode == OcclusionMode::Latent) method.frames_to_promise = kLatentFrames;
    method.object_indices = std::move(indices);
    return method;
}

CatalogueMethod seed(const Scene& scene) {
    std::vector<std::uint32_t> indices = object_indices_of(scene);
    CatalogueMethod method = over_octree("rhview-seed", scene, [&](const RhOctree& octree) {
        OcclusionOptions options = occlusion_of(OcclusionMode::Exact, false, indices);
        options.settings.policy = OcclusionPolicy::Paper;
        options.settings.paper_budget_ns = 1.0;
        return std::make_unique<SeedPlanner>(octree, kCosts, options);
    });
    method.object_indices = std::move(indices);
    return method;
}

void add_interactive(const Scene& scene, std::vector<CatalogueMethod>& methods) {
    const std::vector<TriangleBatch> batches = scene.triangle_batches();
    OrderedTree grid = make_nested_grid(batches, {.max_triangles = 60});
    methods.push_back(
        interactive("nested-grid", scene, std::make_unique<StopAndWait>(std::move(grid.tree)), grid.indices));
    OrderedTree objects = make_object_tree(objects_of(scene), batches, 60);
    methods.push_back(
        interactive("chc", scene, std::make_unique<Chc>(std::move(objects.tree)), objects.indices));
    const RhOctree octree = catalogue_octree(scene);
    methods.push_back(interactive("chc++", scene, std::make_unique<ChcPlusPlus>(CullTree::of_octree(octree)),
                                  octree.indices().first(octree.base_index_count())));
}

}  // namespace

RhOctree catalogue_octree(const Scene& scene) {
    OctreeOptions options;
    options.max_leaf_triangles = 24;
    options.replica_budget = 0.5;
    options.costs = kCosts;
    return build_octree(scene.triangle_batches(), options).value();
}

gl::FrameCounters CatalogueMethod::draw(const FrameInput& input, CatalogueDevice& device,
                                        gl::Submission submission) {
    gl::DrawOptions options;
    options.submission = submission;
    if (interactive) {
        device.stepped.begin(buffers, input.culling_view, options);
        interactive->draw(input, device.stepped, drawn_);
        hidden += drawn_.hidden_queries;
        return device.stepped.end();
    }
    planner->absorb(answers_);
    planner->plan(input, plan_);
    const gl::FrameCounters counters = device.executor.draw(plan_, buffers, input.culling_view, options);
    gl::finish();
    answers_.clear();
    device.executor.poll_answers(answers_);
    for (const QueryAnswer& answer : answers_) hidden += answer.visible ? 0 : 1;
    return counters;
}

FramePlan CatalogueMethod::last_plan() const {
    if (!interactive) return plan_;
    FramePlan plan = drawn_.plan;
    plan.queries.clear();
    plan.query_boxes.clear();
    return plan;
}

std::vector<CatalogueMethod> catalogue_methods(const Scene& scene, bool is_large) {
    std::vector<CatalogueMethod> methods;
    methods.push_back(over_octree("rhview, asks nothing", scene, [](const RhOctree& octree) {
        return std::make_unique<RhviewPlanner>(octree, kCosts);
    }));
    methods.push_back(asking("rhview, exact, box pass", scene, OcclusionMode::Exact, true));
    if (is_large) return methods;
    methods.push_back(asking("rhview, exact, queries", scene, OcclusionMode::Exact, false));
    methods.push_back(asking("rhview, latent", scene, OcclusionMode::Latent, true));
    methods.push_back(seed(scene));
    methods.push_back(planned("frustum", scene, std::make_unique<FrustumObjects>(objects_of(scene))));
    methods.push_back(planned("grid", scene, grid_of(scene)));
    methods.push_back(over_octree(
        "octree", scene, [](const RhOctree& octree) { return std::make_unique<OctreeLeaves>(octree); }));
    add_interactive(scene, methods);
    return methods;
}

FramePlan everything_of(const Scene& scene, const FrameInput& input) {
    std::vector<std::uint32_t> counts;
    for (const SceneBatch& batch : scene.batches)
        counts.push_back(static_cast<std::uint32_t>(batch.indices.size()));
    FramePlan plan;
    DrawEverything(counts, scene.bounds()).plan(input, plan);
    return plan;
}

}  // namespace rhview
