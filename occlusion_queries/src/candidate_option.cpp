// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "candidate_option.h"

#include <algorithm>

#include "rhview/timing_model/gate.h"

namespace rhview {

OptionPricer::OptionPricer(const OcclusionSettings& settings, const QueryCosts& costs,
                           const ItemHistories& histories)
    : settings_(settings),
      costs_(costs),
      histories_(histories),
      most_members_(std::min(settings.max_multiquery, histories.doubtful())) {
    for (std::uint32_t i = 0; i <= KeepProbability::kLast; ++i) {
        if (histories.keep()(i) >= histories.p_unknown()) ++unknown_rank_;
    }
}

CandidateOption OptionPricer::option(const OcclusionCandidate& candidate, const ItemHistory& item) const {
    CandidateOption option;
    const double render_ns = usable_render_ns(candidate.render_ns);
    option.render_ns = static_cast<float>(render_ns);
    option.alone = candidate.counts_samples || item.ask_alone;
    if (!candidate.testable || render_ns == 0.0) return option;
    return item.belief == Belief::Visible ? visible(candidate, item, option)
                                          : doubtful(candidate, item, option);
}

CandidateOption OptionPricer::occluder(const OcclusionCandidate& candidate, const ItemHistory& item) const {
    CandidateOption option;
    option.render_ns = static_cast<float>(usable_render_ns(candidate.render_ns));
    const double gain = gain_while_hidden(candidate, option.render_ns);
    set_test(option, candidate, histories_.p_hidden(item) * gain * std::max(settings_.visible_interval, 1u));
    return option;
}

CandidateOption OptionPricer::doubtful(const OcclusionCandidate& candidate, const ItemHistory& item,
                                       CandidateOption option) const {
    const double render_ns = option.render_ns;
    const double p = histories_.p_hidden(item);
    option.rank = rank(item);
    if (is_fresh(item)) {
        option.ask = Ask::Renew;
        // An answer lets the item be left out until it is too old; it is asked for half-way, to be there in
        // time.
        if (2.0 * waited(item) >= settings_.latent_max_age) {
            option.value_ns = static_cast<float>(p * render_ns * settings_.latent_max_age);
        }
        const Prices prices = test_prices(candidate);
        option.hardware_ns = static_cast<float>(
            prices.hardware - costs_.hardware.query_ns +
            query_share_ns(costs_.hardware.query_ns, 1.0 - p, 0.0, option.alone ? 1.0 : most_members_));
        option.box_pass_ns = static_cast<float>(candidate.counts_samples ? kNever : prices.box_pass);
        return option;
    }
    const Prices prices = first_prices(candidate, 1.0 - p, render_ns, option.alone);
    if (worth_a_query(p, render_ns, prices.hardware) || worth_a_query(p, render_ns, prices.box_pass)) {
        option.ask = Ask::First;
        option.value_ns = static_cast<float>(p * render_ns);
        option.hardware_ns = static_cast<float>(prices.hardware);
        option.box_pass_ns = static_cast<float>(prices.box_pass);
        option.explorable = waited(item) >= settings_.explore_after;
        return option;
    }
    // Not worth it at this p. What it loses by being drawn although it may be hidden adds up, until a test
    // pays.
    set_test(option, candidate, p * gain_while_hidden(candidate, render_ns) * (waited(item) + 1.0));
    option.explorable = option.ask == Ask::Test && waited(item) >= settings_.explore_after;
    return option;
}

CandidateOption OptionPricer::visible(const OcclusionCandidate& candidate, const ItemHistory& item,
                                      CandidateOption option) const {
    const double waited_frames = waited(item);
    if (waited_frames < settings_.visible_interval) return option;
    // Loss since the last test: it turned hidden after s frames with probability s / turn_frames, about, and
    // is drawn in vain since. Testing when the loss equals the price minimises both per frame.
    const double seen = histories_.frame() - std::min(histories_.frame(), item.visible_since);
    const double lost_frames = 0.5 * waited_frames * waited_frames / histories_.turn_frames(seen);
    set_test(option, candidate, gain_while_hidden(candidate, option.render_ns) * lost_frames);
    option.explorable = option.ask == Ask::Test && waited_frames >= settings_.explore_after;
    return option;
}

void OptionPricer::set_test(CandidateOption& option, const OcclusionCandidate& candidate,
                            double value_ns) const {
    if (!(value_ns > 0.0)) return;
    const Prices prices = test_prices(candidate);
    option.ask = Ask::Test;
    option.value_ns = static_cast<float>(value_ns);
    option.hardware_ns = static_cast<float>(prices.hardware);
    option.box_pass_ns = static_cast<float>(candidate.counts_samples ? kNever : prices.box_pass);
}

OptionPricer::Prices OptionPricer::test_prices(const OcclusionCandidate& candidate) const {
    return {costs_.hardware.query_ns + member_ns(costs_.hardware, candidate),
            costs_.box_pass.query_ns + member_ns(costs_.box_pass, candidate)};
}

OptionPricer::Prices OptionPricer::first_prices(const OcclusionCandidate& candidate, double p_seen,
                                                double render_ns, bool alone) const {
    const double share =
        query_share_ns(costs_.hardware.query_ns, p_seen, render_ns, alone ? 1.0 : most_members_);
    const double box_pass = costs_.box_pass.query_ns + member_ns(costs_.box_pass, candidate) +
                            conditional_ns(costs_.box_pass, candidate);
    return {
        share + member_ns(costs_.hardware, candidate) + conditional_ns(costs_.hardware, candidate),
        candidate.counts_samples ? kNever : box_pass,
    };
}

/// Per frame, once it is known to be hidden for long.
double OptionPricer::gain_while_hidden(const OcclusionCandidate& candidate, double render_ns) const {
    const double p = settings_.keep_certainty;
    if (settings_.mode == OcclusionMode::Latent) {
        return p * render_ns - 2.0 * test_prices(candidate).least() / std::max(settings_.latent_max_age, 1u);
    }
    return p * render_ns - first_prices(candidate, 1.0 - p, render_ns, candidate.counts_samples).least();
}

bool OptionPricer::is_fresh(const ItemHistory& item) const {
    return settings_.mode == OcclusionMode::Latent && item.belief == Belief::Hidden && !item.ask_alone &&
           item.answered != 0 && histories_.frame() - item.answered <= settings_.latent_max_age;
}

std::uint8_t OptionPricer::rank(const ItemHistory& item) const {
    if (item.belief == Belief::Unknown) return unknown_rank_;
    const std::uint32_t answers = std::min<std::uint32_t>(item.hidden_answers, KeepProbability::kLast);
    const bool behind_unknown = histories_.keep()(answers) < histories_.p_unknown();
    return static_cast<std::uint8_t>(KeepProbability::kLast - answers + (behind_unknown ? 1 : 0));
}

double OptionPricer::waited(const ItemHistory& item) const {
    return histories_.frame() - std::min(histories_.frame(), item.tested);
}

}  // namespace rhview
