// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "candidate_option.h"

#include <algorithm>

#include "rhview/timing_model/gate.h"

namespace rhview {
namespace {

constexpr std::uint32_t kUnknown = OptionPricer::kRanks - 1;
constexpr float kNoPrice = std::numeric_limits<float>::infinity();

}  // namespace

OptionPricer::Costs::Costs(const AnswerCosts& costs)
    : query_ns(static_cast<float>(costs.query_ns)),
      box_ns(static_cast<float>(costs.box_ns)),
      pixel_ns(static_cast<float>(costs.pixel_ns)),
      draw_ns(static_cast<float>(costs.draw_ns)) {}

OptionPricer::OptionPricer(const OcclusionSettings& settings, const QueryCosts& costs,
                           const ItemHistories& histories)
    : settings_(settings),
      histories_(histories),
      hardware_(costs.hardware),
      box_pass_(costs.box_pass),
      most_members_(static_cast<float>(std::min(settings.max_multiquery, histories.doubtful()))),
      latent_frames_(static_cast<float>(std::max(settings.latent_max_age, 1u))) {
    rank_beliefs();
}

void OptionPricer::rank_beliefs() {
    std::array<std::uint8_t, kRanks> by_rank;
    std::array<float, kRanks> p;
    for (std::uint32_t i = 0; i < kRanks; ++i) {
        by_rank[i] = static_cast<std::uint8_t>(i);
        p[i] = static_cast<float>(i == kUnknown ? histories_.p_unknown() : histories_.keep()(i));
    }
    std::sort(by_rank.begin(), by_rank.end(),
              [&](std::uint8_t a, std::uint8_t b) { return p[a] != p[b] ? p[a] > p[b] : a > b; });
    for (std::uint32_t rank = 0; rank < kRanks; ++rank) {
        rank_of_[by_rank[rank]] = static_cast<std::uint8_t>(rank);
        p_by_rank_[rank] = p[by_rank[rank]];
    }
}

void OptionPricer::price(const OcclusionCandidate& candidate, const ItemHistory& item,
                         CandidateOption& option) const {
    option = {};
    option.render_ns = usable_render_ns(candidate.render_ns);
    if (!candidate.testable || option.render_ns == 0.0f) return;
    if (candidate.trial) {
        option.alone = true;
        return set_test(option, candidate, option.render_ns * trusted_frames());
    }
    option.alone = candidate.counts_samples || item.ask_alone;
    if (item.belief == Belief::Visible) {
        set_visible(option, candidate, item);
    } else {
        set_doubtful(option, candidate, item);
    }
}

void OptionPricer::price_occluder(const OcclusionCandidate& candidate, CandidateOption& option) const {
    option = {};
    option.render_ns = usable_render_ns(candidate.render_ns);
    option.alone = true;
    const float p = p_by_rank_[rank_of_[kUnknown]];
    set_test(option, candidate, p * gain_while_hidden(candidate, option.render_ns) * trusted_frames());
}

void OptionPricer::set_doubtful(CandidateOption& option, const OcclusionCandidate& candidate,
                                const ItemHistory& item) const {
    const std::uint32_t answers = std::min<std::uint32_t>(item.hidden_answers, KeepProbability::kLast);
    option.rank = rank_of_[item.belief == Belief::Unknown ? kUnknown : answers];
    const float p = p_by_rank_[option.rank];
    if (settings_.mode == OcclusionMode::Latent && is_fresh(item)) {
        return set_renewal(option, candidate, item, p);
    }
    const float most = option.alone ? 1.0f : most_members_;
    const Prices prices =
        first_prices(candidate, query_share_ns(hardware_.query_ns, 1.0f - p, option.render_ns, most));
    if (worth_a_query(p, option.render_ns, prices.hardware) ||
        worth_a_query(p, option.render_ns, prices.box_pass)) {
        option.ask = Ask::First;
        option.value_ns = p * option.render_ns;
        option.hardware_ns = prices.hardware;
        option.box_pass_ns = prices.box_pass;
    } else {
        // Not worth it at this p. What is lost by drawing what may be hidden adds up, until a test pays.
        const float gain = gain_while_hidden(candidate, option.render_ns);
        set_test(option, candidate, p * gain * (waited(item) + 1.0f));
    }
    option.explorable =
        option.ask != Ask::Nothing && waited(item) >= static_cast<float>(settings_.explore_after);
}

void OptionPricer::set_renewal(CandidateOption& option, const OcclusionCandidate& candidate,
                               const ItemHistory& item, float p) const {
    option.ask = Ask::Renew;
    // An answer lets the item be left out until it is too old; it is asked for half-way, to be there in time.
    if (2.0f * waited(item) < latent_frames_) return;
    option.value_ns = p * option.render_ns * latent_frames_;
    const float most = option.alone ? 1.0f : most_members_;
    const Prices prices = test_prices(candidate, query_share_ns(hardware_.query_ns, 1.0f - p, 0.0f, most));
    option.hardware_ns = prices.hardware;
    option.box_pass_ns = prices.box_pass;
}

void OptionPricer::set_visible(CandidateOption& option, const OcclusionCandidate& candidate,
                               const ItemHistory& item) const {
    const float waited_frames = waited(item);
    if (waited_frames < static_cast<float>(settings_.visible_interval)) return;
    // Loss since the last test: it turned hidden after s frames with probability s / turn_frames, about, and
    // is drawn in vain since. Testing when the loss equals the price minimises both per frame.
    const double seen = histories_.frame() - std::min(histories_.frame(), item.visible_since);
    const auto turn_frames = static_cast<float>(histories_.turn_frames(seen));
    const float lost_frames = 0.5f * waited_frames * waited_frames / turn_frames;
    set_test(option, candidate, gain_while_hidden(candidate, option.render_ns) * lost_frames);
    option.explorable =
        option.ask == Ask::Test && waited_frames >= static_cast<float>(settings_.explore_after);
}

void OptionPricer::set_test(CandidateOption& option, const OcclusionCandidate& candidate,
                            float value_ns) const {
    if (!(value_ns > 0.0f)) return;
    const Prices prices = test_prices(candidate, hardware_.query_ns);
    option.ask = Ask::Test;
    option.value_ns = value_ns;
    option.hardware_ns = prices.hardware;
    option.box_pass_ns = prices.box_pass;
}

OptionPricer::Prices OptionPricer::test_prices(const OcclusionCandidate& candidate,
                                               float hardware_query_ns) const {
    const float box_pass = box_pass_.query_ns + static_cast<float>(candidate.boxes) * box_pass_.box_ns +
                           candidate.pixels * box_pass_.pixel_ns;
    return {hardware_query_ns + static_cast<float>(candidate.boxes) * hardware_.box_ns +
                candidate.pixels * hardware_.pixel_ns,
            candidate.counts_samples ? kNoPrice : box_pass};
}

OptionPricer::Prices OptionPricer::first_prices(const OcclusionCandidate& candidate,
                                                float hardware_query_ns) const {
    const Prices prices = test_prices(candidate, hardware_query_ns);
    const auto draws = static_cast<float>(candidate.draws);
    return {prices.hardware + draws * hardware_.draw_ns, prices.box_pass + draws * box_pass_.draw_ns};
}

/// Per frame, once it is known to be hidden for long.
float OptionPricer::gain_while_hidden(const OcclusionCandidate& candidate, float render_ns) const {
    const float p = p_by_rank_[rank_of_[KeepProbability::kLast]];
    if (settings_.mode == OcclusionMode::Latent) {
        return p * render_ns - 2.0f * test_prices(candidate, hardware_.query_ns).least() / latent_frames_;
    }
    const float most = candidate.counts_samples ? 1.0f : most_members_;
    const float share = query_share_ns(hardware_.query_ns, 1.0f - p, render_ns, most);
    return p * render_ns - first_prices(candidate, share).least();
}

/// An answer is good for so many, at least.
float OptionPricer::trusted_frames() const {
    return static_cast<float>(std::max(settings_.visible_interval, 1u));
}

bool OptionPricer::is_fresh(const ItemHistory& item) const {
    return item.belief == Belief::Hidden && !item.ask_alone && item.answered != 0 &&
           histories_.frame() - item.answered <= settings_.latent_max_age;
}

float OptionPricer::waited(const ItemHistory& item) const {
    return static_cast<float>(histories_.frame() - std::min(histories_.frame(), item.tested));
}

}  // namespace rhview
