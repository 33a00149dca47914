// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A scene and its camera path as sections of a baked file (`.rho`): what a program needs to draw it.
///
/// Vertices, indices and objects stay in the mapped file, which lives as long as a scene or copy of it does.
/// Layout: docs/files.md.
#pragma once

#include <cstdint>
#include <string>

#include "rhview/base/result.h"
#include "rhview/base/rho_file.h"
#include "rhview/base/rho_writer.h"
#include "rhview/scenes/named_scene.h"

namespace rhview {

/// Where a baked scene came from.
struct SceneProvenance {
    std::string source;    ///< as the user named it: a file, or a named scene with parameters
    std::string baked_by;  ///< program and version
};

/// A scene from a baked file, with its path and where it came from.
struct BakedScene {
    SceneAndPath scene;
    SceneProvenance provenance;
};

/// Adds the sections of `scene`, which stays as it is until the writer has finished.
void add_scene_sections(RhoWriter& writer, const SceneAndPath& scene, const SceneProvenance& provenance);

/// Reads them, and checks everything that drawing and planning rely on: counts against each other and the
/// file, index values against their vertices, objects against their batch, materials, pools and meshes
/// against their lists, boxes, placements and the camera path. Vertices are as their checksum says: a
/// position that is not finite is not looked for. Errors: those of `RhoFile`, or what is wrong, and with
/// what. Cost: one pass over the sections for the checksums, one over the indices, on all of oneTBB's
/// threads.
Result<BakedScene> read_scene_sections(const RhoFile& file);

}  // namespace rhview
