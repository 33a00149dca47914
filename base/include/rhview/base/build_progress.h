// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// How far a long build is, and whether it is to go on.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>

#include "rhview/base/result.h"

namespace rhview {

/// Tells the caller of a build how far it is, and the build whether to go on. `advance` and `stopped` may be
/// called by any thread.
class BuildProgress {
  public:
    /// The callback stays as long as this does; an empty one is never asked.
    explicit BuildProgress(const std::function<bool(double)>& callback) : callback_(callback) {}

    /// What follows takes `share` of the build and `steps` steps. Not while another phase is advancing.
    void begin_phase(double share, std::size_t steps);

    /// `steps` more are done. The callback is asked by one thread at a time; who finds it busy goes on.
    void advance(std::size_t steps);

    [[nodiscard]] bool stopped() const { return stopped_.load(std::memory_order_relaxed); }
    static Error stopped_error() { return Error{"the build was stopped before it was done"}; }

  private:
    const std::function<bool(double)>& callback_;
    std::mutex asking_;
    double told_ = -1.0;
    double begin_ = 0.0;  ///< of the phase
    double share_ = 0.0;
    std::size_t steps_ = 1;
    std::atomic<std::size_t> done_ = 0;
    std::atomic<bool> stopped_ = false;
};

}  // namespace rhview
