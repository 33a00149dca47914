// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <span>

#include "../plan_everything.h"
#include "../rho_bytes.h"
#include "rhview/lod/baked_lod.h"
#include "rhview/rhoctree/baked_octree.h"
#include "rhview/scenes/baked_scene.h"

namespace rhview {

/// Aborts if a level leaves its chain's indices or vertices, or is not smaller than the one before.
inline void use_chains(std::span<const LodChain> chains) {
    for (const LodChain& chain : chains) {
        if (chain.levels.empty()) std::abort();
        for (std::size_t i = 1; i < chain.levels.size(); ++i) {
            const LodLevel& level = chain.levels[i];
            if (level.index_count >= chain.levels[i - 1].index_count || !std::isfinite(level.error))
                std::abort();
            if (level.first_index + std::uint64_t{level.index_count} > chain.indices.size()) std::abort();
        }
        for (const std::uint32_t index : chain.indices)
            if (index >= chain.vertex_count) std::abort();
    }
}

/// Reads `bytes` as a baked file and uses all that is accepted: plans its octree, frames its path, adds up
/// its scene. Aborts if something that was accepted is out of bounds. How many of the three parts were
/// accepted.
inline int use_baked_file(std::span<const std::byte> bytes) {
    const Result<RhoFile> file = RhoFile::parse(FileBytes::copy_of(bytes), "input.rho");
    if (!file) return 0;
    int accepted = 0;
    if (const Result<BakedOctree> octree = read_octree_sections(*file)) {
        ++accepted;
        plan_everything(octree->octree);
    }
    if (const Result<BakedScene> baked = read_scene_sections(*file)) {
        ++accepted;
        const Scene& scene = baked->scene.scene;
        if (!(scene.vertex_bytes() + scene.index_bytes() <= bytes.size())) std::abort();
        for (const TriangleBatch& batch : scene.triangle_batches())
            for (const std::uint32_t index : batch.indices)
                if (index >= batch.positions.size()) std::abort();
        for (std::uint32_t i = 0; i < scene.object_count(); ++i) {
            const std::size_t mesh = index_of(scene.object_mesh(ObjectId{i}));
            if (mesh >= scene.meshes.size()) std::abort();
            const std::size_t vertices = scene.pools[scene.meshes[mesh].pool].positions.size();
            for (const std::uint32_t index : scene.meshes[mesh].indices)
                if (index >= vertices) std::abort();
        }
        for (const StaticInstance& instance : scene.static_instances) {
            const glm::dmat3 back = glm::inverse(glm::dmat3(instance.scene_from_mesh));
            if (instance.bounds.is_empty() || !std::isfinite(glm::determinant(back))) std::abort();
        }
        if (!validate(baked->scene.path.view_of_frame(1, 3, 1.5, ClipDepth::ZeroToOne))) std::abort();
    }
    if (const auto chains = read_lod_sections(*file); chains && chains->has_value()) {
        ++accepted;
        use_chains(**chains);
    }
    return accepted;
}

/// As they are, and with checksums that fit whatever they say now: else hardly anything would pass the first
/// gate.
inline int use_raw_and_repaired(std::span<const std::byte> bytes) {
    const int raw = use_baked_file(bytes);
    RhoBytes repaired{{bytes.begin(), bytes.end()}};
    repaired.repair();
    return raw + use_baked_file(repaired.bytes);
}

}  // namespace rhview
