// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "method.h"

#include "grid_method.h"
#include "rhview/baselines/draw_everything.h"
#include "rhview/baselines/frustum_objects.h"
#include "rhview/baselines/octree_leaves.h"
#include "rhview/gl/timer.h"
#include "rhview/pipeline/rhview_planner.h"
#include "rhview/pipeline/seed_planner.h"

namespace rhview::cli {
namespace {

/// With the paper's rule for what is asked about.
OcclusionOptions papers(OcclusionOptions options) {
    options.settings.policy = OcclusionPolicy::Paper;
    return options;
}

}  // namespace

std::vector<StaticObject> static_objects(const Scene& scene) {
    std::vector<StaticObject> objects;
    objects.reserve(scene.static_objects());
    std::uint32_t first = 0;
    for (std::uint32_t b = 0; b < scene.batches.size(); ++b) {
        for (const SceneObject& object : scene.batches[b].objects)
            objects.push_back({{BatchId{b}, first + object.first_index, object.index_count}, object.bounds});
        first += static_cast<std::uint32_t>(scene.batches[b].indices.size());
    }
    return objects;
}

// The rivals' octree is the paper's: leaves in source order, no replicas.
OctreeOptions octree_options_of(std::string_view method, const Scene& scene, const MethodOptions& options) {
    OctreeOptions result;
    if (method == "rhview") {
        result = choose_octree_options(options.costs, 3 * scene.batch_triangles(), scene.batches.size());
        result.replica_budget = options.replica_budget;
    } else {
        result.normal_order = false;
    }
    if (options.max_leaf_triangles) result.max_leaf_triangles = *options.max_leaf_triangles;
    return result;
}

std::vector<std::string> method_names() {
    return {"none", "frustum", "grid", "octree", "nested-grid", "chc", "chc++", "rhview-seed", "rhview"};
}

Aabb PreparedMethod::bounds_of(std::uint32_t chosen) const {
    return rival ? rival->method->bounds_of(chosen) : planner->bounds_of(chosen);
}

std::span<const std::uint32_t> PreparedMethod::static_indices() const {
    if (rival) return rival->indices;
    return octree != nullptr ? octree->indices() : std::span<const std::uint32_t>();
}

std::unique_ptr<FramePlanner> make_octree_planner(std::string_view method, const RhOctree& octree,
                                                  const MethodOptions& options) {
    if (method == "octree") return std::make_unique<OctreeLeaves>(octree);
    if (method == "rhview-seed" && options.occlusion)
        return std::make_unique<SeedPlanner>(octree, options.costs, papers(*options.occlusion));
    if (method == "rhview-seed") return std::make_unique<SeedPlanner>(octree);
    return std::make_unique<RhviewPlanner>(octree, options.costs, options.occlusion);
}

std::unique_ptr<FramePlanner> make_reference(const Scene& scene) {
    std::vector<std::uint32_t> counts;
    for (const SceneBatch& batch : scene.batches)
        counts.push_back(static_cast<std::uint32_t>(batch.indices.size()));
    return std::make_unique<DrawEverything>(counts, scene.bounds());
}

Result<PreparedMethod> prepare_method(std::string_view method, const Scene& scene,
                                      const MethodOptions& options, const BakedOctree* baked) {
    PreparedMethod prepared;
    if (method == "none") {
        prepared.planner = make_reference(scene);
        return prepared;
    }
    if (method == "frustum") {
        prepared.planner = std::make_unique<FrustumObjects>(static_objects(scene));
        return prepared;
    }
    if (method == "grid") {
        const gl::WallTimer timer;
        prepared.planner = make_grid_method(scene, options.rival.grid_cells, options.frame_seconds);
        prepared.build_ms = timer.elapsed_ms();
        return prepared;
    }
    if (is_interactive(method)) {
        RivalOptions rival_options = options.rival;
        rival_options.leaf_triangles = options.max_leaf_triangles;
        const gl::WallTimer timer;
        Result<PreparedRival> rival = prepare_rival(method, scene, rival_options, baked);
        if (!rival) return rival.error();
        prepared.rival = std::move(rival).value();
        prepared.max_leaf_triangles = prepared.rival->leaf_triangles;
        prepared.build_ms = timer.elapsed_ms();
        return prepared;
    }
    if (baked != nullptr) {
        prepared.max_leaf_triangles = baked->options.max_leaf_triangles;
        prepared.octree = std::make_unique<RhOctree>(baked->octree);
    } else {
        const OctreeOptions octree_options = octree_options_of(method, scene, options);
        const gl::WallTimer timer;
        Result<RhOctree> octree = build_octree(scene.triangle_batches(), octree_options);
        if (!octree) return Error{scene.name + ": " + octree.error().message};
        prepared.build_ms = timer.elapsed_ms();
        prepared.max_leaf_triangles = octree_options.max_leaf_triangles;
        prepared.octree = std::make_unique<RhOctree>(std::move(octree).value());
    }
    prepared.planner = make_octree_planner(method, *prepared.octree, options);
    return prepared;
}

}  // namespace rhview::cli
