// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "rhview/baselines/cull_tree.h"
#include "rhview/frustum/frustum.h"

namespace rhview {

/// The nodes of a frame that are still to be looked at, nearest box first, ties by id.
class FrontToBack {
  public:
    struct Entry {
        float distance = 0.0f;  ///< squared, from the eye to the box
        std::uint32_t node = 0;
        PlaneMask mask = 0;  ///< planes that the node's parent crosses
    };
    enum class Place {
        Outside,
        AtEye,  ///< holds the eye or touches the near plane: a query would see it, or nothing at all
        InSight,
    };

    void begin(const CullTree& tree, const Frustum& frustum);
    void push(std::uint32_t node, PlaneMask mask);
    void push_children(const Entry& entry);
    [[nodiscard]] bool empty() const { return heap_.empty(); }
    Entry pop();
    /// Where the entry's box is; leaves in `entry.mask` the planes that it crosses.
    Place place(Entry& entry) const;

  private:
    [[nodiscard]] bool is_at_eye(const Aabb& box) const;

    const CullTree* tree_ = nullptr;
    const Frustum* frustum_ = nullptr;
    glm::vec3 eye_{0.0f};
    std::vector<Entry> heap_;
};

}  // namespace rhview
