// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Method `nested-grid`: our reading of a baseline that Serpa & Rodrigues 2018 name and do not describe, but
/// for its "intensive use of occlusion culling": every cell in sight is asked about, every answer waited for.
#pragma once

#include <cstdint>
#include <memory>

#include "rhview/baselines/cull_tree.h"
#include "rhview/baselines/interactive_method.h"

namespace rhview {

/// The shape of the nested grids.
struct NestedGridOptions {
    std::uint32_t levels = 3;       ///< 1 to 3
    std::uint32_t top_cells = 8;    ///< of the first grid along the scene's longest side; cells are cubes
    std::uint32_t inner_cells = 4;  ///< along each side of a cell that is divided
    std::uint32_t max_triangles = 16384;  ///< of a cell that is not divided, but for the last level
};

/// Each triangle is in one cell, by its centroid; a cell's box is that of its triangles. A leaf is one range
/// per batch. Triangles of a cell keep their order.
OrderedTree make_nested_grid(std::span<const TriangleBatch> batches, const NestedGridOptions& options);

/// Front to back: a query per cell in the frustum that is not empty, waited for; a cell of which something is
/// seen is drawn, or its inner cells are asked about likewise. Nothing is remembered.
class StopAndWait final : public InteractiveMethod {
  public:
    /// For one view. `tree` is of the grids' cells.
    explicit StopAndWait(CullTree tree);
    ~StopAndWait() override;

    void draw(const FrameInput& input, OcclusionDevice& device, DrawnFrame& drawn) override;
    [[nodiscard]] Aabb bounds_of(std::uint32_t chosen) const override;

  private:
    class Frame;
    std::unique_ptr<Frame> frame_;
};

}  // namespace rhview
