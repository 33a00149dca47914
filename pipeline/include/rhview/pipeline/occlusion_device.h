// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What a renderer offers to methods that draw and ask in turns within a frame, and look at the answers
/// before they go on. `FramePlan` is the other way: everything is decided before anything is drawn.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/ids.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// A query under way; valid until its answer is taken, in later frames too.
enum class QueryHandle : std::uint32_t {};

/// Some of the boxes given with it.
struct BoxQuery {
    std::uint32_t first_box = 0;
    std::uint32_t box_count = 0;  ///< at least one

    friend bool operator==(const BoxQuery&, const BoxQuery&) = default;
};

/// Does things in the order of the calls. Answers come in the order of asking: once one is there, those to
/// earlier queries are.
class OcclusionDevice {
  public:
    virtual ~OcclusionDevice() = default;

    /// Draws `ranges` and then `objects`. State is set when the batch changes, so ranges stand by batch.
    virtual void draw(std::span<const DrawRange> ranges, std::span<const ObjectId> objects) = 0;
    /// The same, and asks whether any of it passed the depth test.
    virtual QueryHandle draw_and_ask(std::span<const DrawRange> ranges,
                                     std::span<const ObjectId> objects) = 0;
    /// Asks, for each of `queries`, whether anything inside its boxes could pass the depth test now; what is
    /// not seen would not, to the last bit. Appends a handle each. Boxes that the eye or the near plane
    /// touches are seen. Boxes are in the scene's coordinates.
    virtual void ask(std::span<const BoxQuery> queries, std::span<const Aabb> boxes,
                     std::vector<QueryHandle>& handles) = 0;
    /// Whether the answer is there. Does not wait.
    virtual bool has_answer(QueryHandle query) = 0;
    /// Whether something was seen. Waits where the answer is not there, and counts that.
    virtual bool take_answer(QueryHandle query) = 0;
};

}  // namespace rhview
