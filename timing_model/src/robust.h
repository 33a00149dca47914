// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Robust non-negative regression with proportional errors: one linear model.
#pragma once

#include <Eigen/Core>
#include <span>

namespace rhview {

/// Row i of `design` times `constants` is `predicted[i]`.
struct RobustFit {
    Eigen::VectorXd constants;
    Eigen::VectorXd predicted;
    Eigen::VectorXd residuals;  ///< (measured - predicted) / scale of the row, in units of `deviation`
    Eigen::VectorXd row_scale;  ///< what a residual is relative to: the prediction, bounded from below
    Eigen::VectorXd weights;    ///< of the biweight, 1 to 0
    double deviation = 0.0;     ///< robust standard deviation of a relative residual
};

/// `measured` is positive, `design` not negative.
RobustFit fit_robust(const Eigen::MatrixXd& design, const Eigen::VectorXd& measured);

/// Cheaper and rougher: least absolute relative residuals, enough to tell which side of a maximum a sample is
/// on.
Eigen::VectorXd fit_least_absolute(const Eigen::MatrixXd& design, const Eigen::VectorXd& measured);

/// The covariance of the constants without the bound at 0. `step_ns` is the timer's, `design_point[i]`
/// numbers the samples of equal work.
Eigen::MatrixXd covariance_of(const RobustFit& fit, const Eigen::MatrixXd& design, double step_ns,
                              std::span<const int> design_point);

}  // namespace rhview
