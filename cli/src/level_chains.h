// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <vector>

#include "progress.h"
#include "rhview/base/result.h"
#include "rhview/base/rho_file.h"
#include "rhview/gl/scene_buffers.h"
#include "rhview/lod/lod_chain.h"
#include "rhview/pipeline/object_levels.h"
#include "rhview/scenes/scene.h"

namespace rhview::cli {

/// Chains of levels of detail of a scene, by mesh. Meshes that no dynamic object places have none: theirs is
/// that of an empty mesh.
Result<std::vector<LodChain>> build_chains(const Scene& scene, Progress& progress);

/// Whether chains that a baked file brings are the scene's.
Status check_chains(const RhoFile& file, const Scene& scene, const std::vector<LodChain>& chains);

/// Which chain an object has, and how large it is: by `ObjectId`. Static instances have none.
std::vector<LevelledObject> levelled_objects(const Scene& scene);

/// The ranges of `chains`, for the device. Spans into both until either changes.
class ChainRanges {
  public:
    explicit ChainRanges(std::span<const LodChain> chains);
    [[nodiscard]] std::span<const gl::MeshLevels> meshes() const { return meshes_; }

  private:
    std::vector<std::vector<gl::LevelRange>> ranges_;
    std::vector<gl::MeshLevels> meshes_;
};

}  // namespace rhview::cli
