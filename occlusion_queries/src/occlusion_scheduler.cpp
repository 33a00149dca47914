// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/occlusion_queries/occlusion_scheduler.h"

#include "item_history.h"
#include "model_policy.h"
#include "pending_queries.h"
#include "query_prices.h"
#include "query_writer.h"
#include "rhview/base/assert.h"

namespace rhview {
namespace {

QueryCosts usable(const QueryCosts& costs) {
    return {usable_costs(costs.hardware), usable_costs(costs.box_pass)};
}

}  // namespace

struct OcclusionScheduler::State {
    State(const OcclusionSettings& wanted, const QueryCosts& prices)
        : settings(wanted),
          costs(usable(prices)),
          histories(wanted),
          pending(wanted.lost_after_frames),
          model(wanted) {}

    /// What is seen too little counts as hidden, where pixels may be missing and samples were counted.
    [[nodiscard]] bool counts_as_visible(const QueryAnswer& answer) const {
        const bool too_little = settings.mode == OcclusionMode::Latent && answer.samples > 0 &&
                                answer.samples < settings.visible_samples;
        return answer.visible && !too_little;
    }
    void tell_members(const PendingQueries::Found& query, bool visible, bool learnt);
    void decide_by_paper(std::span<const OcclusionCandidate> candidates, QueryWriter& writer,
                         OcclusionDecisions& out);

    OcclusionSettings settings;
    QueryCosts costs;
    ItemHistories histories;
    PendingQueries pending;
    ModelPolicy model;
    Counters counters;
    bool decided = true;
};

OcclusionScheduler::OcclusionScheduler(const OcclusionSettings& settings, const QueryCosts& costs)
    : state_(std::make_unique<State>(settings, costs)) {}
OcclusionScheduler::~OcclusionScheduler() = default;
OcclusionScheduler::OcclusionScheduler(OcclusionScheduler&&) noexcept = default;
OcclusionScheduler& OcclusionScheduler::operator=(OcclusionScheduler&&) noexcept = default;

void OcclusionScheduler::resize(std::size_t count) {
    RHVIEW_ASSERT(count <= PendingMember::kMostItems);
    state_->histories.resize(count);
}

void OcclusionScheduler::forget(std::uint32_t item) {
    RHVIEW_ASSERT(item < state_->histories.size());
    state_->histories[item] = {};
}

void OcclusionScheduler::set_costs(const QueryCosts& costs) {
    state_->costs = usable(costs);
}

const OcclusionSettings& OcclusionScheduler::settings() const {
    return state_->settings;
}

const OcclusionScheduler::Counters& OcclusionScheduler::counters() const {
    return state_->counters;
}

void OcclusionScheduler::State::tell_members(const PendingQueries::Found& query, bool visible, bool learnt) {
    MemberAnswer answer;
    answer.asked_frame = query.frame;
    answer.visible = visible;
    answer.members = static_cast<std::uint32_t>(query.members.size());
    answer.nothing_in_front = query.nothing_in_front;
    answer.learnt = learnt;
    for (const PendingMember& member : query.members) {
        answer.item = member.item();
        answer.asked_as = member.asked_as();
        histories.answer(answer);
    }
}

void OcclusionScheduler::absorb(std::span<const QueryAnswer> answers) {
    for (const QueryAnswer& answer : answers) {
        PendingQueries::Found query;
        if (!state_->pending.take(answer.ticket, query)) {
            ++state_->counters.unknown_tickets;
            continue;
        }
        const bool visible = state_->counts_as_visible(answer);
        ++state_->counters.answers;
        if (!visible) ++state_->counters.hidden;
        if (query.explores) state_->model.learn_explored(!visible);
        state_->tell_members(query, visible, true);
    }
}

void OcclusionScheduler::begin_frame(double frame_ns, double screen_pixels) {
    State& state = *state_;
    state.pending.begin_frame(state.histories.frame() + 1, [&](const PendingQueries::Found& query) {
        ++state.counters.lost;
        state.tell_members(query, true, false);
    });
    state.histories.begin_frame();
    state.model.begin_frame(frame_ns, screen_pixels);
    state.decided = false;
}

Belief OcclusionScheduler::visit(std::uint32_t item, Belief otherwise) {
    RHVIEW_ASSERT(item < state_->histories.size());
    return state_->histories.visit(item, otherwise);
}

double OcclusionScheduler::p_hidden(std::uint32_t item) const {
    RHVIEW_ASSERT(item < state_->histories.size());
    return state_->histories.p_hidden(state_->histories[item]);
}

bool OcclusionScheduler::turned_visible(std::uint32_t item) const {
    RHVIEW_ASSERT(item < state_->histories.size());
    return state_->histories[item].turned_visible;
}

bool OcclusionScheduler::may_try(std::uint32_t item, double p_hidden) {
    RHVIEW_ASSERT(item < state_->histories.size());
    return state_->histories.may_try(item, p_hidden);
}

void OcclusionScheduler::decide(std::span<const OcclusionCandidate> candidates, OcclusionDecisions& out) {
    State& state = *state_;
    RHVIEW_ASSERT(!state.decided);
    state.decided = true;
    state.pending.reserve(candidates.size());
    state.model.reserve(candidates.size());
    out.decisions.assign(candidates.size(), {});
    out.queries.clear();
    out.queries.reserve(candidates.size());
    out.members.clear();
    out.members.reserve(candidates.size());
    out.query_ns = out.exploration_ns = out.saved_ns = 0.0;
    QueryWriter writer(candidates, state.costs, state.histories, state.pending, out);
    if (state.settings.policy == OcclusionPolicy::Paper) {
        state.decide_by_paper(candidates, writer, out);
    } else {
        state.model.decide(candidates, state.costs, state.histories, writer, out);
    }
    out.saved_ns -= out.query_ns;
}

/// Source: Serpa & Rodrigues 2018: only if drawing is predicted to take longer than the budget, each object
/// is asked about.
void OcclusionScheduler::State::decide_by_paper(std::span<const OcclusionCandidate> candidates,
                                                QueryWriter& writer, OcclusionDecisions& out) {
    double render_ns = 0.0;
    for (const OcclusionCandidate& candidate : candidates)
        if (!candidate.trial) render_ns += usable_render_ns(candidate.render_ns);
    const bool over_budget = render_ns > settings.paper_budget_ns;
    for (std::uint32_t i = 0; i < candidates.size(); ++i) {
        const OcclusionCandidate& candidate = candidates[i];
        if (!candidate.testable) histories.see(candidate.item);
        if (!over_budget || !candidate.testable || candidate.trial) continue;
        out.saved_ns += histories.p_hidden(histories[candidate.item]) * usable_render_ns(candidate.render_ns);
        writer.ask({&i, 1}, QueryWay::HardwareQuery, OcclusionAction::QueryFirst);
    }
}

}  // namespace rhview
