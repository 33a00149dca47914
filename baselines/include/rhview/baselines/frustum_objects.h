// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Method `frustum`: every object that the scene's author placed, tested on its own, drawn on its own.
#pragma once

#include <vector>

#include "rhview/frustum/box_batch.h"
#include "rhview/pipeline/frame_planner.h"

namespace rhview {

/// A static object: its part of the index buffer, and the box of its triangles.
struct StaticObject {
    DrawRange range;
    Aabb bounds;
};

/// Each of the author's objects whose box is not outside is drawn, by a call of its own.
class FrustumObjects final : public FramePlanner {
  public:
    /// `objects` stand in the order of their batches.
    explicit FrustumObjects(std::vector<StaticObject> objects);

    void plan(const FrameInput& input, FramePlan& plan) override;
    [[nodiscard]] Aabb bounds_of(std::uint32_t chosen) const override;

  private:
    std::vector<StaticObject> objects_;
    BoxArrays boxes_;
    std::vector<std::uint64_t> visible_;
    ObjectSorter sorter_;
};

}  // namespace rhview
