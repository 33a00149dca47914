// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The paper's planner (`rhview-seed`): frustum culling, then completely visible nodes instead of their
/// leaves.
#pragma once

#include "rhview/pipeline/frame_planner.h"
#include "rhview/rhoctree/draw_list.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

class SeedPlanner final : public FramePlanner {
  public:
    /// `octree` outlives the planner.
    explicit SeedPlanner(const RhOctree& octree) : octree_(octree) {}
    explicit SeedPlanner(RhOctree&&) = delete;

    void plan(const FrameInput& input, FramePlan& plan) override;
    [[nodiscard]] Aabb bounds_of(std::uint32_t chosen) const override;

  private:
    const RhOctree& octree_;
    NodeList list_;
    BatchSorter sorter_;
};

/// Fills `plan` with the nodes of `list` and the objects in the frustum: what every planner over an octree
/// ends with.
void finish_octree_plan(const RhOctree& octree, const NodeList& list, const Frustum& frustum,
                        const FrameInput& input, BatchSorter& sorter, FramePlan& plan);

}  // namespace rhview
