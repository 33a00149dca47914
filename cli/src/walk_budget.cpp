// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "walk_budget.h"

#include <algorithm>

namespace rhview::cli {

WalkBudget::WalkBudget(double budget_ms, const TimingProfile& profile)
    : budget_ns_(1e6 * budget_ms), profile_(profile), budget_(profile.residuals) {}

void WalkBudget::limit(const FramePlan& plan, LevelOptions& options) {
    const double share = last_.work.indices > 0.0
                             ? std::min(last_.work.primitives / last_.work.indices, kPrimitivesPerIndex)
                             : kPrimitivesPerIndex;
    Work rest;
    for (const DrawRange& range : plan.opaque) rest.indices += range.index_count;
    rest.draw_calls = rest.sub_draws = static_cast<double>(plan.opaque.size());
    rest.primitives = rest.indices * share;
    rest.fragments = last_.work.fragments;
    rest.passed_samples = last_.work.passed_samples;
    const double query_ns = plan.occlusion ? plan.occlusion->query_ns : 0.0;
    rest_ns_ = profile_.predict_ns(rest) + query_ns + 1e6 * last_.cull_ms;
    options.budget_ns = budget_.plannable_ns(budget_ns_) - rest_ns_;
    options.costs.index_ns = profile_.c1_ns + profile_.primitive_ns.value_or(0.0) * share;
    options.costs.draw_ns =
        profile_.c3_ns + profile_.sub_draw_ns.value_or(0.0) + profile_.material_ns.value_or(0.0);
}

void WalkBudget::decide(const LevelSummary& chosen, FrameRecord& record) {
    const double predicted_ns = rest_ns_ + chosen.cost_ns;
    record.budget.emplace();
    record.budget->predicted_ms = 1e-6 * predicted_ns;
    record.budget->margin = budget_.margin();
    record.budget->can_be_met = chosen.budget_met && predicted_ns * budget_.margin() <= budget_ns_;
}

void WalkBudget::observe(const FrameRecord& record) {
    if (record.budget) budget_.observe(1e6 * record.budget->predicted_ms, 1e6 * record.frame_ms);
    last_ = record;
}

}  // namespace rhview::cli
