// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>

#include "constants.h"
#include "picture_size.h"
#include "progress.h"
#include "reference_frame.h"
#include "rhview/gl/context.h"
#include "scene_source.h"
#include "verbs.h"

namespace rhview::cli {

/// What all methods of one run share: the device, the scene and what drawing costs.
struct WalkGround {
    gl::Context context;
    LoadedScene loaded;
    WantedConstants wanted;
    ChosenConstants chosen;
    PictureSize size;
    double settle_ms = 0.0;           ///< to choose and flatten instances
    std::vector<LodChain> chains;     ///< levels of detail by mesh; empty: nobody wants any, or nothing moves
    std::optional<double> chains_ms;  ///< to build those; absent: they were not built
    std::unique_ptr<ReferenceFrame> reference = std::make_unique<ReferenceFrame>();  ///< the last one drawn
};

/// The size and the constants that `options` ask for.
struct WalkWishes {
    PictureSize size;
    WantedConstants constants;
};
/// An error where `options` name what is unknown, or what does not go together. Takes no time.
Result<WalkWishes> parse_wishes(const WalkOptions& options);

/// Makes a context without a window, loads the scene, measures what is not known. A warning about the
/// constants goes to standard error.
Result<WalkGround> prepare_ground(const WalkOptions& options, WalkWishes wishes, Progress& progress);
/// The same in a context that is there already.
Result<WalkGround> prepare_ground(const WalkOptions& options, WalkWishes wishes, gl::Context context,
                                  Progress& progress);

}  // namespace rhview::cli
