// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include "rhview/base/view.h"
#include "rhview/scenes/camera_path.h"
#include "verbs.h"

namespace rhview::cli {

/// When along a path the frames of a walk are.
///
/// Without a rate they are spread evenly from the first key to the last: all of the path, however hurried.
/// With one, two frames are 1/rate seconds apart, in stretches evenly spread over the path: the path at the
/// pace that its author meant, in excerpts. From one excerpt to the next the camera jumps.
class WalkPace {
  public:
    /// `path` outlives it.
    WalkPace(const CameraPath& path, const WalkOptions& options);

    [[nodiscard]] double time_of(int frame) const;
    [[nodiscard]] View view_of(int frame, double aspect, ClipDepth clip_depth) const;
    /// The greatest step of time between two frames of an excerpt.
    [[nodiscard]] double longest_step_s() const;

  private:
    [[nodiscard]] double start_of(int excerpt) const;

    const CameraPath& path_;
    int frames_;
    std::optional<double> rate_hz_;
    int excerpts_;
    int excerpt_frames_;
};

/// An error where the path is shorter than what `options` want of it.
Status check_pace(const CameraPath& path, const WalkOptions& options);

}  // namespace rhview::cli
