// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Method `chc`: Coherent Hierarchical Culling. Source: Bittner, Wimmer, Piringer & Purgathofer 2004; Wimmer
/// & Bittner, GPU Gems 2, chapter 6, 2005.
#pragma once

#include <memory>

#include "rhview/baselines/cull_tree.h"
#include "rhview/baselines/interactive_method.h"

namespace rhview {

/// Front to back; a query for each previously visible leaf, with its own triangles, and for the largest nodes
/// that were hidden; while answers are outstanding the traversal goes on. A leaf that was visible is drawn
/// once: its answer only says whether it will be next time.
class Chc final : public InteractiveMethod {
  public:
    /// For one view; it remembers what was visible.
    explicit Chc(CullTree tree);
    ~Chc() override;

    void draw(const FrameInput& input, OcclusionDevice& device, DrawnFrame& drawn) override;
    [[nodiscard]] Aabb bounds_of(std::uint32_t chosen) const override;

  private:
    class Frame;
    std::unique_ptr<Frame> frame_;
};

}  // namespace rhview
