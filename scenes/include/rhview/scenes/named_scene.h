// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Procedural scenes by name and parameters, bit-identical on every machine: `town`, `town:size=700,seed=7`.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "rhview/base/result.h"
#include "rhview/scenes/camera_path.h"
#include "rhview/scenes/scene.h"

namespace rhview {

/// A whole-number parameter of a named scene, with the range it accepts.
struct SceneParameter {
    std::string_view name;
    std::int64_t default_value = 0;
    std::int64_t minimum = 0;
    std::int64_t maximum = 0;
    std::string_view meaning;
};

/// For lists and help.
struct NamedSceneInfo {
    std::string_view name;
    std::string_view description;
    std::string_view default_size;  ///< triangles and objects at default parameters, for people
    std::span<const SceneParameter> parameters;
};

/// Every named scene, in the order they are listed to people.
std::span<const NamedSceneInfo> named_scenes();

/// A scene with the path that walks it.
struct SceneAndPath {
    Scene scene;
    CameraPath path;
};

/// Whether `spec` names a procedural scene (before any colon), rather than a file.
bool is_named_scene(std::string_view spec);

/// Builds `name` or `name:key=value,…`. Errors: unknown name or parameter, a value that is no whole number or
/// out of its range, a scene larger than the memory that is free (said before allocating).
Result<SceneAndPath> make_named_scene(std::string_view spec);

}  // namespace rhview
