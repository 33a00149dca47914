// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <span>

#include "rhview/gl/executor.h"
#include "rhview/gl/line_drawer.h"
#include "rhview/gl/render_target.h"
#include "rhview/pipeline/frame_planner.h"

namespace rhview::cli {

/// What was drawn of a scene, seen from above: each draw call in a colour of its own (those from the base
/// order yellow to red, those from replicas blue to green), bridged gaps violet, the rest grey, the boxes of
/// what the planner chose, the frustum.
class ViewFromAbove {
  public:
    static Result<ViewFromAbove> create(int width, int height);

    /// `everything` and `plan` are for the same buffers; `bounds` is the scene's, relative to the buffers'
    /// origin. `to_show` is what `plan` must show: the rest of its base ranges are bridged gaps; empty:
    /// nothing is known of gaps. `bounds_of`: boxes of what the plan's method chose.
    gl::Picture draw(const FramePlan& everything, const FramePlan& plan, std::span<const QueryAnswer> answers,
                     std::span<const DrawRange> to_show, const std::function<Aabb(std::uint32_t)>& bounds_of,
                     const gl::SceneBuffers& buffers, const Aabb& bounds, const View& view,
                     std::span<const glm::dmat4> placements, gl::Executor& executor);

  private:
    ViewFromAbove(gl::RenderTarget target, gl::LineDrawer lines);

    gl::RenderTarget target_;
    gl::LineDrawer lines_;
};

}  // namespace rhview::cli
