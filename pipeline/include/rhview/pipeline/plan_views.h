// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Several views of one frame, planned in one call: main camera, shadow cascades, reflections, two eyes.
#pragma once

#include <span>

#include "rhview/base/workers.h"
#include "rhview/pipeline/frame_planner.h"

namespace rhview {

/// A view to plan: `planner->plan(*input, *plan)`. None of the three belongs to another view of the call.
struct ViewToPlan {
    FramePlanner* planner = nullptr;
    const FrameInput* input = nullptr;
    FramePlan* plan = nullptr;
};

/// Plans each of `views`; the plans are those of planning them in turn, on any threads. Views share octree,
/// scene and object boxes, which nothing changes meanwhile. Cost: that of the views, spread over the threads
/// of `workers`; on the calling thread alone it allocates nothing beyond what the planners do.
void plan_views(std::span<const ViewToPlan> views, const Workers& workers = {});

}  // namespace rhview
