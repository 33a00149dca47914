// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "checks.h"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

namespace rhview {
namespace {

/// Below this share of the median a step drowns in any real noise.
constexpr double kStepThatMatters = 0.002;

bool is_count(double value) {
    return std::isfinite(value) && value >= 0.0;
}

double median_ns(std::span<const Sample> samples) {
    std::vector<double> times;
    for (const Sample& sample : samples) times.push_back(sample.measured_ns);
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end());
    return *middle;
}

Eigen::MatrixXd unit_columns(const Eigen::MatrixXd& design, const Eigen::VectorXd& row_scale) {
    Eigen::MatrixXd z = row_scale.cwiseInverse().asDiagonal() * design;
    for (Eigen::Index j = 0; j < z.cols(); ++j) {
        const double length = z.col(j).norm();
        if (length > 0.0) z.col(j) /= length;
    }
    return z;
}

std::string quoted(Term term) {
    return std::string(name_of(term));
}

}  // namespace

std::string number_text(double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

Status check_terms(std::span<const Term> terms, const FitOptions& options) {
    if (terms.empty()) return Error{"the model has no term; name at least one"};
    for (std::size_t i = 0; i < terms.size(); ++i) {
        if (std::find(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(i), terms[i]) !=
            terms.begin() + static_cast<std::ptrdiff_t>(i))
            return Error{"the model names the term " + quoted(terms[i]) + " twice; name it once"};
    }
    if (options.folds < 2) return Error{"the cross-validation needs at least 2 folds"};
    return success();
}

Status check_samples(std::span<const Sample> samples, std::size_t term_count) {
    if (samples.size() < fewest_samples(term_count)) {
        return Error{std::to_string(samples.size()) + " samples are too few to fit " +
                     std::to_string(term_count) + (term_count == 1 ? " term" : " terms") +
                     "; measure at least " + std::to_string(fewest_samples(term_count))};
    }
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::string place = "sample " + std::to_string(i) + ": ";
        for (const Term term : kAllTerms) {
            const double amount = amount_of(term, samples[i].work);
            if (!is_count(amount))
                return Error{place + quoted(term) + " is " + number_text(amount) +
                             "; a count must be finite and not negative"};
        }
        const double time = samples[i].measured_ns;
        if (!std::isfinite(time) || time <= 0.0) {
            return Error{
                place + "the measured time is " + number_text(time) +
                " ns; a time must be finite and positive, so the timer did not run or is too coarse"};
        }
    }
    return success();
}

Status check_amounts(std::span<const Sample> samples, std::span<const Term> terms) {
    for (const Term term : terms) {
        if (term == Term::Constant) continue;
        const double first = amount_of(term, samples.front().work);
        const bool varies = std::any_of(samples.begin(), samples.end(), [&](const Sample& sample) {
            return amount_of(term, sample.work) != first;
        });
        if (!varies)
            return Error{"all samples have the same " + quoted(term) + " (" + number_text(first) +
                         "), so its price cannot be told; vary it"};
    }
    return success();
}

double timer_step_ns(std::span<const Sample> samples) {
    const double median = median_ns(samples);
    double divisor = 0.0;
    for (const Sample& sample : samples) {
        // Euclid on reals: what is left below the tolerance is rounding of the values.
        double a = sample.measured_ns, b = divisor;
        const double tolerance = 1e-9 * std::max(a, median);
        while (b > tolerance) {
            const double rest = std::fmod(a, b);
            a = b;
            b = b - rest < tolerance ? 0.0 : rest;
        }
        divisor = a;
        if (divisor < kStepThatMatters * median) return 0.0;
    }
    return divisor;
}

Status check_timer(std::span<const Sample> samples, double step_ns, double coarsest_step) {
    const double median = median_ns(samples);
    if (step_ns <= coarsest_step * median) return success();
    return Error{"the timer counts in steps of " + number_text(step_ns) +
                 " ns, too coarse for a median time of " + number_text(median) +
                 " ns; repeat the work within one measurement or take a finer timer"};
}

double condition_of(const Eigen::MatrixXd& design, const Eigen::VectorXd& row_scale) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(unit_columns(design, row_scale));
    const auto& values = svd.singularValues();
    const double least = values[values.size() - 1];
    return least > 0.0 ? values[0] / least : std::numeric_limits<double>::infinity();
}

Error collinear_error(const Eigen::MatrixXd& design, const Eigen::VectorXd& row_scale,
                      std::span<const Term> terms, double condition) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(unit_columns(design, row_scale), Eigen::ComputeThinV);
    Eigen::VectorXd share = svd.matrixV().col(svd.matrixV().cols() - 1).cwiseAbs();
    Eigen::Index first = 0, second = 0;
    share.maxCoeff(&first);
    share[first] = -1.0;
    share.maxCoeff(&second);
    const auto [low, high] = std::minmax(first, second);
    return Error{"the terms " + quoted(terms[static_cast<std::size_t>(low)]) + " and " +
                 quoted(terms[static_cast<std::size_t>(high)]) + " rise and fall together (condition " +
                 number_text(condition) + "), so their prices cannot be told apart; vary them independently"};
}

}  // namespace rhview
