// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Method `none`: the whole scene, one draw call per batch and per object. What the picture must
/// equal.
#pragma once

#include <vector>

#include "rhview/pipeline/frame_planner.h"

namespace rhview {

/// Every batch whole and every object, wherever the camera looks: what others are compared with.
class DrawEverything final : public FramePlanner {
  public:
    /// Batch i of the index buffer has `batch_index_counts[i]` indices, one batch after the other.
    /// `scene_bounds` is what `bounds_of` answers.
    DrawEverything(std::span<const std::uint32_t> batch_index_counts, const Aabb& scene_bounds);

    void plan(const FrameInput& input, FramePlan& plan) override;
    [[nodiscard]] Aabb bounds_of(std::uint32_t chosen) const override;

  private:
    std::vector<DrawRange> batches_;
    Aabb bounds_;
    ObjectSorter sorter_;
};

}  // namespace rhview
