// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The experiment behind a timing profile: frames of chosen work, drawn in shuffled order and timed.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "rhview/base/view.h"
#include "rhview/gl/executor.h"
#include "rhview/gl/render_target.h"
#include "rhview/timing_model/work.h"

namespace rhview::gl {

/// One point of the design.
struct ExperimentFrame {
    FramePlan plan;
    View view;
    Submission submission = Submission::Plain;
    /// Boxes asked about after the plan was drawn, an occlusion query each; relative to the scene's origin.
    std::vector<Aabb> queried_boxes;
};

/// What one frame took. A query's box is part of `queries`, not of indices and draw calls.
struct FrameTiming {
    Work work;
    double frame_ns = 0.0;         ///< submission and completion on the wall clock, median over the rounds
    double submit_ns = 0.0;        ///< until the last call returned
    std::optional<double> gpu_ns;  ///< GL_TIME_ELAPSED, where it was checked
    std::vector<double> round_ns;  ///< `frame_ns` of each round that came to it
};

/// How often frames are timed, and for how long in all.
struct ExperimentOptions {
    int rounds = 3;              ///< each frame is timed that often, if time allows
    double longest_s = 14.0;     ///< no new frame is begun after that, once every frame was timed
    bool use_gpu_timer = false;  ///< `check_gpu_timer` said that it is whole
    std::uint32_t shuffle = 1;   ///< seed of the order
    std::function<void(int done, int total)> progress{};
};

/// Draws some frames to warm up, then all of them in rounds, each in another order, into `target`. A frame is
/// timed from an idle device until it is idle again. The first round is whole, however long it takes.
/// OpenGL's state is put back. Errors: the driver's, in a sentence.
Result<std::vector<FrameTiming>> run_experiment(std::span<const ExperimentFrame> frames,
                                                const SceneBuffers& scene, Executor& executor,
                                                RenderTarget& target, const ExperimentOptions& options = {});

/// Whole frames as samples of the timing model; `submission` takes the time until the last call returned.
enum class TimedPart { Frame, Submission };
/// The frames as the fit takes them: their work, and the median time of that part.
std::vector<Sample> samples_of(std::span<const FrameTiming> timings, TimedPart part = TimedPart::Frame);

}  // namespace rhview::gl
