// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What to draw in one frame, as plain data: execute it with any renderer, record it, replay it, test it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "rhview/base/ids.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

struct FramePlan {
    /// Static triangles: one draw call each, by batch, so that state is set once per batch.
    std::vector<DrawRange> opaque;
    /// Dynamic objects and static instances to draw whole, by id.
    std::vector<ObjectId> objects;
    /// What the planner chose, by its own ids (`FramePlanner::bounds_of`): for pictures and statistics.
    std::vector<std::uint32_t> chosen;
    std::uint64_t nodes_visited = 0;
    /// What the draws of `opaque` cost by the planner's model, without the objects; absent where it has none.
    std::optional<double> predicted_ns;

    /// Empties the plan and keeps its memory.
    void clear();
};

/// FNV-1a (64 bits) over what is drawn, in order. Equal plans have equal hashes on every machine.
std::uint64_t plan_hash(const FramePlan& plan, std::uint64_t seed = 0xcbf29ce484222325ull);

/// Stable counting sort of draw ranges by batch. Reuse it: no allocation after warm-up.
class BatchSorter {
  public:
    /// Every range's batch is below `batch_count`. Cost: linear.
    void sort(std::vector<DrawRange>& ranges, std::size_t batch_count);

  private:
    std::vector<DrawRange> sorted_;
    std::vector<std::size_t> offset_;
};

}  // namespace rhview
