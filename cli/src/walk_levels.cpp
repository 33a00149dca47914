// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "walk_levels.h"

#include <algorithm>

#include "level_chains.h"

namespace rhview::cli {
namespace {

/// Frames in which what hangs on queries is priced once: its level changes in seconds.
constexpr std::uint32_t kPriceTurns = 32;

}  // namespace

WalkLevels::WalkLevels(const Scene& scene, std::span<const LodChain> chains, const WalkOptions& options,
                       const TimingProfile* profile)
    : levels_(chains, levelled_objects(scene)) {
    options_.max_error_px = options.lod_error_px;
    if (options.lod_policy == "fragments") options_.policy = LodPolicy::Fragments;
    for (std::uint32_t i = 0; i < scene.object_count(); ++i)
        whole_indices_.push_back(static_cast<std::uint32_t>(
            scene.meshes[index_of(scene.object_mesh(ObjectId{i}))].indices.size()));
    if (options.budget_ms && profile != nullptr) budget_.emplace(*options.budget_ms, profile->residuals);
}

void WalkLevels::choose(const FrameInput& input, const TimingProfile* profile, FramePlan& plan,
                        FrameRecord& record) {
    if (budget_ && profile != nullptr) budget_->limit(plan, *profile, options_);
    const LevelSummary chosen = levels_.choose_at_once(input, options_, plan);
    if (budget_) budget_->decide(chosen, record);
}

std::span<const std::uint8_t> WalkLevels::choose_ahead(const FrameInput& input) {
    levels_.choose(input, options_);
    return levels_.levels();
}

void WalkLevels::name_levels(FramePlan& drawn) const {
    drawn.object_levels.clear();
    for (const ObjectId object : drawn.objects)
        drawn.object_levels.push_back(levels_.levels()[index_of(object)]);
}

double WalkLevels::error_px(const FramePlan& plan, std::span<const QueryAnswer> answers) const {
    double most = 0.0;
    for (const ObjectId object : plan.objects) most = std::max(most, levels_.error_px(object));
    for (const ConditionalObject& object : plan.conditional_objects) {
        const double error_px = levels_.error_px(object.object);
        if (error_px <= most) continue;
        const std::uint64_t ticket = plan.queries[object.query].ticket;
        const auto answer = std::ranges::find(answers, ticket, &QueryAnswer::ticket);
        if (answer == answers.end() || answer->visible) most = error_px;
    }
    return most;
}

void WalkLevels::count_indices(const FrameInput& input, const FramePlan& plan,
                               std::vector<std::uint32_t>& object_indices) {
    if (object_indices.empty()) return;
    for (const ObjectId object : plan.objects)
        object_indices[index_of(object)] = levels_.indices(object, whole_indices_[index_of(object)]);
    counted_.resize(whole_indices_.size(), 0);
    ++frame_;
    for (const ConditionalObject& hanging : plan.conditional_objects) {
        const auto id = static_cast<std::uint32_t>(hanging.object);
        const bool was_there = counted_[id] != 0 && frame_ - counted_[id] < kPriceTurns;
        if (was_there && (frame_ + id) % kPriceTurns != 0) continue;
        counted_[id] = frame_;
        object_indices[id] = levels_.indices_at(hanging.object, levels_.level_by_bound(input, hanging.object),
                                                whole_indices_[id]);
    }
}

void WalkLevels::observe(const FrameRecord& record) {
    if (budget_) budget_->observe(record);
}

std::span<const std::uint8_t> WalkLevels::complete(const FrameInput& input, const FramePlan& plan) {
    levels_.complete(input, options_, plan, all_);
    return all_;
}

}  // namespace rhview::cli
