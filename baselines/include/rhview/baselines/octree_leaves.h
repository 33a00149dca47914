// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Method `octree`: a plain octree, every leaf that may be visible drawn on its own.
#pragma once

#include "rhview/pipeline/seed_planner.h"

namespace rhview {

/// Frustum culling down to leaves, each drawn by a call of its own per batch.
class OctreeLeaves final : public FramePlanner {
  public:
    /// `octree` outlives the planner.
    explicit OctreeLeaves(const RhOctree& octree) : octree_(octree) {}
    explicit OctreeLeaves(RhOctree&&) = delete;

    void plan(const FrameInput& input, FramePlan& plan) override;
    [[nodiscard]] Aabb bounds_of(std::uint32_t chosen) const override;

  private:
    const RhOctree& octree_;
    NodeList list_;
    PlanSorter sorter_;
};

}  // namespace rhview
