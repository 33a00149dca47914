// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What culling methods look like that draw, ask and look at the answers within one frame.
#pragma once

#include <vector>

#include "rhview/occlusion_queries/query.h"
#include "rhview/pipeline/frame_plan.h"
#include "rhview/pipeline/frame_planner.h"
#include "rhview/pipeline/occlusion_device.h"

namespace rhview {

/// What a frame did, for hashes, pictures and statistics. `plan.opaque` and `plan.objects` were drawn, in
/// that order; `plan.queries` were asked with boxes, by tickets that stand once in `answers` where the answer
/// was looked at. Executing the plan draws the same picture.
struct DrawnFrame {
    FramePlan plan;
    std::vector<QueryAnswer> answers;
    std::uint64_t geometry_queries = 0;  ///< asked with what was drawn anyway
    std::uint64_t hidden_queries = 0;    ///< answers that nothing was seen

    /// Empties it and keeps its memory.
    void clear();
};

/// One per view. What is not drawn was outside or was proved hidden by a query of the same frame, so no pixel
/// is missing. What is drawn depends on what the device answered, and on when.
class InteractiveMethod {
  public:
    virtual ~InteractiveMethod() = default;
    /// Draws a frame. Answers that nothing depends on may be left to the next frame: always the same device.
    virtual void draw(const FrameInput& input, OcclusionDevice& device, DrawnFrame& drawn) = 0;
    /// The box of an entry of `FramePlan::chosen`: of what was drawn.
    [[nodiscard]] virtual Aabb bounds_of(std::uint32_t chosen) const = 0;
};

}  // namespace rhview
