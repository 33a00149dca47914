// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "robust.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "nonnegative.h"

namespace rhview {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTukey = 4.685;         // 95 % efficient on normal errors
constexpr double kMadToSigma = 1.4826;   // of a normal distribution
constexpr double kSmallestError = 1e-9;  // relative: exact data have no scale of their own
constexpr double kConverged = 1e-10;
/// With eight rows and a fifth of outliers, one subset in six is clean.
constexpr int kSubsets = 40;
constexpr int kAbsoluteRounds = 25;
constexpr int kBiweightRounds = 60;

/// Minimises Σ row_weight² (measured - design·x)² over x >= 0, columns scaled to unit length first.
VectorXd solve_weighted(const MatrixXd& design, const VectorXd& measured, const VectorXd& row_weight) {
    const MatrixXd rows = row_weight.asDiagonal() * design;
    const VectorXd length = rows.colwise().norm().transpose();
    const VectorXd scale = length.unaryExpr([](double l) { return l > 0.0 ? 1.0 / l : 0.0; });
    const MatrixXd gram = scale.asDiagonal() * (rows.transpose() * rows) * scale.asDiagonal();
    const VectorXd moment = scale.asDiagonal() * (rows.transpose() * row_weight.cwiseProduct(measured));
    return scale.cwiseProduct(solve_nonnegative(gram, moment));
}

bool has_converged(const VectorXd& before, const VectorXd& now) {
    return ((now - before).array().abs() <= kConverged * now.array().abs()).all();
}

double median(VectorXd values) {
    const auto middle = values.begin() + values.size() / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double robust_deviation(const VectorXd& relative, Index unknowns) {
    const double n = static_cast<double>(relative.size());
    const double freedom = std::max(1.0, n - static_cast<double>(unknowns));
    return std::max(kSmallestError, kMadToSigma * median(relative.cwiseAbs()) * std::sqrt(n / freedom));
}

double biweight(double r) {
    const double t = r / kTukey;
    return std::abs(t) < 1.0 ? (1.0 - t * t) * (1.0 - t * t) : 0.0;
}

/// Derivative of r·biweight(r).
double biweight_slope(double r) {
    const double t = r / kTukey;
    return std::abs(t) < 1.0 ? (1.0 - t * t) * (1.0 - 5.0 * t * t) : 0.0;
}

/// The prediction, so that errors of both signs count alike (weights of 1 / measured pull the fit down);
/// bounded, so that a constant that starts at 0 gets no infinite weight.
VectorXd scale_of_rows(const VectorXd& predicted, const VectorXd& measured) {
    return predicted.cwiseMax(0.01 * measured);
}

void update_residuals(const MatrixXd& design, const VectorXd& measured, RobustFit& fit) {
    fit.predicted = design * fit.constants;
    fit.row_scale = scale_of_rows(fit.predicted, measured);
    fit.residuals = (measured - fit.predicted).cwiseQuotient(fit.row_scale) / fit.deviation;
    fit.weights = fit.residuals.unaryExpr(&biweight);
}

void descend_biweight(const MatrixXd& design, const VectorXd& measured, RobustFit& fit) {
    for (int round = 0; round < kBiweightRounds; ++round) {
        const VectorXd before = fit.constants;
        const VectorXd row_weight = fit.weights.cwiseSqrt().cwiseQuotient(fit.row_scale);
        fit.constants = solve_weighted(design, measured, row_weight);
        update_residuals(design, measured, fit);
        if (has_converged(before, fit.constants)) return;
    }
}

/// Relative to the greater of both times: at most 1, whatever the outlier.
VectorXd bounded_residuals(const VectorXd& predicted, const VectorXd& measured) {
    return (measured - predicted).cwiseQuotient(predicted.cwiseMax(measured)).cwiseAbs();
}

/// The best of least squares over all samples and over small subsets, some of which hold no outlier
/// (Rousseeuw 1984): times that are far too short would lead a fit of all of them.
VectorXd find_start(const MatrixXd& design, const VectorXd& measured) {
    const VectorXd row_weight = measured.cwiseInverse();
    VectorXd best = solve_weighted(design, measured, row_weight);
    double best_loss = bounded_residuals(design * best, measured).sum();
    std::vector<Index> rows(static_cast<std::size_t>(design.cols()) + 1);
    std::uint32_t state = 1;
    for (int subset = 0; subset < kSubsets; ++subset) {
        for (Index& row : rows) {
            state =
                state * 1664525u + 1013904223u;  // Numerical Recipes' generator: the same subsets every time
            row = static_cast<Index>((state >> 8) % static_cast<std::uint32_t>(design.rows()));
        }
        const VectorXd constants = solve_weighted(design(rows, Eigen::all), measured(rows), row_weight(rows));
        const double loss = bounded_residuals(design * constants, measured).sum();
        if (loss < best_loss) {
            best = constants;
            best_loss = loss;
        }
    }
    return best;
}

}  // namespace

VectorXd fit_least_absolute(const MatrixXd& design, const VectorXd& measured) {
    VectorXd constants = find_start(design, measured);
    for (int round = 0; round < kAbsoluteRounds; ++round) {
        const VectorXd predicted = design * constants;
        const VectorXd scale = predicted.cwiseMax(measured);
        const VectorXd absolute = bounded_residuals(predicted, measured).cwiseMax(1e-7);
        const VectorXd next =
            solve_weighted(design, measured, (absolute.cwiseSqrt().cwiseProduct(scale)).cwiseInverse());
        const bool done = ((next - constants).array().abs() <= 1e-5 * next.array().abs()).all();
        constants = next;
        if (done) break;
    }
    return constants;
}

RobustFit fit_robust(const MatrixXd& design, const VectorXd& measured) {
    RobustFit fit;
    fit.constants = fit_least_absolute(design, measured);
    // Twice: the second scale is that of a nearly efficient fit.
    for (int pass = 0; pass < 2; ++pass) {
        fit.predicted = design * fit.constants;
        fit.row_scale = scale_of_rows(fit.predicted, measured);
        fit.deviation =
            robust_deviation((measured - fit.predicted).cwiseQuotient(fit.row_scale), design.cols());
        update_residuals(design, measured, fit);
        descend_biweight(design, measured, fit);
    }
    return fit;
}

MatrixXd covariance_of(const RobustFit& fit, const MatrixXd& design, double step_ns,
                       std::span<const int> design_point) {
    const Index n = design.rows();
    const MatrixXd relative = fit.row_scale.cwiseInverse().asDiagonal() * design;
    const VectorXd scale = relative.colwise().norm().transpose().cwiseInverse();
    const MatrixXd z = relative * scale.asDiagonal();
    const MatrixXd inverse = (z.transpose() * z).ldlt().solve(MatrixXd::Identity(z.cols(), z.cols()));
    const double slope = std::max(0.1, fit.residuals.unaryExpr(&biweight_slope).mean());

    MatrixXd meat = MatrixXd::Zero(z.cols(), z.cols());
    for (Index i = 0; i < n; ++i) {
        const VectorXd row = z.row(i).transpose();
        const double leverage = std::min(0.9, row.dot(inverse * row));
        const double psi = fit.residuals[i] * fit.weights[i] * fit.deviation / (slope * (1.0 - leverage));
        meat += psi * psi * row * row.transpose();
    }
    MatrixXd covariance = inverse * meat * inverse;
    if (step_ns > 0.0) {
        // Rounding is shared by the samples of one design point, truncation (up to half a step more) by all.
        const int points = 1 + *std::max_element(design_point.begin(), design_point.end());
        MatrixXd response = MatrixXd::Zero(z.cols(), points);
        for (Index i = 0; i < n; ++i) {
            response.col(design_point[static_cast<std::size_t>(i)]) +=
                inverse * z.row(i).transpose() * fit.weights[i] / (slope * fit.row_scale[i]);
        }
        const VectorXd all = response.rowwise().sum();
        covariance +=
            step_ns * step_ns * (response * response.transpose() / 12.0 + all * all.transpose() / 4.0);
    }
    return scale.asDiagonal() * covariance * scale.asDiagonal();
}

}  // namespace rhview
