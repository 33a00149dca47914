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
#include "rhview/pipeline/node_visibility.h"
#include "rhview/rhoctree/baked_octree.h"
#include "rhview/scenes/scene.h"
#include "rivals.h"

namespace rhview::cli {

/// The methods' names, in the order they are listed to people.
std::vector<std::string> method_names();

/// A culling method made ready for a scene: a planner, or one that draws and asks in turns.
struct PreparedMethod {
    std::unique_ptr<RhOctree> octree;  ///< null where the method needs none
    std::unique_ptr<FramePlanner> planner;
    std::optional<PreparedRival> rival;  ///< instead of a planner and its octree
    std::optional<double> build_ms;
    std::optional<std::uint32_t> max_leaf_triangles;

    [[nodiscard]] Aabb bounds_of(std::uint32_t chosen) const;
    /// The order of the static indices that the plans refer to; empty: the scene's own.
    [[nodiscard]] std::span<const std::uint32_t> static_indices() const;
};

/// What the user says about building a method; absent is the method's default.
struct MethodOptions {
    std::optional<std::uint32_t> max_leaf_triangles;  ///< `rhview`: chosen from the costs; else 4096
    double replica_budget = 1.0;                      ///< of `rhview`, times the source's index bytes
    DrawCosts costs;                                  ///< what `rhview` plans by
    std::optional<OcclusionOptions> occlusion;        ///< of `rhview` and `rhview-seed`; absent: asks nothing
    RivalOptions rival;                               ///< of chc, chc++ and nested-grid
    /// Of the scene's time from a frame to the next, at most: what `grid` knows of speeds. 0: unknown.
    double frame_seconds = 0.0;
};

/// What the scene's author placed, in the order of the batches.
std::vector<StaticObject> static_objects(const Scene& scene);

/// What `method` has its octree built with.
OctreeOptions octree_options_of(std::string_view method, const Scene& scene, const MethodOptions& options);

/// Builds what `method` needs; `scene` outlives it. A scene that brings its octree (`baked`) is not built
/// again.
Result<PreparedMethod> prepare_method(std::string_view method, const Scene& scene,
                                      const MethodOptions& options, const BakedOctree* baked = nullptr);

/// The planner of `octree`, `rhview-seed` or `rhview` over an octree that outlives it.
std::unique_ptr<FramePlanner> make_octree_planner(std::string_view method, const RhOctree& octree,
                                                  const MethodOptions& options);

/// The planner of what the picture must equal, whatever the order of the static indices.
std::unique_ptr<FramePlanner> make_reference(const Scene& scene);

}  // namespace rhview::cli
