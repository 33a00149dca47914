// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

#include "rhview/baselines/interactive_method.h"

namespace rhview {

/// A query, and its ticket in the record; 0 where it was asked with geometry.
struct Asked {
    QueryHandle handle{};
    std::uint64_t ticket = 0;
};

/// Passes on to a device what a method does, and writes it down.
class Recorder {
  public:
    /// Both live as long as the frame.
    void begin(OcclusionDevice& device, DrawnFrame& drawn);

    void draw(std::span<const DrawRange> ranges, std::span<const ObjectId> objects);
    Asked draw_and_ask(std::span<const DrawRange> ranges, std::span<const ObjectId> objects);
    /// Tells which leaf was drawn.
    void chose(std::uint32_t leaf) { drawn_->plan.chosen.push_back(leaf); }

    /// A query of several nodes: `begin_query`, `add_box` as often as needed. `ask` sends all of them and
    /// appends them to `asked`, in order.
    void begin_query();
    void add_box(const Aabb& box);
    void ask(std::vector<Asked>& asked);

    bool has_answer(const Asked& asked) { return device_->has_answer(asked.handle); }
    /// Whether something was seen.
    bool take(const Asked& asked);
    void count_visit() { ++drawn_->plan.nodes_visited; }

  private:
    OcclusionDevice* device_ = nullptr;
    DrawnFrame* drawn_ = nullptr;
    std::uint64_t next_ticket_ = 1;
    std::size_t first_unasked_ = 0;  ///< into the plan's queries
    std::vector<BoxQuery> queries_;
    std::vector<QueryHandle> handles_;
};

}  // namespace rhview
