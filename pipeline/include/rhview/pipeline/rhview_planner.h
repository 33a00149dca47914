// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The planner `rhview`: frustum, back-face and occlusion culling, and the cheapest draw list of what is
/// left.
#pragma once

#include <optional>

#include "rhview/pipeline/draw_order.h"
#include "rhview/pipeline/frame_planner.h"
#include "rhview/pipeline/node_visibility.h"
#include "rhview/rhoctree/draw_list.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// The planner to use. One per view: it remembers what was seen.
class RhviewPlanner final : public FramePlanner {
  public:
    /// `octree` outlives the planner. `costs` may be others than those it was built for: the list is the
    /// cheapest by these, over the leaves and replicas that are there. Without `occlusion` nothing is asked.
    RhviewPlanner(const RhOctree& octree, const DrawCosts& costs,
                  const std::optional<OcclusionOptions>& occlusion = std::nullopt);
    RhviewPlanner(RhOctree&&, const DrawCosts&,
                  const std::optional<OcclusionOptions>& = std::nullopt) = delete;

    void absorb(std::span<const QueryAnswer> answers) override;
    void plan(const FrameInput& input, FramePlan& plan) override;
    [[nodiscard]] Aabb bounds_of(std::uint32_t chosen) const override;

    [[nodiscard]] const DrawCosts& costs() const { return costs_; }
    /// From the next frame on.
    void set_costs(const DrawCosts& costs) { costs_ = costs; }
    /// What the last frame's static part was made of.
    [[nodiscard]] const DrawList& draw_list() const { return list_; }

  private:
    const RhOctree& octree_;
    DrawCosts costs_;
    std::optional<NodeVisibility> visibility_;
    double last_predicted_ns_ = 0.0;
    DrawListSolver solver_;
    DrawList list_;
    ObjectSorter sorter_;
    DrawOrder order_;
};

}  // namespace rhview
