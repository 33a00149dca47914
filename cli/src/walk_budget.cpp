// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "walk_budget.h"

#include <algorithm>

namespace rhview::cli {

WalkBudget::WalkBudget(double budget_ms, const std::optional<ResidualPercentiles>& residuals)
    : budget_ns_(1e6 * budget_ms), budget_(residuals) {}

void WalkBudget::limit(const FramePlan& plan, const TimingProfile& profile, LevelOptions& options) {
    const FrameRecord last = last_.value_or(FrameRecord());
    const double share = last.work.indices > 0.0
                             ? std::min(last.work.primitives / last.work.indices, kPrimitivesPerIndex)
                             : kPrimitivesPerIndex;
    Work rest;
    for (const DrawRange& range : plan.opaque) rest.indices += range.index_count;
    rest.draw_calls = rest.sub_draws = static_cast<double>(plan.opaque.size());
    rest.primitives = rest.indices * share;
    rest.fragments = last.work.fragments;
    rest.passed_samples = last.work.passed_samples;
    const double query_ns = plan.occlusion ? plan.occlusion->query_ns : 0.0;
    rest_ns_ = profile.predict_ns(rest) + query_ns + 1e6 * last.cull_ms;
    options.budget_ns = budget_.plannable_ns(budget_ns_) - rest_ns_;
    options.costs.index_ns = profile.c1_ns + profile.primitive_ns.value_or(0.0) * share;
    options.costs.draw_ns =
        profile.c3_ns + profile.sub_draw_ns.value_or(0.0) + profile.material_ns.value_or(0.0);
}

void WalkBudget::decide(const LevelSummary& chosen, FrameRecord& record) {
    const double predicted_ns = rest_ns_ + chosen.cost_ns, margin = budget_.margin();
    record.budget = {1e-6 * predicted_ns, margin, chosen.budget_met && predicted_ns * margin <= budget_ns_};
}

void WalkBudget::observe(const FrameRecord& record) {
    if (record.budget && last_) budget_.observe(1e6 * record.budget->predicted_ms, 1e6 * record.frame_ms);
    last_ = record;
}

}  // namespace rhview::cli
