// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>

#include "rhview/base/result.h"
#include "verbs.h"
#include "walk_ground.h"
#include "walk_report.h"

namespace rhview::cli {

/// One method walking a scene, frame by frame: several sessions over one ground take turns.
class WalkSession {
  public:
    /// Builds what the method needs and copies the scene to the device. `options` and `ground` outlive the
    /// session; the ground's context is current whenever it is used.
    static Result<WalkSession> create(const WalkOptions& options, const WalkGround& ground);
    WalkSession(WalkSession&&) noexcept;
    WalkSession& operator=(WalkSession&&) noexcept;
    ~WalkSession();

    /// Draws the first frame, and records nothing.
    void warm_up();
    /// Draws, times, checks and pictures frame `frame`, and appends its record; frames go in order.
    Status walk(int frame);
    /// After the last frame. An error where OpenGL reported one.
    Status finish();

    [[nodiscard]] const WalkReport& report() const;

  private:
    class Impl;
    explicit WalkSession(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

}  // namespace rhview::cli
