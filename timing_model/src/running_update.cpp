// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/timing_model/running_update.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rhview/base/assert.h"

namespace rhview {
namespace {

/// Of a constant whose standard error nobody stated.
constexpr double kUnstatedError = 0.25;
/// The widest prior of a constant, as a share of it.
constexpr double kWidestError = 0.5;
/// Relative noise of a sample where the profile has no residuals, and the least that is believed.
constexpr double kUsualNoise = 0.05, kLeastNoise = 0.005;
/// What a sample takes off the score of changes: outliers of one sign that stay below a fifth never make a
/// change.
constexpr double kUsualOutliers = 0.25;
/// A percentile of 50 % of |normal| lies at this many standard deviations.
constexpr double kMedianOfNormal = 0.6745;

double square(double value) {
    return value * value;
}

double noise_of(const TimingProfile& profile) {
    if (!profile.residuals) return kUsualNoise;
    return std::max(kLeastNoise, profile.residuals->absolute_p50 / kMedianOfNormal);
}

bool is_usable(const Sample& sample) {
    return std::isfinite(sample.measured_ns) && sample.measured_ns > 0.0 &&
           std::all_of(kAllTerms.begin(), kAllTerms.end(), [&](Term term) {
               const double amount = amount_of(term, sample.work);
               return std::isfinite(amount) && amount >= 0.0;
           });
}

}  // namespace

RunningUpdate::RunningUpdate(TimingProfile profile, const RunningUpdateOptions& options)
    : profile_(std::move(profile)), options_(options), constants_(profile_.constants()) {
    RHVIEW_ASSERT(options_.forgetting > 0.0 && options_.forgetting <= 1.0);
    noise_variance_ = square(noise_of(profile_));
    for (const Term term : kAllTerms) {
        const std::size_t j = index_of(term);
        if (!profile_.constant(term)) continue;
        const double stated = profile_.standard_errors_ns[j].value_or(kUnstatedError * constants_[j]);
        covariance_[j][j] = square(stated);
        largest_variance_[j] = std::max(square(stated), square(kWidestError * constants_[j]));
    }
}

/// The amounts that the predicted time depends on: under a maximum those of the longer side alone.
RunningUpdate::Row RunningUpdate::active_amounts(const Work& work) const {
    const bool is_sum = profile_.combination == Combination::Sum;
    const bool gpu_bound = is_gpu_bound(constants_, work);
    Row row{};
    for (const Term term : kAllTerms) {
        const bool counts = is_sum || term == Term::Constant || is_on_gpu(term) == gpu_bound;
        if (counts && profile_.constant(term)) row[index_of(term)] = amount_of(term, work);
    }
    return row;
}

double RunningUpdate::variance_along(const Row& row) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < kTermCount; ++i)
        for (std::size_t j = 0; j < kTermCount; ++j) sum += row[i] * covariance_[i][j] * row[j];
    return sum;
}

bool RunningUpdate::is_outlier(double residual, double deviation) {
    const bool outlier = std::abs(residual) > options_.outlier_deviations * deviation;
    slow_score_ = std::max(0.0, slow_score_ + (outlier && residual > 0.0 ? 1.0 : -kUsualOutliers));
    fast_score_ = std::max(0.0, fast_score_ + (outlier && residual < 0.0 ? 1.0 : -kUsualOutliers));
    return outlier;
}

void RunningUpdate::widen() {
    for (std::size_t j = 0; j < kTermCount; ++j) {
        covariance_[j].fill(0.0);
        covariance_[j][j] = largest_variance_[j];
    }
    slow_score_ = fast_score_ = 0.0;
    ++changes_;
}

void RunningUpdate::learn(const Row& row, double residual) {
    Row along{};
    for (std::size_t i = 0; i < kTermCount; ++i)
        for (std::size_t j = 0; j < kTermCount; ++j) along[i] += covariance_[i][j] * row[j];
    const double total = options_.forgetting * noise_variance_ + variance_along(row);
    for (std::size_t i = 0; i < kTermCount; ++i)
        constants_[i] = std::max(0.0, constants_[i] + along[i] / total * residual);
    // Symmetric to the last bit: forgetting would make any difference grow without end.
    for (std::size_t i = 0; i < kTermCount; ++i)
        for (std::size_t j = 0; j < kTermCount; ++j)
            covariance_[i][j] = (covariance_[i][j] - along[i] * along[j] / total) / options_.forgetting;
    cap_covariance();
}

/// Scales row and column together: the matrix stays positive semidefinite.
void RunningUpdate::cap_covariance() {
    for (std::size_t j = 0; j < kTermCount; ++j) {
        const double variance = covariance_[j][j];
        if (!(variance > largest_variance_[j])) continue;
        const double factor = std::sqrt(largest_variance_[j] / variance);
        for (std::size_t i = 0; i < kTermCount; ++i) {
            covariance_[i][j] *= factor;
            covariance_[j][i] *= factor;
        }
    }
}

RunningUpdate::Outcome RunningUpdate::observe(const Sample& sample) {
    if (frozen_) return Outcome::Frozen;
    if (!is_usable(sample)) {
        ++invalid_;
        return Outcome::Invalid;
    }
    const double predicted = predict_ns(sample.work);
    const double scale = std::max(predicted, 0.01 * sample.measured_ns);
    Row row = active_amounts(sample.work);
    for (double& amount : row) amount /= scale;
    const double residual = (sample.measured_ns - predicted) / scale;
    const double deviation = std::sqrt(noise_variance_ + std::max(0.0, variance_along(row)));
    if (is_outlier(residual, deviation)) {
        ++outliers_;
        if (std::max(slow_score_, fast_score_) >= options_.outliers_that_are_a_change) widen();
        return Outcome::Outlier;
    }
    learn(row, residual);
    for (const Term term : kAllTerms) {
        if (!profile_.constant(term)) continue;
        profile_.set_constant(term, constants_[index_of(term)]);
        profile_.standard_errors_ns[index_of(term)] =
            std::sqrt(std::max(0.0, covariance_[index_of(term)][index_of(term)]));
    }
    ++learned_;
    return Outcome::Learned;
}

}  // namespace rhview
