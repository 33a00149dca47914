// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "walk_description.h"

#include <algorithm>

#include "rhview/scenes/object_motion.h"

namespace rhview::cli {
namespace {

std::uint64_t distinct(std::vector<std::uint32_t> numbers) {
    std::ranges::sort(numbers);
    // cppcheck-suppress mismatchingContainerExpression ; std::ranges::unique gives a part of `numbers`
    return static_cast<std::uint64_t>(std::ranges::unique(numbers).begin() - numbers.begin());
}

}  // namespace

WalkReport describe(const WalkOptions& options, const WalkGround& ground, const PreparedMethod& method) {
    const Scene& scene = ground.loaded.scene;
    const gl::DeviceInfo& device = ground.context.device();
    WalkReport report;
    report.scene = {scene.name,
                    scene.static_triangles(),
                    scene.dynamic_objects.size(),
                    scene.dynamic_triangles(),
                    scene.materials.size(),
                    scene.batches.size(),
                    scene.static_instances.size(),
                    scene.instance_triangles(),
                    distinct(object_groups(scene))};
    report.device = {device.renderer, device.version, "wall"};
    report.build.ms = method.build_ms;
    if (method.octree != nullptr) {
        report.build.nodes = method.octree->nodes().size();
        report.build.leaves = method.octree->leaf_count();
        report.build.replicas = method.octree->replicas().size();
        report.build.replica_bytes = method.octree->replica_bytes();
        report.build.hierarchy = "octree";
    }
    if (method.rival) {
        report.build.nodes = method.rival->nodes;
        report.build.leaves = method.rival->leaves;
        report.build.hierarchy = method.rival->hierarchy;
        report.in_steps = true;
    }
    report.build.instancing = scene.instancing;
    report.build.index_bytes = scene.index_bytes();
    report.build.vertex_bytes = scene.vertex_bytes();
    report.method = options.method;
    report.mode = options.mode;
    report.visible_pixels = options.visible_pixels;
    report.submission = options.submission;
    report.occlusion = options.occlusion;
    report.leaf = method.max_leaf_triangles;
    report.lod.error_bound_px = options.lod_error_px;
    report.lod.policy = options.lod_policy;
    report.lod.budget_ms = options.budget_ms;
    report.lod.build_ms = ground.chains_ms;
    for (const LodChain& chain : ground.chains) {
        report.lod.levels += chain.levels.size() - 1;
        report.lod.index_bytes += chain.indices.span().size_bytes();
    }
    if (ground.loaded.baked)
        report.build.load_ms = ground.loaded.baked->load_ms;
    else
        report.build.settle_ms = ground.settle_ms;
    if (ground.chosen.constants)
        report.profile = {ground.chosen.constants->profile, ground.chosen.constants->source,
                          ground.chosen.constants->told};
    else
        report.why_no_profile = ground.chosen.why_not;
    report.rate_hz = options.rate_hz;
    report.excerpts = options.excerpts;
    report.width = ground.size.width;
    report.height = ground.size.height;
    return report;
}

}  // namespace rhview::cli
