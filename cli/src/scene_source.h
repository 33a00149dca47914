// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include "rhview/base/result.h"
#include "rhview/scenes/named_scene.h"

namespace rhview::cli {

/// SCENE as the user names it: a named scene with parameters, or a file; with the path that walks it.
Result<SceneAndPath> load_scene(const std::string& spec);

}  // namespace rhview::cli
