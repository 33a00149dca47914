// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <span>

#include "rhview/gl/executor.h"
#include "rhview/gl/line_drawer.h"
#include "rhview/pipeline/frame_planner.h"

namespace rhview::cli {

/// A plan, and what is known about it. Spans and references are the caller's.
struct PicturedPlan {
    const FramePlan& everything;  ///< for the same buffers
    const FramePlan& plan;
    std::span<const QueryAnswer> answers;  ///< to its queries; what has none counts as seen
    /// What it must show: the rest of its base ranges are bridged gaps. Empty: nothing is known of gaps.
    std::span<const DrawRange> to_show;
    std::function<Aabb(std::uint32_t)> bounds_of;  ///< of what it chose
    const gl::SceneBuffers& buffers;
    Aabb bounds;   ///< of the scene, relative to the buffers' origin
    View culling;  ///< who it was made for
    std::span<const glm::dmat4> placements;
};

/// Which of the plan's parts are told apart.
struct PlanMarks {
    bool rest = true;  ///< what is not drawn, in grey
    bool gaps = true;
    bool boxes = true;  ///< asked about, by answer; of a plan that asks nothing, the chosen nodes
    bool frustum = true;
};

/// What a plan draws, in false colours: each draw call in one of its own (from the base order yellow to red,
/// from replicas blue to green), bridged gaps violet, the rest grey; boxes that were asked about blue where
/// nothing was seen, green where something was; chosen nodes blue; the frustum red. Objects by level of
/// detail, the finest red, coarser ones over yellow, green and blue to violet.
class PlanPicture {
  public:
    static Result<PlanPicture> create();

    /// Draws into the bound framebuffer, whose depth is clear, as `from` sees it. A call per range and more:
    /// for people, not for measurements.
    void draw(const PicturedPlan& pictured, const View& from, const PlanMarks& marks, gl::Executor& executor);

  private:
    explicit PlanPicture(gl::LineDrawer lines) : lines_(std::move(lines)) {}

    void draw_opaque(const PicturedPlan& pictured, const View& from, bool gaps, gl::Executor& executor) const;
    void draw_conditional(const PicturedPlan& pictured, const View& from, gl::Executor& executor) const;
    void draw_objects(const PicturedPlan& pictured, const View& from, gl::Executor& executor) const;
    void draw_boxes(const PicturedPlan& pictured, const View& from);

    gl::LineDrawer lines_;
};

}  // namespace rhview::cli
