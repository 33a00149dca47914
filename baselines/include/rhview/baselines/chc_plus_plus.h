// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Method `chc++`. Source: Mattausch, Bittner & Wimmer, "CHC++: Coherent Hierarchical Culling Revisited",
/// Computer Graphics Forum 27(2), 2008.
#pragma once

#include <cstdint>
#include <memory>

#include "rhview/baselines/cull_tree.h"
#include "rhview/baselines/interactive_method.h"

namespace rhview {

/// What a visible leaf is asked with.
enum class VisibleQuery {
    Geometry,  ///< its triangles as they are drawn, where they are one batch's; else its box
    Box,       ///< its box, after the frame's other queries were asked
};

/// The paper's parameters; where it gives a range the default lies in it.
struct ChcPlusPlusOptions {
    std::uint32_t batch = 50;  ///< previously hidden nodes that are asked about together; paper: 20–80
    std::uint32_t visible_frames = 10;  ///< n_av, for which a visible leaf is taken to stay so; paper: 5–10
    /// p_keep after i hidden answers in a row: certainty − doubt·e^−i.
    double keep_certainty = 0.99;
    double keep_doubt = 0.7;
    TightBounds tight;
    VisibleQuery visible_query = VisibleQuery::Geometry;
    std::uint32_t seed = 1;  ///< of the first waits of leaves that turn visible
};

/// Everything in the paper: queries of hidden nodes are collected and asked in batches, several nodes to a
/// query where they will probably all stay hidden; those of visible leaves fill waiting time; what is drawn
/// waits for the next batch and is sorted by material. Any sample is enough to be visible.
class ChcPlusPlus final : public InteractiveMethod {
  public:
    /// For one view; it remembers what was visible.
    explicit ChcPlusPlus(CullTree tree, const ChcPlusPlusOptions& options = {});
    ~ChcPlusPlus() override;

    void draw(const FrameInput& input, OcclusionDevice& device, DrawnFrame& drawn) override;
    [[nodiscard]] Aabb bounds_of(std::uint32_t chosen) const override;

  private:
    class Frame;
    std::unique_ptr<Frame> frame_;
};

}  // namespace rhview
