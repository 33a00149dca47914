// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "keep_probability.h"
#include "learned_rates.h"
#include "rhview/occlusion_queries/occlusion_scheduler.h"

namespace rhview {

/// What is known of one item. Frames count from far above 0, which is never.
struct ItemHistory {
    std::uint32_t visited = 0;        ///< frame
    std::uint32_t since = 0;          ///< it is known since: queries of earlier frames say nothing of it
    std::uint32_t answered = 0;       ///< frame of the query whose answer is believed
    std::uint32_t tested = 0;         ///< frame of the last query; set back by the random phase
    std::uint32_t visible_since = 0;  ///< frame
    std::uint32_t merge_after = 0;    ///< frame
    std::uint8_t hidden_answers = 0;  ///< in a row; at least 1 if hidden; on trial: of its parts
    std::uint8_t merge_failures = 0;  ///< in a row
    Belief belief = Belief::Unknown;
    bool ask_alone = false;       ///< its last query, shared with others, saw something
    bool turned_visible = false;  ///< it was asked about as hidden last, and seen
    bool on_trial = false;        ///< asked about as one beside its parts; `hidden_answers` are theirs
};

/// A query's word on one of its members.
struct MemberAnswer {
    std::uint32_t item = 0;
    std::uint32_t asked_frame = 0;
    Belief asked_as = Belief::Unknown;  ///< what was believed then
    bool visible = true;
    bool nothing_in_front = false;  ///< it was asked in a cold frame, before occluders were known
    std::uint32_t members = 1;      ///< of the query
    bool learnt = true;             ///< false: given up, which says nothing about the scene
};

/// The histories of all items, and what they teach about items of their kind. No call allocates but `resize`.
class ItemHistories {
  public:
    explicit ItemHistories(const OcclusionSettings& settings);

    void resize(std::size_t count) { items_.resize(count); }
    [[nodiscard]] std::size_t size() const { return items_.size(); }
    ItemHistory& operator[](std::uint32_t item) { return items_[item]; }
    const ItemHistory& operator[](std::uint32_t item) const { return items_[item]; }

    void begin_frame();
    [[nodiscard]] std::uint32_t frame() const { return frame_; }
    /// Items believed hidden or not known among this frame's visits.
    [[nodiscard]] std::uint32_t doubtful() const { return doubtful_; }

    Belief visit(std::uint32_t item, Belief otherwise);
    bool may_try(std::uint32_t item, double p_hidden);
    void begin_trial(std::uint32_t item);
    void answer(const MemberAnswer& answer);
    /// It is drawn and cannot be asked about: the eye is in it.
    void see(std::uint32_t item);

    [[nodiscard]] double p_hidden(const ItemHistory& item) const {
        if (item.belief == Belief::Hidden) return keep_(item.hidden_answers);
        return item.belief == Belief::Unknown ? p_unknown_ : p_visible_hidden(item);
    }
    [[nodiscard]] double p_unknown() const { return p_unknown_; }
    [[nodiscard]] const KeepProbability& keep() const { return keep_; }
    /// Frames in which an item seen for `visible_frames` turns hidden, on average: that of all, and the more
    /// the longer it was seen.
    [[nodiscard]] double turn_frames(double visible_frames) const { return turn_frames_ + visible_frames; }

  private:
    /// Later than the longest sensible wait before it.
    static constexpr std::uint32_t kFirstFrame = 1u << 16;

    void believe_hidden(ItemHistory& item, const MemberAnswer& answer);
    void believe_visible(ItemHistory& item, const MemberAnswer& answer);
    void turn_visible(ItemHistory& item, std::uint32_t id, std::uint32_t frame);
    void back_off(ItemHistory& item);
    void end_trial(ItemHistory& item, const MemberAnswer& answer);
    [[nodiscard]] double p_visible_hidden(const ItemHistory& item) const;
    void learn(const ItemHistory& item, const MemberAnswer& answer);
    [[nodiscard]] std::uint32_t random_phase(std::uint32_t item) const;

    KeepProbability keep_;
    LearnedProbability unknown_;
    LearnedDuration turning_;
    double p_unknown_;
    double turn_frames_;
    std::uint64_t seed_;
    std::uint32_t visible_interval_;
    std::uint32_t merge_interval_;
    std::uint32_t max_merge_interval_;
    std::uint32_t frame_ = kFirstFrame;
    std::uint32_t doubtful_ = 0;
    std::vector<ItemHistory> items_;
};

}  // namespace rhview
