// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "scene_source.h"

#include <filesystem>

#include "rhview/scenes/import.h"

namespace rhview::cli {

Result<SceneAndPath> load_scene(const std::string& spec) {
    std::error_code ignored;
    const bool looks_like_file = spec.find('.') != std::string::npos || spec.find('/') != std::string::npos ||
                                 std::filesystem::exists(spec, ignored);
    if (is_named_scene(spec) || !looks_like_file) return make_named_scene(spec);
    Result<Scene> scene = import_scene(spec);
    if (!scene) return scene.error();
    CameraPath path = walkthrough_of_scene(*scene);
    return SceneAndPath{std::move(scene).value(), std::move(path)};
}

}  // namespace rhview::cli
