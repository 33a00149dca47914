// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What to draw in one frame, as plain data: execute it with any renderer, record it, replay it, test it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/ids.h"
#include "rhview/occlusion_queries/query.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// Is anything seen of `query_boxes` [first_box, first_box + box_count), against the depth of what was drawn
/// at once?
struct PlannedQuery {
    std::uint64_t ticket = 0;  ///< comes back with the answer
    std::uint32_t first_box = 0;
    std::uint32_t box_count = 0;
    QueryWay way = QueryWay::HardwareQuery;
    bool counts_samples = false;  ///< hardware queries only

    friend bool operator==(const PlannedQuery&, const PlannedQuery&) = default;
};

/// Drawn if its query sees something, or if the device does not know.
struct ConditionalRange {
    DrawRange range;
    std::uint32_t query = 0;  ///< into `FramePlan::queries`

    friend bool operator==(const ConditionalRange&, const ConditionalRange&) = default;
};

/// An object that is drawn if its query sees something, or if the device does not know.
struct ConditionalObject {
    ObjectId object{};
    std::uint32_t query = 0;
    std::uint8_t level = 0;  ///< of detail; 0 is all of it

    friend bool operator==(const ConditionalObject&, const ConditionalObject&) = default;
};

/// A query that counts the samples of one object's box, and of nothing else.
struct CountedObject {
    ObjectId object{};
    std::uint32_t query = 0;

    friend bool operator==(const CountedObject&, const CountedObject&) = default;
};

/// What occlusion culling did with the frame, by its model.
struct OcclusionSummary {
    std::uint64_t candidates = 0;  ///< nodes and objects in the frustum that were decided about
    double query_ns = 0.0;         ///< what asking costs
    double exploration_ns = 0.0;   ///< part of it, spent to learn
    double saved_ns = 0.0;         ///< expected, against drawing all candidates, less `query_ns`
};

/// Draw `opaque` and `objects`, ask `queries` against that depth, draw `conditional` and
/// `conditional_objects`; send the answers to the planner (`FramePlanner::absorb`), whenever they come.
struct FramePlan {
    /// Static triangles: one draw call each. Those of a batch follow one another, so that state is set once;
    /// `rhview` draws what is near first (`draw_order.h`), and comes to a batch again at another distance.
    std::vector<DrawRange> opaque;
    /// Dynamic objects and static instances to draw whole: by `FrameInput::object_groups`, level and id, so
    /// that what can share an instanced call stands together.
    std::vector<ObjectId> objects;
    /// Of detail, by place in `objects`; empty: all at level 0, all of it.
    std::vector<std::uint8_t> object_levels;
    /// Boxes of the queries, in the scene's coordinates. Their faces may lie on what they hold, to the last
    /// bit: who draws them widens them by what its rounding may move.
    std::vector<Aabb> query_boxes;
    std::vector<PlannedQuery> queries;
    std::vector<ConditionalRange> conditional;           ///< by batch, then by place
    std::vector<ConditionalObject> conditional_objects;  ///< by group, level, query and id
    std::vector<CountedObject> counted_objects;          ///< in no order: for `SeenFragments`
    /// What the planner chose, by its own ids (`FramePlanner::bounds_of`): for pictures and statistics.
    std::vector<std::uint32_t> chosen;
    std::uint64_t nodes_visited = 0;
    std::optional<OcclusionSummary> occlusion;  ///< absent: the planner knows no queries
    /// What the draws of `opaque` and `conditional` and the queries cost by the planner's model, without the
    /// objects; absent where it has none.
    std::optional<double> predicted_ns;

    /// The level of `objects[i]`.
    [[nodiscard]] std::uint8_t level_of_object(std::size_t i) const {
        return object_levels.empty() ? std::uint8_t{0} : object_levels[i];
    }
    /// Empties the plan and keeps its memory.
    void clear();
};

/// FNV-1a (64 bits) over what is drawn, in order. Equal plans have equal hashes on every machine.
std::uint64_t plan_hash(const FramePlan& plan, std::uint64_t seed = 0xcbf29ce484222325ull);

/// Puts the objects of a plan in the order that it promises. Reuse it: no allocation after warm-up.
class ObjectSorter {
  public:
    /// `groups` by `ObjectId`; an object beyond the end is of group 0. Cost: linear in objects and largest
    /// group.
    void sort(std::span<const std::uint32_t> groups, FramePlan& plan);
    /// Of its objects that are drawn at once alone.
    void sort_at_once(std::span<const std::uint32_t> groups, FramePlan& plan);
    /// The same order, but for levels before queries where these were chosen late: of places in `objects`.
    void sort_places(std::span<const std::uint32_t> groups, std::span<const ConditionalObject> objects,
                     std::vector<std::uint32_t>& places);

  private:
    template <class Object, class GroupOf, class LevelOf>
    void sort_by_group(std::vector<Object>& objects, std::vector<Object>& scratch, GroupOf group_of,
                       LevelOf level_of);

    struct AtOnce {
        ObjectId object{};
        std::uint8_t level = 0;
    };
    std::vector<AtOnce> at_once_, at_once_scratch_;
    std::vector<ConditionalObject> conditional_scratch_;
    std::vector<std::uint32_t> places_scratch_;
    std::vector<std::size_t> offset_;
};

/// Stable counting sort of draw ranges by batch. Reuse it: no allocation after warm-up.
class BatchSorter {
  public:
    /// Every range's batch is below `batch_count`. Cost: linear.
    void sort(std::vector<DrawRange>& ranges, std::size_t batch_count);

  private:
    std::vector<DrawRange> sorted_;
    std::vector<std::size_t> offset_;
};

/// Both, for planners.
struct PlanSorter {
    BatchSorter ranges;
    ObjectSorter objects;
};

}  // namespace rhview
