// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "scene.h"

#include <cmath>

#include "border.h"
#include "chains.h"
#include "costs.h"
#include "rhview/base/workers.h"
#include "source_arrays.h"

namespace rhview::capi {
namespace {

/// A caller's batches as the builder takes them.
class SourceBatches {
  public:
    explicit SourceBatches(const std::vector<rhview_batch>& given) {
        for (const rhview_batch& batch : given) {
            const auto material = static_cast<std::uint32_t>(batches_.size());
            batches_.push_back({MaterialId{material}, arrays_.positions(batch), arrays_.indices(batch),
                                batch.is_two_sided != 0});
            index_count_ += batch.index_count;
        }
    }

    [[nodiscard]] std::span<const TriangleBatch> span() const { return batches_; }
    [[nodiscard]] std::uint64_t index_count() const { return index_count_; }

  private:
    SourceArrays arrays_;
    std::vector<TriangleBatch> batches_;
    std::uint64_t index_count_ = 0;
};

OctreeOptions octree_options(const rhview_build_options& given, const KnownCosts& costs,
                             const SourceBatches& source) {
    OctreeOptions options = choose_octree_options(costs.draw, source.index_count(), source.span().size());
    if (given.max_leaf_triangles != 0) options.max_leaf_triangles = given.max_leaf_triangles;
    if (given.has_no_replicas != 0) options.replica_budget = 0.0;
    if (given.progress != nullptr)
        options.progress = [call = given.progress, user = given.progress_user](double share) {
            return call(user, share) != 0;
        };
    return options;
}

rhview_status build(Scene& scene, const rhview_build_options* given) {
    rhview_build_options options;
    if (const rhview_status status = take(given, "rhview_build_options", options); status != RHVIEW_OK)
        return status;
    KnownCosts costs;
    if (const rhview_status status = take_costs(options.costs, costs); status != RHVIEW_OK) return status;
    Workers workers;
    if (const rhview_status status = take_workers(options.workers, workers); status != RHVIEW_OK)
        return status;
    const SourceBatches source(scene.batches);
    const OctreeOptions built_with = octree_options(options, costs, source);
    Result<RhOctree> octree = run_on(workers, [&] { return build_octree(source.span(), built_with); });
    if (!octree) return fail(RHVIEW_INVALID_DATA, octree.error().message);
    scene.octree = std::move(octree).value();
    scene.is_built = true;
    scene.batches = {};
    return RHVIEW_OK;
}

}  // namespace
}  // namespace rhview::capi

using namespace rhview::capi;

rhview_status rhview_scene_create(const rhview_scene_options* options, rhview_scene** scene) {
    return guarded([&] {
        if (scene == nullptr) return fail(RHVIEW_INVALID_ARGUMENT, "rhview_scene_create: scene is null");
        rhview_scene_options taken;
        if (const rhview_status status = take(options, "rhview_scene_options", taken); status != RHVIEW_OK)
            return status;
        for (const double coordinate : taken.origin)
            if (!std::isfinite(coordinate))
                return fail(RHVIEW_INVALID_ARGUMENT, "rhview_scene_options: origin is not finite");
        auto created = std::make_unique<rhview_scene>();
        created->state->origin = {taken.origin[0], taken.origin[1], taken.origin[2]};
        created->state->object_indices.resize(taken.max_objects);
        created->state->has_object.resize(taken.max_objects);
        created->state->levelled.resize(taken.max_objects);
        if (taken.chains != nullptr) created->state->chains = taken.chains->chains;
        *scene = created.release();
        return rhview_status{RHVIEW_OK};
    });
}

void rhview_scene_destroy(rhview_scene* scene) {
    delete scene;
}

rhview_status rhview_scene_add_batch(rhview_scene* scene, const rhview_batch* batch, uint32_t* batch_number) {
    return guarded([&] {
        if (scene == nullptr || batch == nullptr)
            return fail(RHVIEW_INVALID_ARGUMENT, "rhview_scene_add_batch: scene or batch is null");
        if (scene->state->is_built)
            return fail(RHVIEW_WRONG_STATE, "the scene is built: batches are added before");
        rhview_batch taken;
        if (const rhview_status status = take(batch, "rhview_batch", taken); status != RHVIEW_OK)
            return status;
        complete_arrays(taken);
        if (const char* wrong = wrong_arrays(taken)) return fail_field("rhview_batch", {wrong});
        scene->state->batches.push_back(taken);
        if (batch_number != nullptr) *batch_number = static_cast<uint32_t>(scene->state->batches.size() - 1);
        return rhview_status{RHVIEW_OK};
    });
}

rhview_status rhview_scene_build(rhview_scene* scene, const rhview_build_options* options) {
    return guarded([&] {
        if (scene == nullptr) return fail(RHVIEW_INVALID_ARGUMENT, "rhview_scene_build: scene is null");
        if (scene->state->is_built) return fail(RHVIEW_WRONG_STATE, "the scene is built already");
        return build(*scene->state, options);
    });
}

rhview_status rhview_scene_indices(const rhview_scene* scene, const uint32_t** indices, size_t* count) {
    if (scene == nullptr || indices == nullptr || count == nullptr)
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_scene_indices: an argument is null");
    if (!scene->state->is_built) return fail(RHVIEW_WRONG_STATE, "the scene is not built yet");
    *indices = scene->state->octree.indices().data();
    *count = scene->state->octree.indices().size();
    return RHVIEW_OK;
}
