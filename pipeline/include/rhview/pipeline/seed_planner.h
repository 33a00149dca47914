// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The paper's planner (`rhview-seed`): frustum culling, then completely visible nodes instead of their
/// leaves; dynamic objects behind occlusion queries once they take too long.
#pragma once

#include <optional>

#include "rhview/pipeline/frame_planner.h"
#include "rhview/pipeline/node_visibility.h"
#include "rhview/rhoctree/draw_list.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// The rules of the paper that rhview grew out of, for comparison.
class SeedPlanner final : public FramePlanner {
  public:
    /// `octree` outlives the planner.
    explicit SeedPlanner(const RhOctree& octree) : octree_(octree) {}
    explicit SeedPlanner(RhOctree&&) = delete;
    /// With `OcclusionPolicy::Paper`, all dynamic objects in the frustum are asked about when drawing them
    /// would take more than `paper_budget_ns` by `costs`; the octree, never asked about, is what hides them.
    SeedPlanner(const RhOctree& octree, const DrawCosts& costs, const OcclusionOptions& occlusion);

    void absorb(std::span<const QueryAnswer> answers) override;
    void plan(const FrameInput& input, FramePlan& plan) override;
    [[nodiscard]] Aabb bounds_of(std::uint32_t chosen) const override;

  private:
    const RhOctree& octree_;
    NodeList list_;
    PlanSorter sorter_;
    DrawCosts costs_;
    std::optional<NodeVisibility> objects_;  ///< of the dynamic objects alone
};

/// Fills `plan` with the nodes of `list` and the objects in the frustum: what every planner over an octree
/// ends with.
void finish_octree_plan(const RhOctree& octree, const NodeList& list, const Frustum& frustum,
                        const FrameInput& input, PlanSorter& sorter, FramePlan& plan);

}  // namespace rhview
