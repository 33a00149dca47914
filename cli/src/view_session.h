// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "view_camera.h"
#include "view_command.h"
#include "walk_session.h"

namespace rhview::cli {

/// A scene, flown through and looked at from outside: all of the viewer but its window and panels. Its
/// window's context is current whenever it is used.
class ViewSession {
  public:
    /// Frames of a recording are that far apart: a walk with as many frames has their times to the last bit.
    static constexpr double kStep_s = 1.0 / 64.0;
    /// Frames that plots show.
    static constexpr std::size_t kRemembered = 240;

    static Result<std::unique_ptr<ViewSession>> create(const ViewOptions& options);

    /// Every verb but those that `ViewLoop` runs itself. After an error nothing has changed.
    Status run(const ViewCommand& command);
    void turn(double right_px, double down_px);
    void scale_speed(double factor) { camera_.speed *= factor; }
    /// Moves on by `step_s` with the keys in `held`, plans, draws, and counts. While recording or replaying a
    /// step is `kStep_s`.
    Status draw(std::uint32_t held, double step_s);
    /// Copies what was drawn to the window; a frozen camera's own picture goes into its lower right corner.
    void show();
    Status resize(PictureSize size);

    [[nodiscard]] const WalkOptions& options() const { return stage_->options; }
    [[nodiscard]] const WalkGround& ground() const { return stage_->ground; }
    [[nodiscard]] const PreparedMethod& method() const { return stage_->session->method(); }
    [[nodiscard]] const FramePlan& plan() const { return stage_->session->plan(); }
    /// Oldest first.
    [[nodiscard]] const std::vector<FrameRecord>& history() const { return history_; }
    [[nodiscard]] const FlyCamera& camera() const { return camera_; }
    [[nodiscard]] bool is_frozen() const { return frozen_.has_value(); }
    [[nodiscard]] bool shows_colours() const { return colours_; }
    /// The octree was built for other prices than are set now.
    [[nodiscard]] bool is_stale() const;
    /// Of the recording, so far.
    [[nodiscard]] std::optional<std::size_t> recorded_frames() const;
    /// Frame and number of frames.
    [[nodiscard]] std::optional<std::pair<int, int>> replayed_frames() const;
    /// What was done last, for people.
    [[nodiscard]] const std::string& message() const { return message_; }
    void say(const std::string& sentence);

    PlanMarks marks;

  private:
    /// What is made anew for another scene. Sessions refer to it: it stays where it is.
    struct Stage {
        WalkOptions options;
        WalkGround ground;
        std::optional<WalkSession> session;
        DrawCosts built_for;
    };
    struct Recording {
        std::filesystem::path file;
        CameraPath path;
        std::uint64_t hash = 0;
    };
    struct Replay {
        std::string name;
        CameraPath path;
        int frames = 0;
        int next = 0;
        std::uint64_t hash = 0;
    };

    ViewSession(std::unique_ptr<Stage> stage, PlanPicture picture, gl::RenderTarget outside,
                std::filesystem::path folder);

    static Result<std::unique_ptr<Stage>> make_stage(const WalkOptions& options);
    static Status build(Stage& stage);

    Status change(const WalkOptions& wanted);
    Status set_price(const char* name, double value_ns);
    Status begin_again();
    Status open(const std::string& scene);
    void freeze(bool on);
    void look_from_outside();
    void go_back();
    Status record(const std::string& file);
    Status stop();
    Status finish_recording();
    Status replay(const std::string& file);
    void tell();
    [[nodiscard]] std::string walk_command(const std::filesystem::path& path, int frames,
                                           const std::optional<std::filesystem::path>& profile) const;
    FrameCameras next_cameras(std::uint32_t held, double step_s);
    void remember(const FrameRecord& record);
    [[nodiscard]] View view() const;
    [[nodiscard]] double aspect() const;

    std::unique_ptr<Stage> stage_;
    FlyCamera camera_;
    PlanPicture picture_;
    gl::RenderTarget outside_;
    std::filesystem::path folder_;  ///< where new files go
    double time_s_ = 0.0;
    bool colours_ = false;
    struct Frozen {
        CameraKey key;
        View view;
    };
    std::optional<Frozen> frozen_;
    std::optional<Recording> recording_;
    std::optional<Replay> replay_;
    std::optional<std::filesystem::path> last_recording_;
    std::vector<FrameRecord> history_;
    std::string message_;
};

/// `folder`/`stem`_0001.`ending`, or the first number that is free.
std::filesystem::path new_file(const std::filesystem::path& folder, const std::string& stem,
                               const std::string& ending);

}  // namespace rhview::cli
