// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "scene.h"

#include <cmath>
#include <cstring>
#include <string>

#include "border.h"
#include "costs.h"
#include "rhview/base/workers.h"

namespace rhview::capi {
namespace {

constexpr std::size_t kTightStride = 3 * sizeof(float);

/// A caller's batches as the builder takes them; what it cannot take as it is, is copied.
class SourceBatches {
  public:
    explicit SourceBatches(const std::vector<rhview_batch>& given) {
        positions_.reserve(given.size());
        indices_.reserve(given.size());
        for (const rhview_batch& batch : given) {
            const auto material = static_cast<std::uint32_t>(batches_.size());
            batches_.push_back(
                {MaterialId{material}, positions_of(batch), indices_of(batch), batch.is_two_sided != 0});
            index_count_ += batch.index_count;
        }
    }

    [[nodiscard]] std::span<const TriangleBatch> span() const { return batches_; }
    [[nodiscard]] std::uint64_t index_count() const { return index_count_; }

  private:
    std::span<const glm::vec3> positions_of(const rhview_batch& batch) {
        static_assert(sizeof(glm::vec3) == kTightStride);
        if (batch.position_stride == kTightStride)
            return {reinterpret_cast<const glm::vec3*>(batch.positions), batch.vertex_count};
        std::vector<glm::vec3>& copy = positions_.emplace_back(batch.vertex_count);
        const auto* bytes = reinterpret_cast<const unsigned char*>(batch.positions);
        for (std::size_t i = 0; i < batch.vertex_count; ++i)
            std::memcpy(&copy[i], bytes + i * batch.position_stride, kTightStride);
        return copy;
    }

    std::span<const std::uint32_t> indices_of(const rhview_batch& batch) {
        if (batch.index_bytes == 4)
            return {static_cast<const std::uint32_t*>(batch.indices), batch.index_count};
        const auto* narrow = static_cast<const std::uint16_t*>(batch.indices);
        return indices_.emplace_back(narrow, narrow + batch.index_count);
    }

    std::vector<TriangleBatch> batches_;
    std::vector<std::vector<glm::vec3>> positions_;
    std::vector<std::vector<std::uint32_t>> indices_;
    std::uint64_t index_count_ = 0;
};

/// What is wrong with a batch, apart from what its numbers say; null: nothing. Fills in what is left out.
const char* complete(rhview_batch& batch) {
    if (batch.index_bytes == 0) batch.index_bytes = 4;
    if (batch.position_stride == 0) batch.position_stride = kTightStride;
    if (batch.index_bytes != 2 && batch.index_bytes != 4) return "rhview_batch: index_bytes is 2 or 4";
    if (batch.position_stride < kTightStride) return "rhview_batch: position_stride is less than 12 bytes";
    if (batch.positions == nullptr && batch.vertex_count > 0) return "rhview_batch: positions is null";
    if (batch.indices == nullptr && batch.index_count > 0) return "rhview_batch: indices is null";
    return nullptr;
}

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
        if (const char* wrong = complete(taken)) return fail(RHVIEW_INVALID_ARGUMENT, wrong);
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
