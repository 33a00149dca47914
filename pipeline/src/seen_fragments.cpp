// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/seen_fragments.h"

#include <algorithm>

namespace rhview {

void SeenFragments::expect(const FramePlan& plan) {
    ++plan_;
    std::erase_if(on_the_way_, [&](const OnTheWay& query) { return plan_ - query.plan > kLostAfter; });
    for (const CountedObject& counted : plan.counted_objects)
        on_the_way_.push_back({plan.queries[counted.query].ticket, counted.object, plan_});
    std::ranges::sort(on_the_way_, {}, &OnTheWay::ticket);
}

void SeenFragments::absorb(std::span<const QueryAnswer> answers) {
    bool any = false;
    for (const QueryAnswer& answer : answers) {
        const auto query = std::ranges::lower_bound(on_the_way_, answer.ticket, {}, &OnTheWay::ticket);
        if (query == on_the_way_.end() || query->ticket != answer.ticket || query->plan == 0) continue;
        const std::size_t object = index_of(query->object);
        if (object >= samples_.size()) samples_.resize(object + 1, 0);
        // A query that was given up is answered as visible, without a number.
        samples_[object] = answer.visible ? answer.samples : 0;
        query->plan = 0;
        any = true;
    }
    if (any) std::erase_if(on_the_way_, [](const OnTheWay& query) { return query.plan == 0; });
}

void SeenFragments::forget(ObjectId object) {
    if (index_of(object) < samples_.size()) samples_[index_of(object)] = 0;
    std::erase_if(on_the_way_, [&](const OnTheWay& query) { return query.object == object; });
}

std::optional<std::uint64_t> SeenFragments::of(ObjectId object) const {
    const std::size_t i = index_of(object);
    if (i >= samples_.size() || samples_[i] == 0) return std::nullopt;
    return samples_[i];
}

}  // namespace rhview
