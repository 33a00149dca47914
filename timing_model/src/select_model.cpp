// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <utility>

#include "checks.h"

namespace rhview {
namespace {

constexpr std::array kCore{Term::Constant, Term::Indices, Term::DrawCalls};
constexpr std::array kPlain{Term::Indices, Term::DrawCalls};
constexpr std::array kExtra{Term::Fragments, Term::Queries, Term::MaterialChanges, Term::SubDraws};

struct Trial {
    Candidate candidate;
    Result<Fit> fit;
};

Trial try_model(std::span<const Sample> samples, std::vector<Term> terms, FitOptions options,
                Combination combination) {
    options.combination = combination;
    Result<Fit> fit = fit_terms(samples, terms, options);
    Candidate candidate;
    candidate.terms = std::move(terms);
    candidate.combination = combination;
    if (fit) {
        candidate.hold_out_error = fit->hold_out_error;
        candidate.hold_out_standard_error = fit->hold_out_standard_error;
    } else {
        candidate.note = "could not be fitted: " + fit.error().message;
    }
    return {std::move(candidate), std::move(fit)};
}

/// Every model that is one step larger than `kept`.
std::vector<Trial> larger_models(std::span<const Sample> samples, const Candidate& kept,
                                 const FitOptions& options) {
    std::vector<Trial> trials;
    for (const Term extra : kExtra) {
        if (std::find(kept.terms.begin(), kept.terms.end(), extra) != kept.terms.end()) continue;
        std::vector<Term> terms = kept.terms;
        terms.push_back(extra);
        trials.push_back(try_model(samples, std::move(terms), options, kept.combination));
    }
    if (kept.combination == Combination::Sum)
        trials.push_back(try_model(samples, kept.terms, options, Combination::MaxOfCpuAndGpu));
    return trials;
}

Trial* best_of(std::vector<Trial>& trials) {
    Trial* best = nullptr;
    for (Trial& trial : trials) {
        const std::optional<double>& error = trial.candidate.hold_out_error;
        if (error && (best == nullptr || *error < *best->candidate.hold_out_error)) best = &trial;
    }
    return best;
}

std::string percent(double share) {
    return number_text(100.0 * share) + " %";
}

std::string note_of(const Fit& kept, const Candidate& candidate, bool is_kept, bool is_best) {
    const double gain = kept.hold_out_error - *candidate.hold_out_error;
    const std::string threshold = " one standard error, " + percent(kept.hold_out_standard_error);
    if (is_kept) return "kept: lowers the hold-out error by " + percent(gain) + ", more than" + threshold;
    if (gain <= 0.0) return "dropped: does not lower the hold-out error";
    if (gain > kept.hold_out_standard_error && !is_best)
        return "dropped at this step: another term lowers it more";
    return "dropped: lowers the hold-out error by " + percent(gain) + ", not more than" + threshold;
}

}  // namespace

Result<Selection> select_model(std::span<const Sample> samples, const FitOptions& options) {
    FitOptions plain_options = options;
    plain_options.combination = Combination::Sum;
    Result<Fit> plain = fit_terms(samples, kPlain, plain_options);
    Trial core = try_model(samples, {kCore.begin(), kCore.end()}, options, Combination::Sum);
    if (!core.fit) return core.fit.error();
    if (!plain) return plain.error();

    core.candidate.kept = true;
    core.candidate.note = "the core";
    Candidate kept = core.candidate;
    Selection selection{std::move(*core.fit), std::move(*plain), {std::move(core.candidate)}};
    for (bool grows = true; grows;) {
        std::vector<Trial> trials = larger_models(samples, kept, options);
        Trial* best = best_of(trials);
        grows = best != nullptr && selection.fit.hold_out_error - *best->candidate.hold_out_error >
                                       selection.fit.hold_out_standard_error;
        for (Trial& trial : trials) {
            const bool is_best = &trial == best;
            trial.candidate.kept = grows && is_best;
            if (trial.fit)
                trial.candidate.note = note_of(selection.fit, trial.candidate, trial.candidate.kept, is_best);
            selection.candidates.push_back(trial.candidate);
        }
        if (!grows) break;
        kept = best->candidate;
        selection.fit = std::move(*best->fit);
    }
    return selection;
}

}  // namespace rhview
