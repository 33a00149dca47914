// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Wall-clock and GPU timers. A GPU timer is believed only after it agreed with the wall clock.
#pragma once

#include <chrono>

#include "rhview/base/result.h"
#include "rhview/gl/handle.h"

namespace rhview::gl {

/// Milliseconds since it was made.
class WallTimer {
  public:
    [[nodiscard]] double elapsed_ms() const {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// GL_TIME_ELAPSED around a part of a frame.
class GpuTimer {
  public:
    GpuTimer();
    /// What is submitted between `begin` and `end` is timed. No other timer query is active.
    void begin();
    /// See `begin`.
    void end();
    /// Waits for the answer.
    [[nodiscard]] double read_ms();

  private:
    Query query_;
};

/// Whether the GPU timer measures the whole of a frame, vertex work included: it is asked to time about 20 ms
/// of work that is nearly all vertices, between two `finish`, and must report 80 to 110 % of what the wall
/// clock says (median of five). Mesa's llvmpipe reports a hundredth.
struct TimerCheck {
    double gpu_share = 0.0;  ///< GPU time / wall time
    [[nodiscard]] bool gpu_timer_is_whole() const { return gpu_share >= 0.8 && gpu_share <= 1.1; }
};
/// Times vertex work by both clocks, on the current context.
Result<TimerCheck> check_gpu_timer();

}  // namespace rhview::gl
