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

/// What the user says about such a method, and about `grid`.
struct RivalOptions {
    std::string hierarchy = "auto";  ///< of chc and chc++: "bvh", "octree", or what suits the scene
    std::optional<std::uint32_t> leaf_triangles;
    ChcPlusPlusOptions chc_plus_plus;
    NestedGridOptions grid;
    double grid_cells = 100.0 * 60.0 * 100.0;  ///< of `grid`, about
};

/// `tune` is KEY=VALUE,… with the keys batch, visible-frames, tight-depth, tight-area, visible-query,
/// levels, top-cells, inner-cells and cells.
Result<RivalOptions> parse_rival(std::string_view hierarchy, std::string_view tune);

bool is_tune_key(std::string_view key);
/// Whether a method heeds `hierarchy`, and whether it has parameters to tune.
bool has_hierarchy(std::string_view method);
bool has_tune(std::string_view method);

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
