// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "model_policy.h"

#include <algorithm>
#include <tuple>

namespace rhview {
namespace {

/// What asking gains, if anything; a gain that is not known is none.
double gain(double value_ns, double price_ns) {
    const double gained = value_ns - price_ns;
    return gained > 0.0 ? gained : 0.0;
}

}  // namespace

ModelPolicy::ModelPolicy(const OcclusionSettings& settings) : settings_(settings), exploration_(settings) {}

void ModelPolicy::reserve(std::size_t candidates) {
    exploration_.reserve(candidates);
    first_.reserve(candidates);
    renewed_.reserve(candidates);
    options_.reserve(candidates);
    occluders_.reserve(candidates);
}

void ModelPolicy::begin_frame(double frame_ns, double screen_pixels) {
    exploration_.begin_frame(frame_ns);
    screen_pixels_ = screen_pixels > 0.0 ? screen_pixels : 0.0;
}

void ModelPolicy::decide(std::span<const OcclusionCandidate> candidates, const QueryCosts& costs,
                         ItemHistories& histories, QueryWriter& writer, OcclusionDecisions& out) {
    const OptionPricer pricer(settings_, costs, histories);
    appraise(candidates, pricer, histories);
    if (covered_pixels_ < settings_.cold_coverage * screen_pixels_) {
        writer.set_nothing_in_front(put_occluders_in_front(candidates, pricer, histories));
    }
    ask_each(pricer, choose_ways(costs), writer, out);
    ask_groups(pricer, writer, out);
    if (explorable_) out.exploration_ns = exploration_.spend(candidates, options_, histories, out, writer);
}

void ModelPolicy::appraise(std::span<const OcclusionCandidate> candidates, const OptionPricer& pricer,
                           ItemHistories& histories) {
    options_.resize(candidates.size());
    covered_pixels_ = 0.0;
    explorable_ = false;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const OcclusionCandidate& candidate = candidates[i];
        if (!candidate.testable) histories.see(candidate.item);
        const ItemHistory& item = histories[candidate.item];
        pricer.price(candidate, item, options_[i]);
        explorable_ = explorable_ || options_[i].explorable;
        if (item.belief == Belief::Visible && !candidate.trial && candidate.pixels > 0.0f)
            covered_pixels_ += candidate.pixels;
    }
}

/// Where the screen is covered `cold_coverage` times, all of the unknown that is hidden is behind something.
/// Until then each pixel of an occluder hides its share of it, about: p·Σ render_ns / (cold_coverage·screen).
/// The nearest come first; those that cost more than they hide are asked first like the rest.
bool ModelPolicy::put_occluders_in_front(std::span<const OcclusionCandidate> candidates,
                                         const OptionPricer& pricer, const ItemHistories& histories) {
    const double enough = settings_.cold_coverage * screen_pixels_;
    const double hidden_ns_per_pixel = collect_occluders(candidates, histories) / enough;
    const auto farther = [](const Occluder& a, const Occluder& b) {
        return std::tie(a.distance, a.item) > std::tie(b.distance, b.item);
    };
    std::make_heap(occluders_.begin(), occluders_.end(), farther);
    bool found = false;
    while (!occluders_.empty() && covered_pixels_ < enough) {
        const std::uint32_t nearest = occluders_.front().candidate;
        CandidateOption& option = options_[nearest];
        const float pixels = candidates[nearest].pixels;
        const bool at_once = option.ask != Ask::First;
        if (at_once || option.render_ns <= hidden_ns_per_pixel * pixels) {
            if (pixels > 0.0f) covered_pixels_ += pixels;
            if (!at_once) pricer.price_occluder(candidates[nearest], option);
            found = found || !at_once;
        }
        std::pop_heap(occluders_.begin(), occluders_.end(), farther);
        occluders_.pop_back();
    }
    return found;
}

/// What is not known yet; the time that what is hidden of it takes, as far as one can tell.
double ModelPolicy::collect_occluders(std::span<const OcclusionCandidate> candidates,
                                      const ItemHistories& histories) {
    occluders_.clear();
    double unknown_ns = 0.0;
    for (std::uint32_t i = 0; i < candidates.size(); ++i) {
        const std::uint32_t item = candidates[i].item;
        if (histories[item].belief != Belief::Unknown || candidates[i].trial) continue;
        const float distance = candidates[i].distance;
        occluders_.push_back({distance == distance ? distance : 3e38f, item, i});
        unknown_ns += options_[i].render_ns;
    }
    return histories.p_unknown() * unknown_ns;
}

/// A way costs its `frame_ns` once it is used: the frame's totals with neither, one and both are compared.
ModelPolicy::Ways ModelPolicy::choose_ways(const QueryCosts& costs) const {
    double hardware_ns = 0.0, box_pass_ns = 0.0, both_ns = 0.0;
    for (const CandidateOption& option : options_) {
        const double hardware = gain(option.value_ns, option.hardware_ns);
        const double box_pass = gain(option.value_ns, option.box_pass_ns);
        hardware_ns += hardware;
        box_pass_ns += box_pass;
        both_ns += std::max(hardware, box_pass);
    }
    hardware_ns -= costs.hardware.frame_ns;
    box_pass_ns -= costs.box_pass.frame_ns;
    both_ns -= costs.hardware.frame_ns + costs.box_pass.frame_ns;
    if (both_ns > 0.0 && both_ns > hardware_ns && both_ns > box_pass_ns) return {true, true};
    if (box_pass_ns > 0.0 && box_pass_ns > hardware_ns) return {false, true};
    return {hardware_ns > 0.0, false};
}

ModelPolicy::Choice ModelPolicy::choose(const CandidateOption& option, Ways ways) {
    const double hardware = ways.hardware ? gain(option.value_ns, option.hardware_ns) : 0.0;
    const double box_pass = ways.box_pass ? gain(option.value_ns, option.box_pass_ns) : 0.0;
    return {box_pass > hardware ? QueryWay::BoxPass : QueryWay::HardwareQuery,
            std::max(hardware, box_pass) > 0.0};
}

void ModelPolicy::ask_each(const OptionPricer& pricer, Ways ways, QueryWriter& writer,
                           OcclusionDecisions& out) {
    first_.clear();
    renewed_.clear();
    for (std::uint32_t i = 0; i < options_.size(); ++i) {
        const CandidateOption& option = options_[i];
        if (option.ask == Ask::Nothing) continue;
        const bool skipped = option.ask == Ask::Renew;
        if (skipped) {
            out.decisions[i].action = OcclusionAction::Skip;
            out.saved_ns += option.render_ns;
        }
        const Choice choice = choose(option, ways);
        if (!choice.pays) continue;
        if (option.ask == Ask::Test) {
            writer.ask({&i, 1}, choice.way, OcclusionAction::DrawAndQuery);
        } else if (choice.way == QueryWay::HardwareQuery && !option.alone) {
            (skipped ? renewed_ : first_).add(i, option.rank);
        } else {
            writer.ask({&i, 1}, choice.way, skipped ? OcclusionAction::Skip : OcclusionAction::QueryFirst);
            if (!skipped)
                out.saved_ns += static_cast<double>(pricer.p_by_rank()[option.rank]) * option.render_ns;
        }
    }
}

void ModelPolicy::ask_groups(const OptionPricer& pricer, QueryWriter& writer, OcclusionDecisions& out) {
    Multiqueries::Price price;
    price.query_ns = writer.costs(QueryWay::HardwareQuery).query_ns;
    price.most = std::max(settings_.max_multiquery, 1u);
    const auto ask_first = [&](std::span<const std::uint32_t> members, double p_all) {
        writer.ask(members, QueryWay::HardwareQuery, OcclusionAction::QueryFirst);
        for (const std::uint32_t member : members) out.saved_ns += p_all * options_[member].render_ns;
    };
    first_.for_each_group(options_, pricer.p_by_rank(), price, ask_first);
    price.draws_on_it = false;
    const auto renew = [&](std::span<const std::uint32_t> members, double) {
        writer.ask(members, QueryWay::HardwareQuery, OcclusionAction::Skip);
    };
    renewed_.for_each_group(options_, pricer.p_by_rank(), price, renew);
}

}  // namespace rhview
