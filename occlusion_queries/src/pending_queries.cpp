// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "pending_queries.h"

#include <algorithm>

namespace rhview {

PendingQueries::PendingQueries(std::uint32_t lost_after_frames)
    : frames_(std::clamp(lost_after_frames, 1u, 1024u)), current_(frames_.data()) {}

void PendingQueries::reserve(std::size_t candidates) {
    if (candidates <= room_) return;
    room_ = candidates;
    for (Frame& frame : frames_) {
        frame.queries.reserve(room_);
        frame.members.reserve(room_);
    }
}

std::uint64_t PendingQueries::add_query(bool explores, bool nothing_in_front) {
    std::vector<Query>& queries = current_->queries;
    const std::uint32_t first =
        queries.empty() ? 0 : queries.back().first_member + queries.back().member_count;
    const auto count = static_cast<std::uint32_t>(current_->members.size() - first);
    queries.push_back({first, count, false, explores, nothing_in_front});
    return (std::uint64_t{current_->frame} << 32) + queries.size() - 1;
}

bool PendingQueries::take(std::uint64_t ticket, Found& out) {
    const auto frame = static_cast<std::uint32_t>(ticket >> 32);
    const auto number = static_cast<std::uint32_t>(ticket);
    Frame& slot = frames_[frame % frames_.size()];
    if (frame == 0 || slot.frame != frame || number >= slot.queries.size()) return false;
    Query& query = slot.queries[number];
    if (query.answered) return false;
    query.answered = true;
    out = found(slot, query);
    return true;
}

}  // namespace rhview
