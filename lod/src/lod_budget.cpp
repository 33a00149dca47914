// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Levels within a budget: the cheapest first, refined where it pays most. Funkhouser & Séquin, "Adaptive
// display algorithm for interactive frame rates", SIGGRAPH 1993; the steps after Sinha & Zoltners, "The
// multiple-choice knapsack problem", Operations Research 27(3), 1979.

#include <algorithm>
#include <cmath>

#include "rhview/lod/lod_selection.h"
#include "rhview/lod/projected_error.h"

namespace rhview {
namespace {

// Beyond this an error is as bad as any: differences of losses stay finite.
constexpr double kWorstErrorPx = 1e9;

}  // namespace

/// Pixels that may be wrong: the error times the outline, which is about as long as the root of the area.
double LodSelector::loss(std::size_t object, std::uint32_t level) const {
    const double error_px =
        projected_error_px(levels_of(object)[level].error, objects_[object].pixels_per_unit);
    const double size_px = objects_[object].size_px;
    return (error_px < kWorstErrorPx ? error_px : kWorstErrorPx) * std::sqrt(size_px > 1.0 ? size_px : 1.0);
}

double LodSelector::total_loss(std::span<const std::uint32_t> levels) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < objects_.size(); ++i) sum += loss(i, levels[i]);
    return sum;
}

/// Whether the budget allows `object` to be drawn at `level` and all others as they are.
bool LodSelector::fits(std::size_t object, std::uint32_t level) const {
    const std::span<const LodLevel> levels = levels_of(object);
    const std::size_t first = first_group_[objects_[object].chain];
    const bool leaves_empty = group_sizes_[first + levels_[object]] == 1;
    const bool opens = group_sizes_[first + level] == 0;
    const std::uint64_t indices = indices_ - levels[levels_[object]].index_count + levels[level].index_count;
    return cost(indices, groups_ - (leaves_empty ? 1 : 0) + (opens ? 1 : 0)) <= options_->budget_ns;
}

void LodSelector::move_to(std::size_t object, std::uint32_t level) {
    const std::span<const LodLevel> levels = levels_of(object);
    const std::size_t first = first_group_[objects_[object].chain];
    indices_ = indices_ - levels[levels_[object]].index_count + levels[level].index_count;
    if (--group_sizes_[first + levels_[object]] == 0) --groups_;
    if (group_sizes_[first + level]++ == 0) ++groups_;
    gained_ += loss(object, levels_[object]) - loss(object, level);
    levels_[object] = level;
}

/// The order of the heap: the greatest gain per index on top, of equal ones the first object.
bool LodSelector::comes_later(const Step& a, const Step& b) {
    return a.gain_per_index != b.gain_per_index ? a.gain_per_index < b.gain_per_index : a.object > b.object;
}

/// The most rewarding of the finer levels, down to the wanted one; none if none gains anything.
void LodSelector::push_step(std::size_t object) {
    const std::span<const LodLevel> levels = levels_of(object);
    const std::uint32_t now = levels_[object];
    Step best;
    for (std::uint32_t level = now; level-- > wanted_[object];) {
        const double gain = loss(object, now) - loss(object, level);
        const double more = static_cast<double>(levels[level].index_count - levels[now].index_count);
        if (gain / more > best.gain_per_index)
            best = {gain / more, static_cast<std::uint32_t>(object), level};
    }
    if (!(best.gain_per_index > 0.0)) return;
    steps_.push_back(best);
    std::ranges::push_heap(steps_, &LodSelector::comes_later);
}

/// All objects at their last level, the wanted levels no finer than fits alone.
void LodSelector::begin_refining() {
    for (std::size_t i = 0; i < objects_.size(); ++i)
        levels_[i] = static_cast<std::uint32_t>(levels_of(i).size() - 1);
    count(levels_);
    gained_ = 0.0;
    for (std::size_t i = 0; i < objects_.size(); ++i)
        while (wanted_[i] < levels_[i] && !fits(i, wanted_[i])) ++wanted_[i];
    steps_.clear();
    for (std::size_t i = 0; i < objects_.size(); ++i) push_step(i);
}

/// The finest level that still fits; the object's last step.
void LodSelector::take_what_fits(std::size_t object) {
    for (std::uint32_t level = wanted_[object]; level < levels_[object]; ++level) {
        if (!fits(object, level) || !(loss(object, level) < loss(object, levels_[object]))) continue;
        move_to(object, level);
        return;
    }
}

/// Where `step` alone gains more than all that was done: that in its place.
bool LodSelector::start_from_alone(const Step& step) {
    const auto last = static_cast<std::uint32_t>(levels_of(step.object).size() - 1);
    if (!(loss(step.object, last) - loss(step.object, step.level) > gained_)) return false;
    begin_refining();
    if (!fits(step.object, step.level)) return false;
    std::erase_if(steps_, [&](const Step& other) { return other.object == step.object; });
    std::ranges::make_heap(steps_, &LodSelector::comes_later);
    move_to(step.object, step.level);
    push_step(step.object);
    return true;
}

void LodSelector::refine() {
    bool fitted = true;
    while (!steps_.empty()) {
        std::ranges::pop_heap(steps_, &LodSelector::comes_later);
        const Step step = steps_.back();
        steps_.pop_back();
        if (fits(step.object, step.level)) {
            move_to(step.object, step.level);
            push_step(step.object);
        } else if (fitted && start_from_alone(step)) {
            fitted = false;
        } else {
            fitted = false;
            take_what_fits(step.object);
        }
    }
}

/// The last selection's cost does not depend on the camera: what fitted then fits now, unless objects came.
void LodSelector::keep_last_selection() {
    for (std::size_t i = 0; i < objects_.size(); ++i)
        if (last_[i] >= levels_of(i).size()) return;
    if (total_loss(last_) > total_loss(levels_) * (1.0 + options_->hysteresis)) return;
    levels_.swap(last_);
    count(levels_);
    if (cost() <= options_->budget_ns) return;
    levels_.swap(last_);
    count(levels_);
}

void LodSelector::select_within_budget() {
    begin_refining();
    budget_met_ = cost() <= options_->budget_ns;
    if (!budget_met_) return;
    refine();
    keep_last_selection();
}

}  // namespace rhview
