// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/lod/lod_selection.h"

#include <algorithm>

#include "rhview/base/assert.h"
#include "rhview/lod/projected_error.h"

namespace rhview {

LodSelector::LodSelector(std::span<const LodChain> chains) : chains_(chains) {
    std::size_t groups = 0;
    for (const LodChain& chain : chains) {
        RHVIEW_ASSERT(!chain.levels.empty());
        first_group_.push_back(groups);
        groups += chain.levels.size();
    }
    group_sizes_.resize(groups);
}

std::span<const LodLevel> LodSelector::levels_of(std::size_t object) const {
    return chains_[objects_[object].chain].levels.span();
}

std::uint32_t LodSelector::remembered(std::size_t object) const {
    const std::uint32_t slot = objects_[object].slot;
    return slot < remembered_.size() ? remembered_[slot] : kNoLevel;
}

void LodSelector::forget(std::uint32_t slot) {
    if (slot < remembered_.size()) remembered_[slot] = kNoLevel;
}

/// The coarsest level within the bound; one that is coarser than the last time's must undercut it.
std::uint32_t LodSelector::level_by_bound(std::size_t object) const {
    const std::span<const LodLevel> levels = levels_of(object);
    const double pixels = objects_[object].pixels_per_unit, bound = options_->max_error_px;
    // Errors never fall along the chain.
    const auto coarsest_within = [&](double limit) {
        std::uint32_t level = 0;
        while (level + 1 < levels.size() && projected_error_px(levels[level + 1].error, pixels) <= limit)
            ++level;
        return level;
    };
    if (!(bound > 0.0)) return 0;
    const std::uint32_t level = coarsest_within(bound), before = remembered(object);
    if (before == kNoLevel || level <= before) return level;
    return std::max(before, coarsest_within(bound * (1.0 - options_->hysteresis)));
}

/// The finest level of no more triangles than the fragments are worth; one that is finer than the last time's
/// must stay clearly below.
std::uint32_t LodSelector::level_by_fragments(std::size_t object, std::uint64_t fragments) const {
    const std::span<const LodLevel> levels = levels_of(object);
    const double triangles = options_->triangles_per_fragment * static_cast<double>(fragments);
    const auto finest_within = [&](double limit) {
        std::uint32_t level = 0;
        while (level + 1 < levels.size() && levels[level].index_count / 3.0 > limit) ++level;
        return level;
    };
    const std::uint32_t level = finest_within(triangles), before = remembered(object);
    if (before == kNoLevel || level >= before) return level;
    return std::min(before, finest_within(triangles * (1.0 - options_->hysteresis)));
}

std::uint32_t LodSelector::wanted_level(std::size_t object) const {
    const std::uint32_t level = level_by_bound(object);
    const std::optional<std::uint64_t>& fragments = objects_[object].fragments;
    if (options_->policy != LodPolicy::Fragments || !fragments) return level;
    return std::max(level, level_by_fragments(object, *fragments));
}

/// Counts objects per group and indices anew.
void LodSelector::count(std::span<const std::uint32_t> levels) {
    std::ranges::fill(group_sizes_, 0u);
    indices_ = groups_ = 0;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        groups_ += group_sizes_[first_group_[objects_[i].chain] + levels[i]]++ == 0 ? 1 : 0;
        indices_ += levels_of(i)[levels[i]].index_count;
    }
}

double LodSelector::cost(std::uint64_t indices, std::uint64_t groups) const {
    const LodCosts& costs = options_->costs;
    return costs.index_ns * static_cast<double>(indices) + costs.draw_ns * static_cast<double>(groups) +
           costs.object_ns * static_cast<double>(objects_.size());
}

void LodSelector::select(std::span<const LodObject> objects, const LodSelectionOptions& options,
                         LodSelection& result) {
    RHVIEW_ASSERT(options.hysteresis >= 0.0 && options.hysteresis < 1.0);
    objects_ = objects;
    options_ = &options;
    budget_met_ = true;
    for (std::vector<std::uint32_t>* levels : {&wanted_, &levels_, &last_}) levels->resize(objects.size());
    steps_.reserve(objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        RHVIEW_ASSERT(objects[i].chain < chains_.size());
        wanted_[i] = wanted_level(i);
        last_[i] = std::min(remembered(i), static_cast<std::uint32_t>(levels_of(i).size()));
    }
    levels_ = wanted_;
    count(levels_);
    if (cost() > options.budget_ns) select_within_budget();
    finish(result);
}

void LodSelector::finish(LodSelection& result) {
    result.levels.assign(levels_.begin(), levels_.end());
    result.max_error_px = 0.0;
    result.switches = 0;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        const std::uint32_t slot = objects_[i].slot, level = levels_[i];
        const double error_px = projected_error_px(levels_of(i)[level].error, objects_[i].pixels_per_unit);
        result.max_error_px = std::max(result.max_error_px, error_px);
        if (slot >= remembered_.size()) remembered_.resize(slot + std::size_t{1}, kNoLevel);
        result.switches += remembered_[slot] != kNoLevel && remembered_[slot] != level ? 1u : 0u;
        remembered_[slot] = level;
    }
    result.indices = indices_;
    result.cost_ns = cost();
    result.bound_met = result.max_error_px <= std::max(options_->max_error_px, 0.0);
    result.budget_met = budget_met_;
}

}  // namespace rhview
