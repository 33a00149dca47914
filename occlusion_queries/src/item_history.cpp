// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "item_history.h"

#include <algorithm>

namespace rhview {
namespace {

/// A shared query that saw something leaves its members in doubt: of n of them one, about, is seen.
constexpr std::uint8_t kDoubtfulAnswers = 2;
/// After so many hidden answers in a row, an item's earlier failures to stay merged are forgotten.
constexpr std::uint8_t kMergeForgiven = 8;
constexpr std::uint8_t kMostFailures = 16;
/// So long after it came into view at most, an item is given the benefit of the doubt: answers about its
/// occluders are a few frames on their way.
constexpr std::uint32_t kColdFrames = 8;

/// The prior of p for unknown items weighs little: the first frame's answers overrule it.
constexpr double kUnknownPriorAnswers = 4.0;

double at_least(double value, double least) {
    return value >= least ? value : least;
}

}  // namespace

ItemHistories::ItemHistories(const OcclusionSettings& settings)
    : keep_(at_least(settings.keep_certainty, 0.0), at_least(settings.keep_doubt, 0.0),
            at_least(settings.keep_prior_answers, 1.0), at_least(settings.memory_answers, 1.0)),
      unknown_(at_least(std::min(settings.unknown_hidden, 1.0), 0.0), kUnknownPriorAnswers,
               at_least(settings.memory_answers, 1.0)),
      turning_(at_least(settings.turn_frames, 1.0), at_least(settings.memory_item_frames, 1.0)),
      p_unknown_(unknown_.mean()),
      turn_frames_(turning_.mean_frames()),
      seed_(settings.seed),
      visible_interval_(std::max(settings.visible_interval, 1u)),
      merge_interval_(std::max(settings.merge_interval, 1u)),
      max_merge_interval_(std::max(settings.max_merge_interval, merge_interval_)) {}

void ItemHistories::begin_frame() {
    ++frame_;
    doubtful_ = 0;
    keep_.take_in();
    unknown_.take_in();
    turning_.take_in();
    p_unknown_ = unknown_.mean();
    turn_frames_ = turning_.mean_frames();
}

Belief ItemHistories::visit(std::uint32_t item, Belief otherwise) {
    ItemHistory& history = items_[item];
    if (history.visited + 1 < frame_) {
        history = {};
        history.since = history.tested = frame_;
        history.belief = otherwise;
        if (otherwise == Belief::Hidden) history.hidden_answers = 1;
        if (otherwise == Belief::Visible) turn_visible(history, item, frame_);
    }
    history.visited = frame_;
    if (history.belief != Belief::Visible) ++doubtful_;
    return history.belief;
}

bool ItemHistories::may_try(std::uint32_t item, double p_hidden) {
    ItemHistory& history = items_[item];
    if (history.belief == Belief::Hidden || history.on_trial || frame_ < history.merge_after) return false;
    history.hidden_answers = static_cast<std::uint8_t>(keep_.answers_for(p_hidden));
    return true;
}

void ItemHistories::begin_trial(std::uint32_t item) {
    ItemHistory& history = items_[item];
    history.on_trial = true;
    // Answers on the way are about what it was before.
    history.answered = 0;
    history.since = frame_;
}

/// It says nothing of items of its kind: what was tried was chosen.
void ItemHistories::end_trial(ItemHistory& item, const MemberAnswer& answer) {
    item.on_trial = false;
    item.answered = answer.asked_frame;
    if (answer.visible) return back_off(item);
    item.belief = Belief::Hidden;
    item.ask_alone = item.turned_visible = false;
}

void ItemHistories::answer(const MemberAnswer& answer) {
    if (answer.item >= items_.size()) return;
    ItemHistory& item = items_[answer.item];
    if (item.visited == 0 || answer.asked_frame < item.since || answer.asked_frame <= item.answered) return;
    // Seen before it was known what it could hide behind: no news.
    if (answer.visible && answer.nothing_in_front && item.belief == Belief::Unknown &&
        answer.asked_frame - item.since < kColdFrames) {
        return;
    }
    if (item.on_trial) return end_trial(item, answer);
    if (answer.learnt) learn(item, answer);
    if (!answer.visible) return believe_hidden(item, answer);
    if (answer.members == 1) return believe_visible(item, answer);
    if (item.belief == Belief::Visible) return;
    item.ask_alone = true;
    item.hidden_answers = std::min(item.hidden_answers, kDoubtfulAnswers);
}

void ItemHistories::believe_hidden(ItemHistory& item, const MemberAnswer& answer) {
    item.hidden_answers =
        item.belief == Belief::Hidden ? static_cast<std::uint8_t>(std::min(item.hidden_answers + 1, 255)) : 1;
    item.belief = Belief::Hidden;
    item.answered = answer.asked_frame;
    item.ask_alone = item.turned_visible = false;
    if (item.hidden_answers >= kMergeForgiven) item.merge_failures = 0;
}

void ItemHistories::believe_visible(ItemHistory& item, const MemberAnswer& answer) {
    if (item.belief == Belief::Hidden) back_off(item);
    if (item.belief != Belief::Visible) turn_visible(item, answer.item, answer.asked_frame);
    item.answered = answer.asked_frame;
    item.turned_visible = answer.asked_as == Belief::Hidden;
}

void ItemHistories::turn_visible(ItemHistory& item, std::uint32_t id, std::uint32_t frame) {
    item.belief = Belief::Visible;
    item.hidden_answers = 0;
    item.ask_alone = item.turned_visible = item.on_trial = false;
    item.visible_since = frame;
    item.tested = frame_ - std::min(frame_, random_phase(id));
}

void ItemHistories::back_off(ItemHistory& item) {
    const std::uint64_t wait = std::uint64_t{merge_interval_} << item.merge_failures;
    item.merge_after =
        frame_ + static_cast<std::uint32_t>(std::min<std::uint64_t>(wait, max_merge_interval_));
    item.merge_failures = std::min<std::uint8_t>(item.merge_failures + 1, kMostFailures);
}

void ItemHistories::see(std::uint32_t item) {
    ItemHistory& history = items_[item];
    if (history.belief == Belief::Visible) return;
    turn_visible(history, item, frame_);
    history.answered = frame_;
}

void ItemHistories::learn(const ItemHistory& item, const MemberAnswer& answer) {
    if (answer.asked_as == Belief::Hidden && item.belief == Belief::Hidden) {
        keep_.add(item.hidden_answers, answer.visible, answer.members);
    }
    // A shared query that saw something does not say whom.
    if (answer.visible && answer.members > 1) return;
    if (answer.asked_as == Belief::Unknown) unknown_.add(!answer.visible);
    if (answer.asked_as != Belief::Visible || item.belief != Belief::Visible) return;
    const std::uint32_t before = std::max(item.answered, item.visible_since);
    if (answer.asked_frame > before) turning_.add(!answer.visible, answer.asked_frame - before);
}

double ItemHistories::p_visible_hidden(const ItemHistory& item) const {
    // The chance to have turned since, where the rate itself is only known by how long it did not: a Lomax
    // distribution.
    const std::uint32_t last = std::min(frame_, std::max(item.answered, item.visible_since));
    const double waited = frame_ - last;
    const double seen = last - std::min(last, item.visible_since);
    return std::clamp(waited / (waited + turn_frames(seen)), 1e-4, 0.99);
}

std::uint32_t ItemHistories::random_phase(std::uint32_t item) const {
    // SplitMix64 (Steele, Lea & Flood 2014) of item, frame and seed: independent of the order of answers.
    std::uint64_t bits = seed_ + 0x9e3779b97f4a7c15u * ((std::uint64_t{frame_} << 32) + item + 1);
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return static_cast<std::uint32_t>((bits ^ (bits >> 31)) % visible_interval_);
}

}  // namespace rhview
