// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "method.h"

#include "rhview/baselines/draw_everything.h"
#include "rhview/baselines/frustum_objects.h"
#include "rhview/baselines/octree_leaves.h"
#include "rhview/gl/timer.h"
#include "rhview/pipeline/seed_planner.h"

namespace rhview::cli {
namespace {

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

}  // namespace

std::vector<std::string> method_names() {
    return {"none", "frustum", "octree", "rhview-seed", "rhview"};
}

std::span<const std::uint32_t> PreparedMethod::static_indices() const {
    return octree != nullptr ? octree->indices() : std::span<const std::uint32_t>();
}

std::unique_ptr<FramePlanner> make_reference(const Scene& scene) {
    std::vector<std::uint32_t> counts;
    for (const SceneBatch& batch : scene.batches)
        counts.push_back(static_cast<std::uint32_t>(batch.indices.size()));
    return std::make_unique<DrawEverything>(counts, scene.bounds());
}

Result<PreparedMethod> prepare_method(std::string_view method, const Scene& scene,
                                      std::uint32_t max_leaf_triangles, const RhOctree* baked) {
    PreparedMethod prepared;
    if (method == "none") {
        prepared.planner = make_reference(scene);
        return prepared;
    }
    if (method == "frustum") {
        prepared.planner = std::make_unique<FrustumObjects>(static_objects(scene));
        return prepared;
    }
    if (baked != nullptr) {
        prepared.octree = std::make_unique<RhOctree>(*baked);
    } else {
        const gl::WallTimer timer;
        Result<RhOctree> octree = build_octree(scene.triangle_batches(), {max_leaf_triangles});
        if (!octree) return Error{scene.name + ": " + octree.error().message};
        prepared.build_ms = timer.elapsed_ms();
        prepared.octree = std::make_unique<RhOctree>(std::move(octree).value());
    }
    if (method == "octree")
        prepared.planner = std::make_unique<OctreeLeaves>(*prepared.octree);
    else
        prepared.planner = std::make_unique<SeedPlanner>(*prepared.octree);
    return prepared;
}

}  // namespace rhview::cli
