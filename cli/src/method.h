// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/pipeline/frame_planner.h"
#include "rhview/rhoctree/rhoctree.h"
#include "rhview/scenes/scene.h"

namespace rhview::cli {

/// The methods' names, in the order they are listed to people.
std::vector<std::string> method_names();

/// A culling method made ready for a scene.
struct PreparedMethod {
    std::unique_ptr<RhOctree> octree;  ///< null where the method needs none
    std::unique_ptr<FramePlanner> planner;
    std::optional<double> build_ms;

    /// The order of the static indices that the plans refer to; empty: the scene's own.
    [[nodiscard]] std::span<const std::uint32_t> static_indices() const;
};

/// Builds what `method` needs; `scene` outlives it. Leaves hold at most `max_leaf_triangles`. A scene that
/// brings its octree (`baked`) is not built again.
Result<PreparedMethod> prepare_method(std::string_view method, const Scene& scene,
                                      std::uint32_t max_leaf_triangles, const RhOctree* baked = nullptr);

/// The planner of what the picture must equal, whatever the order of the static indices.
std::unique_ptr<FramePlanner> make_reference(const Scene& scene);

}  // namespace rhview::cli
