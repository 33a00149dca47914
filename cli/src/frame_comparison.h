// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "frame_pictures.h"
#include "method.h"
#include "reveal_delays.h"
#include "rhview/gl/image_difference.h"
#include "rhview/gl/item_buffer.h"
#include "rhview/gl/render_target.h"
#include "verbs.h"
#include "walk_ground.h"
#include "walk_levels.h"
#include "walk_objects.h"
#include "walk_report.h"

namespace rhview::cli {

/// What walks draw frames with; all of it outlives who refers to it.
struct WalkStage {
    const WalkOptions& options;
    const WalkGround& ground;
    const PreparedMethod& method;
    std::optional<gl::RenderTarget>& target;
    gl::Executor& executor;
    const gl::SceneBuffers& buffers;
    WalkObjects& objects;
    std::optional<WalkLevels>& levels;
    ClipDepth clip_depth;

    [[nodiscard]] glm::ivec2 viewport() const { return {target->width(), target->height()}; }
    void clear() const;
};

/// The frame just drawn.
struct WalkedFrame {
    int number = 0;
    View culling;  ///< who it was planned for
    View view;
    double time_s = 0.0;
    const FramePlan& plan;
    std::span<const QueryAnswer> answers;
};

/// A frame against drawing everything: the oracle of `--check`, the pictures, the visible set, and the error
/// of the picture. Each step may draw over what the target holds.
class FrameComparison {
  public:
    static Result<FrameComparison> create(const WalkStage& stage);

    /// Puts every object where it is and as it would be drawn: before all that follows.
    void place_all(const WalkedFrame& frame);
    /// The indices of the octree's leaves that show a pixel.
    [[nodiscard]] std::uint64_t visible_set_indices(const WalkedFrame& frame);
    /// While the target holds the frame: for `image_error`.
    void keep_picture();
    /// While the target holds the frame: missing pixels and late items enter `record` if `checked`, and if
    /// `pictured` a sheet of pictures is written.
    Status compare(const WalkedFrame& frame, bool checked, bool pictured, FrameRecord& record);
    /// Of the picture kept, against everything at full detail.
    [[nodiscard]] gl::ImageDifference image_error(const WalkedFrame& frame);
    /// What a picture of the plan is made of; valid until the next frame.
    [[nodiscard]] PicturedPlan pictured(const WalkedFrame& frame);
    /// Latent mode, where every frame was checked.
    [[nodiscard]] std::optional<std::vector<double>> reveal_frames() const;

  private:
    explicit FrameComparison(const WalkStage& stage);

    Status prepare();
    void list_leaves();
    void plan_everything(const View& view);
    void draw_everything(const View& view);
    [[nodiscard]] PicturedPlan describe(const WalkedFrame& frame);
    Status save_pictures(const WalkedFrame& frame, gl::Picture culled, std::size_t missing,
                         const FrameRecord& record);

    WalkStage stage_;
    const Scene& scene_;
    Aabb bounds_;
    std::unique_ptr<FramePlanner> reference_;
    std::span<const std::uint8_t> all_levels_;
    FramePlan everything_;
    std::vector<DrawRange> to_show_;
    std::optional<ViewFromAbove> above_;
    std::optional<gl::ItemBuffer> items_;
    std::vector<gl::ItemRange> leaves_;
    std::optional<RevealDelays> delays_;
    std::vector<float> culled_depths_;
    std::vector<float> reference_depths_;
    std::optional<gl::Picture> kept_;
    std::vector<float> kept_depths_;
};

}  // namespace rhview::cli
