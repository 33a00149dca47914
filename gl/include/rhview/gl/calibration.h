// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Measures the timing constants of the machine at hand: design, experiment, choice of terms, profile.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "rhview/gl/context.h"
#include "rhview/gl/experiment.h"
#include "rhview/gl/experiment_design.h"
#include "rhview/gl/timer.h"
#include "rhview/timing_model/fit.h"
#include "rhview/timing_model/profile.h"

namespace rhview::gl {

/// Triangles to draw while measuring; the caller owns all of it. The more they are like what will be drawn
/// (vertex format, size and order of triangles), the better the constants predict.
struct CalibrationSubject {
    const Scene* scene = nullptr;
    const SceneBuffers* buffers = nullptr;
    std::span<const std::uint32_t> static_indices{};  ///< the order they were uploaded in; empty: the scene's
    double fov_y_deg = 60.0, near_m = 0.1, far_m = 1000.0;
};

/// How long to measure, and what.
struct CalibrationOptions {
    int frames = 150;                ///< design points, spread over the subjects
    int rounds = 3;                  ///< times that each is timed
    double longest_s = 14.0;         ///< of timing; the first round is always whole
    double largest_frame_ms = 50.0;  ///< V goes as high as the machine draws in that time
    std::uint32_t seed = 1;
    ClipDepth clip_depth = ClipDepth::NegativeOneToOne;
    std::function<void(int done, int total)> progress{};
};

/// The profile, and all that it was concluded from.
struct Calibration {
    TimingProfile profile;  ///< no date
    Selection selection;    ///< every candidate model with its error
    /// Of the time until the last call returned: what the CPU pays, c0 + c1·V + c3·N. Absent where that
    /// could not be fitted.
    std::optional<Fit> submission;
    std::vector<FrameTiming> timings;
    TimerCheck timer;
    double ns_per_index_probed = 0.0;
    double seconds = 0.0;
};

/// Times frames of the subjects and fits their price on the wall clock, since that is what a frame takes; a
/// GPU timer that was checked is recorded beside. The bound target's size is what frames will be drawn at.
/// Errors: the driver's, and those of `select_model`, which name what is wrong with the measurements.
Result<Calibration> calibrate(std::span<const CalibrationSubject> subjects, const DeviceInfo& device,
                              Executor& executor, RenderTarget& target,
                              const CalibrationOptions& options = {});

}  // namespace rhview::gl
