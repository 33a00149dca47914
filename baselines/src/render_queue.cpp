// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "render_queue.h"

#include <algorithm>

#include "rhview/base/assert.h"

namespace rhview {

void RenderQueue::add_range(const DrawRange& range, std::uint32_t leaf) {
    ranges_.push_back({range, static_cast<std::uint32_t>(ranges_.size()), leaf});
}

void RenderQueue::add(std::span<const DrawRange> ranges, std::span<const ObjectId> objects) {
    for (const DrawRange& range : ranges) add_range(range, kNotAsked);
    objects_.insert(objects_.end(), objects.begin(), objects.end());
}

void RenderQueue::add_asked(std::uint32_t leaf, std::span<const DrawRange> ranges,
                            std::span<const ObjectId> objects) {
    RHVIEW_ASSERT(ranges.size() + objects.size() == 1);
    for (const DrawRange& range : ranges) add_range(range, leaf);
    for (const ObjectId object : objects) asked_objects_.push_back({object, leaf});
}

void RenderQueue::sort(std::span<const std::uint32_t> groups) {
    std::ranges::sort(ranges_, [](const Queued& a, const Queued& b) {
        return a.range.batch != b.range.batch ? a.range.batch < b.range.batch : a.number < b.number;
    });
    const auto group_of = [&](ObjectId object) {
        return index_of(object) < groups.size() ? groups[index_of(object)] : 0;
    };
    std::ranges::sort(objects_, [&](ObjectId a, ObjectId b) {
        return group_of(a) != group_of(b) ? group_of(a) < group_of(b) : a < b;
    });
    sorted_.clear();
    for (const Queued& queued : ranges_) sorted_.push_back(queued.range);
}

std::size_t RenderQueue::end_of_run(std::size_t first) const {
    std::size_t end = first + 1;
    if (ranges_[first].leaf != kNotAsked) return end;
    while (end < ranges_.size() && ranges_[end].leaf == kNotAsked) ++end;
    return end;
}

void RenderQueue::clear() {
    ranges_.clear();
    objects_.clear();
    asked_objects_.clear();
}

}  // namespace rhview
