// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Fits the constants of a timing model to measured frames, says how wrong they are, and chooses the terms.
///
/// Errors of timing are proportional to the time: the residual of a sample is (measured - predicted) /
/// predicted. Constants are never negative (Lawson & Hanson 1974). The loss is Tukey's biweight (c = 4.685,
/// 95 % efficient on normal errors) on a scale fixed by the median absolute residual, started from least
/// absolute residuals (Huber 1981; Yohai 1987). Up to a fifth of the samples may be wrong by any factor.
/// Standard errors are the sandwich estimator of the M-estimate (Huber 1967) with each residual divided by
/// one minus its leverage (HC3, MacKinnon & White 1985); they don't know of errors that all samples share.
/// Deterministic: equal samples in equal order give equal bits on one machine. Allocates; thread-safe.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/timing_model/term.h"

namespace rhview {

/// How samples are weighed and how the fit is tested.
struct FitOptions {
    Combination combination = Combination::Sum;  ///< `select_model` tries both, whatever is set here
    /// Of the cross-validation; sample i belongs to fold i mod folds, so shuffle the order of measuring. At
    /// least 2.
    std::size_t folds = 8;
    /// Of the weighted columns scaled to unit length; above it two terms cannot be told apart.
    double worst_condition = 300.0;
    /// A timer's step, as a share of the median time, above which the measurements are refused.
    double coarsest_step = 0.1;
};

/// One constant of a model, and how sure it is.
struct Coefficient {
    Term term = Term::Constant;
    double value_ns = 0.0;
    /// Of the fit without the bound at 0, also where the value is at the bound.
    double standard_error_ns = 0.0;
    double low_ns = 0.0, high_ns = 0.0;  ///< 95 % interval (Student's t), cut at 0
    bool at_bound = false;               ///< the data ask for 0 or less: the value is exactly 0
};

/// Of (predicted - measured) / measured over all samples, outliers too; `absolute_*` of its magnitude.
struct ResidualPercentiles {
    double p5 = 0.0, p50 = 0.0, p95 = 0.0;
    double absolute_p50 = 0.0, absolute_p95 = 0.0;
};

/// The constants that explain the samples best, and how well they do.
struct Fit {
    std::vector<Coefficient> coefficients;  ///< in the order of the terms asked for
    Combination combination = Combination::Sum;
    ResidualPercentiles residuals;
    double r_squared = 0.0;  ///< with the weights of the fit: an outlier counts for nothing
    /// Mean of min(|predicted - measured| / measured, 1) over samples predicted by a fit that never saw them.
    double hold_out_error = 0.0;
    double hold_out_standard_error = 0.0;
    std::vector<double> hold_out_errors;  ///< of each sample, as above
    std::size_t samples = 0;
    std::size_t outliers = 0;    ///< samples with less than a tenth of the full weight
    double timer_step_ns = 0.0;  ///< 0: none that matters was found; otherwise the standard errors hold it
    double condition = 0.0;

    /// By `Term`, 0 for those that the model lacks.
    [[nodiscard]] Constants constants() const;
    [[nodiscard]] const Coefficient* find(Term term) const;  ///< null if the model lacks the term
};

/// What the model says of the work.
double predict_ns(const Fit& fit, const Work& work);

/// The fewest samples with which `term_count` constants are fitted: 2·terms + 4.
constexpr std::size_t fewest_samples(std::size_t term_count) {
    return 2 * term_count + 4;
}

/// Fits the constants of `terms` (at least one, none twice).
/// Errors, one sentence each: too few samples; a count that is negative or not finite; a time that is not
/// positive and finite; a term whose amount is the same in all samples; two terms that rise and fall
/// together, by name; under MaxOfCpuAndGpu, fewer than terms + 2 samples on one side; a timer whose step
/// (found as the greatest common divisor of the times) exceeds `coarsest_step` of the median. A step from 0.2
/// % of the median upwards widens the standard errors: rounding is taken as shared by samples of equal work,
/// truncation as shared by all. Cost: folds + 1 fits, each about 100 passes over samples × terms²; ten times
/// that under MaxOfCpuAndGpu.
Result<Fit> fit_terms(std::span<const Sample> samples, std::span<const Term> terms,
                      const FitOptions& options = {});

/// Widens the standard errors of `fit` by what the constants of its parts scatter: `parts` are fits of the
/// same terms to the same frames, measured at other times (rounds of one experiment). What all samples of a
/// time share (another clock rate, a busy neighbour) is not in the residuals; it is in that scatter. Fewer
/// than two parts, or others' terms, change nothing.
void add_scatter(Fit& fit, std::span<const Fit> parts);

/// One model that `select_model` tried.
struct Candidate {
    std::vector<Term> terms;
    Combination combination = Combination::Sum;
    std::optional<double> hold_out_error;  ///< absent: it could not be fitted, `note` says why
    double hold_out_standard_error = 0.0;
    bool kept = false;
    std::string note;  ///< why it was kept, dropped or impossible: one clause
};

/// The model kept, and every one that was tried.
struct Selection {
    Fit fit;                            ///< of the kept model
    Fit plain;                          ///< T = c1·V + c3·N, the form of the paper, for comparison
    std::vector<Candidate> candidates;  ///< in the order tried; the first is the core
};

/// Starts from c0 + c1·V + c3·N and adds, one at a time, the best of fragments, queries, material changes,
/// sub-draws, primitives, passed samples and the maximum in place of the sum, as long as that lowers the
/// hold-out error by more than two standard errors of the lowering, taken sample by sample, and by a
/// fiftieth of it: both models are judged on the same samples, so what is hard in a sample for both says
/// nothing of their difference; and as long as its 95 % interval lies above 0 (after Hastie, Tibshirani &
/// Friedman 2009, 7.10). Errors: those of `fit_terms` for the core and the plain form. A candidate that
/// cannot be fitted is listed so.
Result<Selection> select_model(std::span<const Sample> samples, const FitOptions& options = {});

}  // namespace rhview
