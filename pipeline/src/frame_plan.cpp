// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/frame_plan.h"

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

}  // namespace

void FramePlan::clear() {
    opaque.clear();
    objects.clear();
    query_boxes.clear();
    queries.clear();
    conditional.clear();
    conditional_objects.clear();
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
        hash_word(hash, conditional.query);
    }
    return hash;
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
