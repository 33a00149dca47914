// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Counts what only the device sees of a frame: triangles after clipping, fragments shaded, samples that
/// passed the depth test.
#pragma once

#include <array>
#include <cstddef>

#include "rhview/gl/executor.h"
#include "rhview/gl/handle.h"
#include "rhview/timing_model/work.h"

namespace rhview::gl {

/// What the executor counted, as the timing model's work; what only the device counts is 0.
Work work_of(const FrameCounters& counters);

/// `begin` and `end` stand around a frame's drawing; no other pipeline-statistics or occlusion query may be
/// active between them. Needs OpenGL 4.6 or GL_ARB_pipeline_statistics_query: without it, it counts nothing
/// and costs nothing. On llvmpipe the counting costs less than the noise of a frame (within 2 %).
class WorkCounter {
  public:
    WorkCounter();

    [[nodiscard]] bool is_available() const { return available_; }
    /// What is drawn between `begin` and `end` is counted, one frame at a time.
    void begin();
    /// See `begin`.
    void end();
    /// Between them, within a frame and once, nothing is counted and other occlusion queries may be active:
    /// the executor pauses while it draws the boxes of queries (`DrawOptions::counter`).
    void pause();
    /// See `pause`.
    void resume();
    /// Sets primitives, fragments and passed samples of the last counted frame; waits for it.
    void read(Work& work);

  private:
    struct Part {
        Query primitives, fragments, samples;
    };

    void begin_part();
    void end_part();

    bool available_ = false;
    std::array<Part, 2> parts_;  ///< before the pause and after it
    std::size_t used_ = 0;
};

}  // namespace rhview::gl
