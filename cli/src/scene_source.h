// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "rhview/base/result.h"
#include "rhview/lod/baked_lod.h"
#include "rhview/rhoctree/baked_octree.h"
#include "rhview/scenes/baked_scene.h"

namespace rhview::cli {

/// What a baked file brings beside the scene.
struct BakedParts {
    BakedOctree octree;
    std::optional<std::vector<LodChain>> chains;  ///< by mesh; absent: the file has none
    SceneProvenance provenance;
    double load_ms = 0.0;  ///< mapping and checking all of it
};

struct LoadedScene : SceneAndPath {
    std::optional<BakedParts> baked;
};

/// SCENE as the user names it: a named scene with parameters, or a file, baked ones too; with the path that
/// walks it. Meshes that a file places repeatedly come as static instances.
Result<LoadedScene> load_scene(const std::string& spec);
/// The same, walked along the path of `camera_path` where there is one; that file is read first.
Result<LoadedScene> load_scene(const std::string& spec,
                               const std::optional<std::filesystem::path>& camera_path);

/// Whether `file` is named as a baked file.
bool is_baked_name(const std::filesystem::path& file);

}  // namespace rhview::cli
