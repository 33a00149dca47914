// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "checks.h"

namespace rhview {
namespace {

constexpr std::array kCore{Term::Constant, Term::Indices, Term::DrawCalls};
constexpr std::array kPlain{Term::Indices, Term::DrawCalls};
/// What a term must lower the error by: standard errors of the lowering, and a share of the error.
constexpr double kDeviations = 2.0, kLeastShare = 0.02;
constexpr std::array kExtra{Term::Fragments, Term::Queries,    Term::MaterialChanges,
                            Term::SubDraws,  Term::Primitives, Term::PassedSamples};

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

/// A term whose price is not told from 0 would cost its standard error wherever there is much of it.
bool is_told_from_0(const Fit& fit, Term term) {
    const Coefficient* coefficient = fit.find(term);
    return coefficient != nullptr && coefficient->low_ns > 0.0;
}

std::optional<Term> added_term(const Candidate& trial, const Candidate& kept) {
    if (trial.terms.size() == kept.terms.size()) return std::nullopt;
    return trial.terms.back();
}

Trial* best_of(std::vector<Trial>& trials, const Candidate& kept) {
    Trial* best = nullptr;
    for (Trial& trial : trials) {
        const std::optional<double>& error = trial.candidate.hold_out_error;
        const std::optional<Term> added = added_term(trial.candidate, kept);
        if (error && added && !is_told_from_0(*trial.fit, *added)) continue;
        if (error && (best == nullptr || *error < *best->candidate.hold_out_error)) best = &trial;
    }
    return best;
}

std::string percent(double share) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.2g %%", 100.0 * share);
    return text.data();
}

/// How much `trial` lowers the hold-out error of `kept`, and the standard error of that.
struct Gain {
    double mean = 0.0;
    double standard_error = 0.0;

    [[nodiscard]] double threshold(const Fit& kept) const {
        return std::max(kDeviations * standard_error, kLeastShare * kept.hold_out_error);
    }
};

Gain gain_of(const Fit& kept, const Fit& trial) {
    const auto n = static_cast<double>(kept.hold_out_errors.size());
    double sum = 0.0, sum_of_squares = 0.0;
    for (std::size_t i = 0; i < kept.hold_out_errors.size(); ++i) {
        const double lower = kept.hold_out_errors[i] - trial.hold_out_errors[i];
        sum += lower;
        sum_of_squares += lower * lower;
    }
    const double mean = sum / n;
    return {mean, std::sqrt(std::max(0.0, sum_of_squares / n - mean * mean) / (n - 1.0))};
}

/// `added` is the term that the trial has more; absent where the combination changed.
std::string note_of(const Fit& kept, const Fit& trial, std::optional<Term> added, bool is_kept,
                    bool is_best) {
    const Gain gain = gain_of(kept, trial);
    const std::string lowers =
        "lowers the hold-out error by " + percent(gain.mean) + " ± " + percent(gain.standard_error);
    if (is_kept) return "kept: " + lowers;
    if (added && !is_told_from_0(trial, *added)) return "dropped: its price is not told from 0";
    if (gain.mean <= 0.0) return "dropped: does not lower the hold-out error";
    if (gain.mean > gain.threshold(kept) && !is_best)
        return "dropped at this step: another term lowers it more";
    return "dropped: " + lowers + ", not more than " + percent(gain.threshold(kept));
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
        Trial* best = best_of(trials, kept);
        if (best != nullptr) {
            const Gain gain = gain_of(selection.fit, *best->fit);
            grows = gain.mean > gain.threshold(selection.fit);
        } else {
            grows = false;
        }
        for (Trial& trial : trials) {
            const bool is_best = &trial == best;
            trial.candidate.kept = grows && is_best;
            if (trial.fit)
                trial.candidate.note = note_of(selection.fit, *trial.fit, added_term(trial.candidate, kept),
                                               trial.candidate.kept, is_best);
            selection.candidates.push_back(trial.candidate);
        }
        if (!grows) break;
        kept = best->candidate;
        selection.fit = std::move(*best->fit);
    }
    return selection;
}

}  // namespace rhview
