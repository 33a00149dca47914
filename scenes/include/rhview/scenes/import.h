// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Scene files: glTF 2.0 (`.glb`, `.gltf`), Wavefront (`.obj` with `.mtl`), Stanford (`.ply`).
///
/// Nodes are flattened into static batches per material; mirrored ones keep their outside outside. On request
/// a glTF mesh that several nodes place is stored once, with its places (`Scene::static_instances`).
/// Textures, lights, cameras, skins, morph targets and animations are not read. Errors are one sentence that
/// names the file, the place and the mend: missing or unreadable file, truncated or corrupt data, index out
/// of range, no triangle, more memory than is free (said before allocating). Triangles that are not finite
/// are dropped, counted and reported as a warning.
///
/// A scene far from zero (centre beyond 64 times its largest side, or a coordinate beyond 65,536) gets its
/// rounded centre as `Scene::origin`. glTF nodes and PLY coordinates keep their `double` precision that way;
/// OBJ coordinates pass through `float` first. Where several materials are and all are white, as in textured
/// scenes, each gets a muted colour of its own, so that pictures can be read.
#pragma once

#include <filesystem>

#include "rhview/base/result.h"
#include "rhview/scenes/scene.h"

namespace rhview {

/// What to do with a mesh that several nodes of a file place.
enum class RepeatedMeshes {
    Flatten,  ///< a copy in the batches for each node
    Keep,     ///< stored once; flattened all the same where `SceneBuilder::add_instance` refuses a place
};

/// Reads the format that the file's extension says (any case).
Result<Scene> import_scene(const std::filesystem::path& file,
                           RepeatedMeshes repeated = RepeatedMeshes::Flatten);

}  // namespace rhview
