// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "scene_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "level_chains.h"
#include "rhview/gl/timer.h"
#include "rhview/scenes/import.h"

namespace rhview::cli {
namespace {

/// The two halves of a baked file were written together: they must still be of one scene.
Status check_fit(const RhoFile& file, const Scene& scene, const BakedOctree& octree) {
    bool fits = octree.batches.size() == scene.batches.size();
    for (std::size_t b = 0; fits && b < scene.batches.size(); ++b) {
        const SceneBatch& batch = scene.batches[b];
        fits = octree.batches[b].index_count == batch.indices.size() &&
               octree.batches[b].vertex_count == scene.pools[batch.pool].positions.size();
    }
    return fits ? success() : file.error(section_tag("OBAT"), "the octree is not the scene's");
}

Result<LoadedScene> load_baked(const std::string& name) {
    const gl::WallTimer timer;
    const Result<RhoFile> file = RhoFile::open(name);
    if (!file) return file.error();
    Result<BakedScene> scene = read_scene_sections(*file);
    if (!scene) return scene.error();
    Result<BakedOctree> octree = read_octree_sections(*file);
    if (!octree) return octree.error();
    if (Status status = check_fit(*file, scene->scene.scene, *octree); !status) return status.error();
    Result<std::optional<std::vector<LodChain>>> chains = read_lod_sections(*file);
    if (!chains) return chains.error();
    if (*chains)
        if (Status status = check_chains(*file, scene->scene.scene, **chains); !status) return status.error();
    return LoadedScene{{std::move(scene->scene)},
                       BakedParts{std::move(octree).value(), std::move(chains).value(),
                                  std::move(scene->provenance), timer.elapsed_ms()}};
}

}  // namespace

bool is_baked_name(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension == ".rho";
}

Result<LoadedScene> load_scene(const std::string& spec) {
    std::error_code ignored;
    const bool looks_like_file = spec.find('.') != std::string::npos || spec.find('/') != std::string::npos ||
                                 std::filesystem::exists(spec, ignored);
    if (is_named_scene(spec) || !looks_like_file) {
        Result<SceneAndPath> scene = make_named_scene(spec);
        if (!scene) return scene.error();
        return LoadedScene{std::move(scene).value(), {}};
    }
    if (is_baked_name(spec)) return load_baked(spec);
    Result<Scene> scene = import_scene(spec, RepeatedMeshes::Keep);
    if (!scene) return scene.error();
    CameraPath path = walkthrough_of_scene(*scene);
    return LoadedScene{{std::move(scene).value(), std::move(path)}, {}};
}

Result<LoadedScene> load_scene(const std::string& spec,
                               const std::optional<std::filesystem::path>& camera_path) {
    if (!camera_path) return load_scene(spec);
    Result<CameraPath> path = load_camera_path(*camera_path);
    if (!path) return path.error();
    Result<LoadedScene> loaded = load_scene(spec);
    if (loaded) loaded->path = std::move(path).value();
    return loaded;
}

}  // namespace rhview::cli
