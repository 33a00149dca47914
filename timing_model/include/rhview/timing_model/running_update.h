// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Follows slow changes of a machine (clocks, drivers, load) while frames are drawn.
///
/// Recursive least squares on relative residuals with exponential forgetting (Ljung 1999, chapter 11), from
/// the profile with its standard errors as prior. The covariance of each constant is capped, so that a term
/// that stays away for long does not make the next sample all-powerful.
#pragma once

#include <array>
#include <cstdint>

#include "rhview/timing_model/profile.h"

namespace rhview {

/// How fast to forget, and what to take for an outlier.
struct RunningUpdateOptions {
    /// In (0, 1]: a sample that is n samples old counts λⁿ. 0.98 remembers about 50 frames.
    double forgetting = 0.98;
    /// A sample further off than this many standard deviations of the prediction is an outlier.
    double outlier_deviations = 5.0;
    /// Outliers that are all too slow, or all too fast, count 1 each, every other sample takes off a quarter;
    /// at this score the machine has changed: the prior is widened to half of each constant and learning goes
    /// on (Page 1954).
    double outliers_that_are_a_change = 8.0;
};

/// Not thread-safe. Observing costs some hundred flops and allocates nothing.
class RunningUpdate {
  public:
    /// What became of a sample.
    enum class Outcome { Learned, Outlier, Invalid, Frozen };

    /// Learns the constants that the profile has; one without a standard error is taken as known to a quarter
    /// of its value. The profile is valid.
    explicit RunningUpdate(TimingProfile profile, const RunningUpdateOptions& options = {});

    /// A sample with a negative or non-finite number, or no time, is `Invalid`. Only `Learned` moves the
    /// constants.
    Outcome observe(const Sample& sample);

    void set_frozen(bool frozen) { frozen_ = frozen; }
    [[nodiscard]] bool is_frozen() const { return frozen_; }

    /// The constants and standard errors of now; percentiles and hold-out error are still the calibration's.
    [[nodiscard]] const TimingProfile& profile() const { return profile_; }
    [[nodiscard]] double predict_ns(const Work& work) const { return profile_.predict_ns(work); }

    [[nodiscard]] std::uint64_t learned_count() const { return learned_; }
    [[nodiscard]] std::uint64_t outlier_count() const { return outliers_; }
    [[nodiscard]] std::uint64_t invalid_count() const { return invalid_; }
    [[nodiscard]] std::uint64_t change_count() const { return changes_; }

  private:
    using Row = std::array<double, kTermCount>;

    [[nodiscard]] Row active_amounts(const Work& work) const;
    [[nodiscard]] double variance_along(const Row& row) const;
    bool is_outlier(double residual, double deviation);
    void widen();
    void learn(const Row& row, double residual);
    void cap_covariance();

    TimingProfile profile_;
    RunningUpdateOptions options_;
    Constants constants_{};
    std::array<Row, kTermCount> covariance_{};
    Row largest_variance_{};
    double noise_variance_ = 0.0;
    bool frozen_ = false;
    double slow_score_ = 0.0, fast_score_ = 0.0;
    std::uint64_t learned_ = 0, outliers_ = 0, invalid_ = 0, changes_ = 0;
};

}  // namespace rhview
