// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Objects near each other, so that many small ones can be asked about, and left out, as one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/ids.h"
#include "rhview/frustum/box_hierarchy.h"
#include "rhview/frustum/frustum.h"

namespace rhview {

/// A hierarchy over the objects' boxes that follows them: refitted in every frame, made anew when its leaves
/// have parted too far or many objects were added. Its nodes are the regions.
class ObjectRegions {
  public:
    /// Takes the boxes of a frame, by `ObjectId`. True: regions were made anew, their numbers mean others
    /// now. `per_leaf`, 1 to 64 objects, is heeded when they are. Cost: linear, about 5 ns per object; about
    /// 0.5 µs per object, and memory, where they are made anew.
    bool update(std::span<const Aabb> boxes, std::uint32_t per_leaf);

    [[nodiscard]] std::span<const HierarchyNode> nodes() const { return tree_.nodes(); }
    [[nodiscard]] bool is_leaf(std::uint32_t node) const { return nodes()[node].escape == node + 1; }
    /// Which object stands where.
    [[nodiscard]] std::span<const ObjectId> order() const { return tree_.order(); }
    /// Objects with numbers from here on were added since: they are in no region yet.
    [[nodiscard]] std::size_t object_count() const { return tree_.order().size(); }

    /// Calls `each(ObjectId)` for the objects of `node` that are not outside and whose bit in `alive` is set
    /// (empty: all are), in order. `words` is scratch.
    template <class Each>
    void for_each_in_view(std::uint32_t node, const Frustum& frustum, std::span<const std::uint64_t> alive,
                          std::vector<std::uint64_t>& words, Each each) const {
        find_in_view(node, frustum, words);
        const std::uint32_t first = nodes()[node].first;
        for (std::size_t word = 0; word < words.size(); ++word)
            for (std::uint64_t rest = words[word]; rest != 0; rest &= rest - 1) {
                const ObjectId object = order()[first + 64 * word + lowest_bit(rest)];
                const std::size_t id = index_of(object);
                if (alive.empty() || (alive[id / 64] >> (id % 64) & 1) != 0) each(object);
            }
    }

  private:
    [[nodiscard]] double leaf_area() const;
    void find_in_view(std::uint32_t node, const Frustum& frustum, std::vector<std::uint64_t>& words) const;
    [[nodiscard]] static std::size_t lowest_bit(std::uint64_t word);

    BoxHierarchy tree_;
    double area_when_made_ = 0.0;
    std::uint32_t age_ = 0;  ///< frames since
};

}  // namespace rhview
