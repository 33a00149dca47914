// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rhview/occlusion_queries/occlusion_scheduler.h"

namespace rhview {

/// An item that a query asks about, and what was believed of it then, in 32 bits.
class PendingMember {
  public:
    static constexpr std::uint32_t kMostItems = 1u << 30;

    PendingMember(std::uint32_t item, Belief asked_as)
        : bits_(item << 2 | static_cast<std::uint32_t>(asked_as)) {}
    [[nodiscard]] std::uint32_t item() const { return bits_ >> 2; }
    [[nodiscard]] Belief asked_as() const { return static_cast<Belief>(bits_ & 3u); }

  private:
    std::uint32_t bits_;
};

/// Queries whose answers are on their way, by ticket: (frame << 32) + number in the frame. A ring of frames:
/// to look a ticket up is two array accesses, and what is too old falls out.
class PendingQueries {
  public:
    struct Query {
        std::uint32_t first_member = 0;
        std::uint32_t member_count = 0;
        bool answered = false;
        bool explores = false;
        bool nothing_in_front = false;
    };
    struct Found {
        std::uint32_t frame = 0;
        bool explores = false;
        bool nothing_in_front = false;
        std::span<const PendingMember> members;
    };

    explicit PendingQueries(std::uint32_t lost_after_frames);

    /// Room for frames of so many candidates; the only call that allocates.
    void reserve(std::size_t candidates);

    /// Gives up what was asked `lost_after_frames` before `frame`: `give_up(Found)` for each without an
    /// answer.
    template <class GiveUp>
    void begin_frame(std::uint32_t frame, GiveUp&& give_up) {
        Frame& slot = frames_[frame % frames_.size()];
        for (const Query& query : slot.queries) {
            if (!query.answered) give_up(found(slot, query));
        }
        slot.frame = frame;
        slot.queries.clear();
        slot.members.clear();
        current_ = &slot;
    }
    /// A query of this frame, with the members added since the last. `nothing_in_front`: few occluders are
    /// known yet, so that seeing its members says little.
    std::uint64_t add_query(bool explores, bool nothing_in_front);
    void add_member(PendingMember member) { current_->members.push_back(member); }

    /// Marks the query answered. False: nobody asked, or it was answered or given up.
    bool take(std::uint64_t ticket, Found& out);

  private:
    struct Frame {
        std::uint32_t frame = 0;
        std::vector<Query> queries;
        std::vector<PendingMember> members;
    };
    static Found found(const Frame& frame, const Query& query) {
        return {frame.frame,
                query.explores,
                query.nothing_in_front,
                {frame.members.data() + query.first_member, query.member_count}};
    }

    std::vector<Frame> frames_;
    Frame* current_;
    std::size_t room_ = 0;
};

}  // namespace rhview
