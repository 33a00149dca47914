// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include "rhview/scenes/named_scene.h"
#include "verbs.h"

namespace rhview::cli {

Result<int> run_scenes() {
    for (const NamedSceneInfo& scene : named_scenes()) {
        fmt::print("{}\n  {}\n  default: {}\n", scene.name, scene.description, scene.default_size);
        for (const SceneParameter& p : scene.parameters)
            fmt::print("  {:<10} {} (default {}, from {} to {})\n", p.name, p.meaning, p.default_value,
                       p.minimum, p.maximum);
        fmt::print("\n");
    }
    fmt::print("Parameters follow the name: rhview walk town:size=300,materials=12\n");
    return kDone;
}

}  // namespace rhview::cli
