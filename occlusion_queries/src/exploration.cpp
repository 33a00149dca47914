// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "exploration.h"

#include <algorithm>
#include <tuple>

namespace rhview {
namespace {

/// Credit for so many frames is kept while there is nothing to explore.
constexpr double kSavedFrames = 64.0;
/// From this part of hidden answers on, the whole share is spent: of what is explored, a quarter pays.
constexpr double kRichYield = 0.25;
/// The first few answers already count.
constexpr double kYieldPriorAnswers = 4.0;
/// Opening a way for exploration alone waits until at least as much goes into queries.
constexpr double kOpening = 2.0;

}  // namespace

Exploration::Exploration(const OcclusionSettings& settings)
    : share_(settings.exploration_share > 0.0 ? std::min(settings.exploration_share, 1.0) : 0.0),
      floor_(settings.exploration_floor > 0.0 ? std::min(settings.exploration_floor, 1.0) : 0.0),
      found_(kRichYield, kYieldPriorAnswers, settings.memory_answers >= 1.0 ? settings.memory_answers : 1.0) {
}

void Exploration::begin_frame(double frame_ns) {
    found_.take_in();
    const double part = std::clamp(found_.mean() / kRichYield, floor_, 1.0);
    income_ns_ = frame_ns > 0.0 ? share_ * part * std::min(frame_ns, 1e15) : 0.0;
    credit_ns_ =
        std::min(credit_ns_ + income_ns_, std::max(kSavedFrames * income_ns_, needed_ns_ + income_ns_));
}

double Exploration::spend(std::span<const OcclusionCandidate> candidates,
                          std::span<const CandidateOption> options, const ItemHistories& histories,
                          const OcclusionDecisions& decisions, QueryWriter& writer) {
    if (credit_ns_ <= 0.0 || credit_ns_ < needed_ns_) return 0.0;
    collect(candidates, options, histories, decisions);
    const auto later = [](const Untested& a, const Untested& b) {
        return std::tie(a.tested, a.item) > std::tie(b.tested, b.item);
    };
    std::make_heap(oldest_.begin(), oldest_.end(), later);
    needed_ns_ = 0.0;
    double spent_ns = 0.0;
    while (!oldest_.empty()) {
        const Untested& next = oldest_.front();
        const Price price = Exploration::price(candidates[next.candidate], writer);
        const double needed_ns = kOpening * price.frame_ns + price.query_ns;
        if (needed_ns < kNever) {
            if (needed_ns > credit_ns_) {
                needed_ns_ = needed_ns;
                break;
            }
            writer.ask({&next.candidate, 1}, price.way, OcclusionAction::DrawAndQuery, true);
            credit_ns_ -= price.frame_ns + price.query_ns;
            spent_ns += price.frame_ns + price.query_ns;
        }
        std::pop_heap(oldest_.begin(), oldest_.end(), later);
        oldest_.pop_back();
    }
    return spent_ns;
}

void Exploration::collect(std::span<const OcclusionCandidate> candidates,
                          std::span<const CandidateOption> options, const ItemHistories& histories,
                          const OcclusionDecisions& decisions) {
    oldest_.clear();
    for (std::uint32_t i = 0; i < options.size(); ++i) {
        if (!options[i].explorable || decisions.decisions[i].action != OcclusionAction::Draw) continue;
        const std::uint32_t item = candidates[i].item;
        oldest_.push_back({histories[item].tested, item, i});
    }
}

Exploration::Price Exploration::price(const OcclusionCandidate& candidate, const QueryWriter& writer) {
    const auto of = [&](QueryWay way) {
        const AnswerCosts& costs = writer.costs(way);
        return Price{way, costs.query_ns + member_ns(costs, candidate),
                     writer.uses(way) ? 0.0 : costs.frame_ns};
    };
    const Price hardware = of(QueryWay::HardwareQuery);
    const Price box_pass = of(QueryWay::BoxPass);
    if (candidate.counts_samples) return hardware;
    const double box_ns = box_pass.frame_ns + box_pass.query_ns;
    return box_ns < hardware.frame_ns + hardware.query_ns ? box_pass : hardware;
}

}  // namespace rhview
