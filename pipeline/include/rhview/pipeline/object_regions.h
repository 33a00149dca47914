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

/// The objects of a region that are not outside the view.
struct RegionInView {
    std::uint32_t region = 0;
    std::uint32_t first = 0;    ///< place of bit 0 in `ObjectRegions::order`
    std::uint64_t objects = 0;  ///< a bit each
};

/// The leaves of a hierarchy over the objects' boxes, which follows them: refitted in every frame, made anew
/// when they have parted too far or many were added.
///
/// Costs measured for 10,000 objects in docs/moving-objects.md.
class ObjectRegions {
  public:
    static constexpr std::uint32_t kMostObjects = 64;

    /// Takes the boxes of a frame, by `ObjectId`. True: regions were made anew, their numbers mean others
    /// now. `objects_per_region`, 1 to `kMostObjects`, is heeded when they are. Cost: linear, about 10 ns per
    /// object; about 0.5 µs and memory where they are made anew.
    bool update(std::span<const Aabb> boxes, std::uint32_t objects_per_region);

    /// Replaces `visible` by the regions with objects that are not outside, in order. `alive`: a bit per
    /// object, others are left out; empty: all are. Cost: as `BoxHierarchy::cull`.
    void cull(const Frustum& frustum, std::span<const std::uint64_t> alive,
              std::vector<RegionInView>& visible) const;

    [[nodiscard]] std::size_t count() const { return region_count_; }
    /// Which object stands where.
    [[nodiscard]] std::span<const ObjectId> order() const { return tree_.order(); }
    /// Objects with numbers from here on were added since: they are in no region yet.
    [[nodiscard]] std::size_t object_count() const { return tree_.order().size(); }

  private:
    [[nodiscard]] double leaf_area() const;

    BoxHierarchy tree_;
    std::vector<std::uint32_t> region_of_node_;
    std::size_t region_count_ = 0;
    std::uint32_t objects_per_region_ = 0;
    double area_when_made_ = 0.0;
    std::uint32_t age_ = 0;  ///< frames since
};

}  // namespace rhview
