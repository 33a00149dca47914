// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What is wrong with samples or a design, in a sentence.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "rhview/timing_model/fit.h"

namespace rhview {

/// Six significant digits.
std::string number_text(double value);

Status check_terms(std::span<const Term> terms, const FitOptions& options);
Status check_samples(std::span<const Sample> samples, std::size_t term_count);
/// A term with the same amount in all samples says nothing of its price.
Status check_amounts(std::span<const Sample> samples, std::span<const Term> terms);

/// Greatest common divisor of the measured times, if it is at least 0.2 % of their median; else 0.
double timer_step_ns(std::span<const Sample> samples);
Status check_timer(std::span<const Sample> samples, double step_ns, double coarsest_step);

/// Condition of `design` with rows divided by `row_scale` and columns scaled to unit length.
double condition_of(const Eigen::MatrixXd& design, const Eigen::VectorXd& row_scale);
/// The sentence that names the two terms of the worst direction.
Error collinear_error(const Eigen::MatrixXd& design, const Eigen::VectorXd& row_scale,
                      std::span<const Term> terms, double condition);

}  // namespace rhview
