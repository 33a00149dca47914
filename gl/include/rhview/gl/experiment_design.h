// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Which frames to time so that the prices of a timing model can be told apart.
///
/// A factorial design, cycled rather than full: number of indices (V) × number of draw calls (N) × what the
/// camera sees of them × materials × plain or multi-draw × queries in flight. The triangles are a scene's
/// own, cut into blocks of consecutive indices, so that a block is near in space; the camera stands at seeded
/// random places in and above the scene.
#pragma once

#include "rhview/gl/experiment.h"
#include "rhview/scenes/scene.h"

namespace rhview::gl {

/// How many frames, and between which bounds.
struct DesignOptions {
    int frames = 150;
    std::uint32_t seed = 1;
    double fov_y_deg = 60.0, near_m = 0.1, far_m = 1000.0;
    double aspect = 16.0 / 9.0;
    ClipDepth clip_depth = ClipDepth::NegativeOneToOne;
    double most_indices = 4e6;  ///< V of the largest frames, but for whole views; a small scene is repeated
    double most_whole_view_indices = 5e8;  ///< of all frames together that draw all that is in view
    double most_draw_calls = 20000;        ///< N of the largest
    bool multi_draw = true;                ///< a quarter of the frames is submitted as multi-draws
    bool queries = true;                   ///< a quarter of the frames asks 1 … 1,000 queries
};

/// The frames; `static_indices` is the order that the scene was uploaded with, empty for its own. Same input,
/// same design. A scene without static triangles gives frames of its objects. Cost: two passes over
/// the indices.
std::vector<ExperimentFrame> design_experiment(const Scene& scene,
                                               std::span<const std::uint32_t> static_indices,
                                               const DesignOptions& options);

}  // namespace rhview::gl
