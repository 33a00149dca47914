// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include "rhview/pipeline/object_levels.h"
#include "rhview/timing_model/frame_budget.h"
#include "walk_report.h"

namespace rhview::cli {

/// What the objects of a frame may cost so that the whole frame holds a budget: what the rest of the frame is
/// predicted to take is taken off, and predictions are reckoned to be as wrong as they were.
///
/// What is not known before a frame is drawn is taken from the frame before: planning time, fragments, and
/// which share of triangles is left after clipping.
class WalkBudget {
  public:
    /// `residuals`: of the profile.
    WalkBudget(double budget_ms, const std::optional<ResidualPercentiles>& residuals);

    /// Sets what the objects of `plan` may cost, by the constants of now.
    void limit(const FramePlan& plan, const TimingProfile& profile, LevelOptions& options);
    /// After the levels were chosen: what the frame will take, and whether that holds the budget.
    void decide(const LevelSummary& chosen, FrameRecord& record);
    /// After the frame was drawn; `record` is complete. The first frame of all, which compiles shaders and
    /// touches memory for the first time, is not counted.
    void observe(const FrameRecord& record);

  private:
    static constexpr double kPrimitivesPerIndex = 1.0 / 3.0;  ///< if all are left

    double budget_ns_;
    FrameBudget budget_;
    std::optional<FrameRecord> last_;
    double rest_ns_ = 0.0;  ///< of this frame, besides the objects
};

}  // namespace rhview::cli
