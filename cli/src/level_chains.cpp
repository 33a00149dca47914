// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "level_chains.h"

#include <fmt/format.h>

#include "rhview/lod/projected_error.h"

namespace rhview::cli {
namespace {

std::vector<bool> placed_meshes(const Scene& scene) {
    std::vector<bool> placed(scene.meshes.size());
    for (const DynamicObject& object : scene.dynamic_objects) placed[index_of(object.mesh)] = true;
    return placed;
}

}  // namespace

Result<std::vector<LodChain>> build_chains(const Scene& scene, Progress& progress) {
    const std::vector<bool> placed = placed_meshes(scene);
    std::vector<LodMesh> meshes(scene.meshes.size());
    for (std::size_t m = 0; m < meshes.size(); ++m)
        if (placed[m]) meshes[m] = {scene.pools[scene.meshes[m].pool].positions, scene.meshes[m].indices};
    LodOptions options;
    options.progress = [&](double share) {
        progress.show("levels of detail", static_cast<int>(1000.0 * share), 1000);
        return true;
    };
    Result<std::vector<LodChain>> chains = build_lod_chains(meshes, options);
    if (!chains) return Error{fmt::format("{}: {}", scene.name, chains.error().message)};
    return chains;
}

Status check_chains(const RhoFile& file, const Scene& scene, const std::vector<LodChain>& chains) {
    const std::vector<bool> placed = placed_meshes(scene);
    bool fits = chains.size() == scene.meshes.size();
    for (std::size_t m = 0; fits && m < chains.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        fits = !placed[m] || (chains[m].levels[0].index_count == mesh.indices.size() &&
                              chains[m].vertex_count <= scene.pools[mesh.pool].positions.size() &&
                              chains[m].levels.size() <= 255);
    }
    return fits ? success() : file.error(section_tag("LCHN"), "the levels of detail are not the scene's");
}

std::vector<LevelledObject> levelled_objects(const Scene& scene) {
    std::vector<LevelledObject> objects;
    objects.reserve(scene.dynamic_objects.size());
    for (const DynamicObject& object : scene.dynamic_objects)
        objects.push_back(
            {static_cast<std::uint32_t>(object.mesh),
             // Ways turn and move, and so keep lengths, but for the rounding of the turn.
             static_cast<float>(largest_stretch(glm::dmat3(object.scene_from_mesh)) * (1.0 + 1e-6))});
    return objects;
}

ChainRanges::ChainRanges(std::span<const LodChain> chains) {
    for (const LodChain& chain : chains) {
        std::vector<gl::LevelRange>& ranges = ranges_.emplace_back();
        for (const LodLevel& level : chain.levels.span().subspan(1))
            ranges.push_back({level.first_index, level.index_count});
        meshes_.push_back({chain.indices, {}});
    }
    for (std::size_t m = 0; m < chains.size(); ++m) meshes_[m].levels = ranges_[m];
}

}  // namespace rhview::cli
