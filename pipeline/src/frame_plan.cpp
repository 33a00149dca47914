// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/frame_plan.h"

#include <algorithm>
#include <utility>

namespace rhview {
namespace {

// Fowler, Noll & Vo, FNV-1a: bytes in little-endian order whatever the machine's.
void hash_word(std::uint64_t& hash, std::uint32_t word) {
    for (int byte = 0; byte < 4; ++byte) {
        hash ^= (word >> (8 * byte)) & 0xffu;
        hash *= 0x100000001b3ull;
    }
}

std::uint32_t group_of(std::span<const std::uint32_t> groups, ObjectId object) {
    return index_of(object) < groups.size() ? groups[index_of(object)] : 0u;
}

}  // namespace

void FramePlan::clear() {
    opaque.clear();
    objects.clear();
    object_levels.clear();
    query_boxes.clear();
    queries.clear();
    conditional.clear();
    conditional_objects.clear();
    counted_objects.clear();
    chosen.clear();
    nodes_visited = 0;
    occlusion.reset();
    predicted_ns.reset();
}

std::uint64_t plan_hash(const FramePlan& plan, std::uint64_t seed) {
    std::uint64_t hash = seed;
    hash_word(hash, static_cast<std::uint32_t>(plan.opaque.size()));
    for (const DrawRange& range : plan.opaque) {
        hash_word(hash, static_cast<std::uint32_t>(range.batch));
        hash_word(hash, range.first_index);
        hash_word(hash, range.index_count);
    }
    for (const ObjectId object : plan.objects) hash_word(hash, static_cast<std::uint32_t>(object));
    for (const std::uint8_t level : plan.object_levels) hash_word(hash, level);
    for (const PlannedQuery& query : plan.queries) {
        hash_word(hash, query.first_box);
        hash_word(hash, query.box_count);
        hash_word(hash, static_cast<std::uint32_t>(query.way));
    }
    for (const ConditionalRange& conditional : plan.conditional) {
        hash_word(hash, static_cast<std::uint32_t>(conditional.range.batch));
        hash_word(hash, conditional.range.first_index);
        hash_word(hash, conditional.range.index_count);
        hash_word(hash, conditional.query);
    }
    for (const ConditionalObject& conditional : plan.conditional_objects) {
        hash_word(hash, static_cast<std::uint32_t>(conditional.object));
        // Queries are fewer than 2^24.
        hash_word(hash, conditional.query ^ std::uint32_t{conditional.level} << 24);
    }
    return hash;
}

/// Two stable counting sorts, by level and by group: what comes by id (and query) stays so within.
template <class Object, class GroupOf, class LevelOf>
void ObjectSorter::sort_by_group(std::vector<Object>& objects, std::vector<Object>& scratch, GroupOf group_of,
                                 LevelOf level_of) {
    const auto sort_by = [&](std::size_t keys, const auto& key_of) {
        offset_.assign(keys, 0);
        for (const Object& object : objects) ++offset_[key_of(object)];
        std::size_t sum = 0;
        for (std::size_t& count : offset_) sum += std::exchange(count, sum);
        scratch.resize(objects.size());
        for (const Object& object : objects) scratch[offset_[key_of(object)]++] = object;
        objects.swap(scratch);
    };
    std::size_t levels = 0, groups = 0;
    for (const Object& object : objects) {
        levels = std::max<std::size_t>(levels, level_of(object));
        groups = std::max<std::size_t>(groups, group_of(object));
    }
    if (levels > 0) sort_by(levels + 1, level_of);
    if (groups > 0) sort_by(groups + 1, group_of);
}

void ObjectSorter::sort_at_once(std::span<const std::uint32_t> groups, FramePlan& plan) {
    at_once_.clear();
    for (std::size_t i = 0; i < plan.objects.size(); ++i)
        at_once_.push_back({plan.objects[i], plan.level_of_object(i)});
    sort_by_group(
        at_once_, at_once_scratch_, [&](const AtOnce& object) { return group_of(groups, object.object); },
        [](const AtOnce& object) { return object.level; });
    for (std::size_t i = 0; i < at_once_.size(); ++i) plan.objects[i] = at_once_[i].object;
    for (std::size_t i = 0; i < plan.object_levels.size(); ++i) plan.object_levels[i] = at_once_[i].level;
}

void ObjectSorter::sort(std::span<const std::uint32_t> groups, FramePlan& plan) {
    sort_at_once(groups, plan);
    sort_by_group(
        plan.conditional_objects, conditional_scratch_,
        [&](const ConditionalObject& object) { return group_of(groups, object.object); },
        [](const ConditionalObject& object) { return object.level; });
}

void ObjectSorter::sort_places(std::span<const std::uint32_t> groups,
                               std::span<const ConditionalObject> objects,
                               std::vector<std::uint32_t>& places) {
    sort_by_group(
        places, places_scratch_, [&](std::uint32_t place) { return group_of(groups, objects[place].object); },
        [&](std::uint32_t place) { return objects[place].level; });
}

void BatchSorter::sort(std::vector<DrawRange>& ranges, std::size_t batch_count) {
    if (batch_count < 2) return;
    offset_.assign(batch_count, 0);
    for (const DrawRange& range : ranges) ++offset_[index_of(range.batch)];
    std::size_t sum = 0;
    for (std::size_t& count : offset_) sum += std::exchange(count, sum);
    sorted_.resize(ranges.size());
    for (const DrawRange& range : ranges) sorted_[offset_[index_of(range.batch)]++] = range;
    ranges.swap(sorted_);
}

}  // namespace rhview
