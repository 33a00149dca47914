// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/baselines/chc_plus_plus.h"
#include "rhview/baselines/interactive_method.h"
#include "rhview/baselines/nested_grid.h"
#include "rhview/rhoctree/baked_octree.h"
#include "rhview/scenes/scene.h"

namespace rhview::cli {

/// Whether `method` draws and asks in turns: chc, chc++ or nested-grid.
bool is_interactive(std::string_view method);

/// What the user says about such a method.
struct RivalOptions {
    std::string hierarchy = "auto";  ///< of chc and chc++: "bvh", "octree", or the one that is the default
    std::optional<std::uint32_t> leaf_triangles;
    ChcPlusPlusOptions chc_plus_plus;
    NestedGridOptions grid;
};

/// `tune` is KEY=VALUE,… with the keys batch, visible-frames, tight-depth, tight-area, visible-query,
/// levels, top-cells and inner-cells.
Result<RivalOptions> parse_rival(std::string_view hierarchy, std::string_view tune);

struct PreparedRival {
    std::unique_ptr<InteractiveMethod> method;
    std::vector<std::uint32_t> indices;  ///< the order of the static ones
    std::string hierarchy;               ///< "bvh", "octree" or "grid"
    std::uint32_t leaf_triangles = 0;
    std::uint64_t nodes = 0;
    std::uint64_t leaves = 0;
};

/// Builds a method of `is_interactive`. A baked octree, if there is one, is the octree.
Result<PreparedRival> prepare_rival(std::string_view method, const Scene& scene, const RivalOptions& options,
                                    const BakedOctree* baked);

}  // namespace rhview::cli
