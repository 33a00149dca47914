// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "costs.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "border.h"
#include "rhview/timing_model/fit.h"
#include "rhview/timing_model/profile.h"

namespace rhview::capi {
namespace {

/// A way of asking that takes longer, ns, is one that the device lacks: profiles say so by an absurd price.
constexpr double kNever = 1e12;

bool is_cost(double ns) {
    return std::isfinite(ns) && ns >= 0.0;
}

bool is_cost(const rhview_query_costs& costs) {
    return is_cost(costs.frame_ns) && is_cost(costs.query_ns) && is_cost(costs.box_ns) &&
           is_cost(costs.pixel_ns) && is_cost(costs.draw_ns);
}

AnswerCosts answer_costs(uint32_t has_it, const rhview_query_costs& costs) {
    if (has_it == 0) return {.query_ns = std::numeric_limits<double>::infinity()};
    return {costs.frame_ns, costs.query_ns, costs.box_ns, costs.pixel_ns, costs.draw_ns};
}

void write(const AnswerCosts& costs, uint32_t& has_it, rhview_query_costs& out) {
    has_it = costs.query_ns + costs.frame_ns < kNever ? 1 : 0;
    if (has_it != 0) out = {costs.frame_ns, costs.query_ns, costs.box_ns, costs.pixel_ns, costs.draw_ns};
}

rhview_costs costs_of(const TimingProfile& profile, bool is_multi_draw) {
    rhview_costs costs{};
    const double sub_draw_ns = profile.sub_draw_ns.value_or(is_multi_draw ? profile.c3_ns : 0.0);
    costs.index_ns = profile.c1_ns;
    costs.draw_ns = is_multi_draw ? sub_draw_ns : profile.c3_ns + sub_draw_ns;
    costs.call_ns = is_multi_draw ? profile.c3_ns : 0.0;
    // A triangle in the frustum takes its three indices and a primitive.
    costs.shown_index_ns = profile.c1_ns + profile.primitive_ns.value_or(0.0) / 3.0;
    if (profile.answer_costs) {
        write(profile.answer_costs->hardware, costs.has_hardware_queries, costs.hardware_queries);
        write(profile.answer_costs->box_pass, costs.has_box_pass, costs.box_pass);
    }
    return costs;
}

}  // namespace

rhview_status take_costs(const rhview_costs* given, KnownCosts& costs) noexcept {
    costs = {};
    if (given == nullptr) return RHVIEW_OK;
    rhview_costs taken;
    if (const rhview_status status = take(given, "rhview_costs", taken); status != RHVIEW_OK) return status;
    for (const double ns : {taken.index_ns, taken.draw_ns, taken.call_ns, taken.shown_index_ns})
        if (!is_cost(ns))
            return fail(RHVIEW_INVALID_ARGUMENT, "rhview_costs: a cost is negative or no number");
    if (!is_cost(taken.hardware_queries) || !is_cost(taken.box_pass))
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_costs: the cost of a query is negative or no number");
    if (taken.index_ns == 0.0 && taken.draw_ns == 0.0)
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_costs: neither an index nor a draw costs anything");
    costs.draw = {taken.index_ns, taken.draw_ns, taken.call_ns};
    costs.shown_index_ns = taken.shown_index_ns;
    if (taken.has_hardware_queries != 0 || taken.has_box_pass != 0)
        costs.queries = {answer_costs(taken.has_hardware_queries, taken.hardware_queries),
                         answer_costs(taken.has_box_pass, taken.box_pass)};
    return RHVIEW_OK;
}

}  // namespace rhview::capi

using namespace rhview::capi;

rhview_status rhview_costs_load(const char* file, uint32_t is_multi_draw, rhview_costs* costs) {
    return guarded([&] {
        if (file == nullptr) return fail(RHVIEW_INVALID_ARGUMENT, "rhview_costs_load: file is null");
        const auto profile = rhview::load_profile(file);
        if (!profile) return fail(RHVIEW_INVALID_DATA, profile.error().message);
        return give(costs_of(*profile, is_multi_draw != 0), "rhview_costs", costs);
    });
}

rhview_status rhview_costs_fit(const rhview_frame_sample* samples, size_t count, rhview_costs* costs) {
    return guarded([&] {
        if (samples == nullptr && count > 0)
            return fail(RHVIEW_INVALID_ARGUMENT, "rhview_costs_fit: samples is null");
        rhview_costs taken;
        if (const rhview_status status = take(costs, "rhview_costs", taken); status != RHVIEW_OK)
            return status;
        std::vector<rhview::Sample> measured(count);
        for (std::size_t i = 0; i < count; ++i)
            measured[i] = {{.indices = samples[i].indices, .draw_calls = samples[i].draw_calls},
                           samples[i].time_ns};
        constexpr std::array kTerms{rhview::Term::Constant, rhview::Term::Indices, rhview::Term::DrawCalls};
        const auto fit = rhview::fit_terms(measured, kTerms);
        if (!fit) return fail(RHVIEW_INVALID_DATA, fit.error().message);
        taken.index_ns = fit->find(rhview::Term::Indices)->value_ns;
        taken.draw_ns = fit->find(rhview::Term::DrawCalls)->value_ns;
        return give(taken, "rhview_costs", costs);
    });
}
