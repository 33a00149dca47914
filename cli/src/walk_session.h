// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>

#include "method.h"
#include "plan_picture.h"
#include "rhview/base/result.h"
#include "rhview/gl/render_target.h"
#include "verbs.h"
#include "walk_ground.h"
#include "walk_report.h"

namespace rhview::cli {

/// Who looks at a frame, and when it is.
struct FrameCameras {
    View culling;  ///< decides what is drawn
    View render;   ///< decides how it looks
    double time_s = 0.0;
};

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

    // For one who flies freely, instead of `walk`:

    /// Draws and times one frame into `target()`; the times of frames never fall between restarts.
    FrameRecord draw(const FrameCameras& cameras);
    /// Forgets all frames, and plans by what the options and the ground's constants say now; the octree stays
    /// as it was built. An error, without a change, where the options do not go together.
    Status restart();
    /// Another size of the picture; `restart` follows before the next frame.
    Status resize(PictureSize size);

    [[nodiscard]] const PreparedMethod& method() const;
    /// Of the last frame.
    [[nodiscard]] const FramePlan& plan() const;
    /// Of the last frame as it was planned: which late objects got a level depends on which answers came in
    /// time.
    [[nodiscard]] std::uint64_t hash_of_plan(std::uint64_t seed);
    [[nodiscard]] gl::RenderTarget& target();
    [[nodiscard]] ClipDepth clip_depth() const;
    /// What a picture of the last frame's plan is made of. `culling` is who it was planned for; objects are
    /// where they are at `time_s`. Valid until the next frame.
    [[nodiscard]] PicturedPlan pictured(const View& culling, double time_s);
    void picture(PlanPicture& picture, const PicturedPlan& plan, const View& from, const PlanMarks& marks);

  private:
    class Impl;
    explicit WalkSession(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

}  // namespace rhview::cli
