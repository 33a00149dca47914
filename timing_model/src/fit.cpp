// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/timing_model/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "checks.h"
#include "model_fit.h"

namespace rhview {
namespace {

/// The 97.5 % quantile of Student's t: expansion in 1 / freedom around the normal quantile (Abramowitz &
/// Stegun 1964, 26.7.5); below 0.3 % off from 5 degrees of freedom, which `fewest_samples` guarantees.
double t_quantile(double freedom) {
    constexpr double z = 1.959963984540054;
    constexpr double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    const double g1 = (z3 + z) / 4.0;
    const double g2 = (5.0 * z5 + 16.0 * z3 + 3.0 * z) / 96.0;
    const double g3 = (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / 384.0;
    return z + g1 / freedom + g2 / (freedom * freedom) + g3 / (freedom * freedom * freedom);
}

/// Equal numbers for equal work.
std::vector<int> design_points(std::span<const Sample> samples) {
    std::map<std::array<double, kTermCount>, int> seen;
    std::vector<int> points;
    points.reserve(samples.size());
    for (const Sample& sample : samples) {
        std::array<double, kTermCount> amounts{};
        for (const Term term : kAllTerms) amounts[index_of(term)] = amount_of(term, sample.work);
        points.push_back(seen.emplace(amounts, static_cast<int>(seen.size())).first->second);
    }
    return points;
}

/// Linear between the order statistics.
double percentile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

ResidualPercentiles percentiles_of(std::span<const Sample> samples, const Eigen::VectorXd& predicted) {
    std::vector<double> residuals, magnitudes;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double measured = samples[i].measured_ns;
        residuals.push_back((predicted[static_cast<Eigen::Index>(i)] - measured) / measured);
        magnitudes.push_back(std::abs(residuals.back()));
    }
    std::sort(residuals.begin(), residuals.end());
    std::sort(magnitudes.begin(), magnitudes.end());
    return {percentile(residuals, 0.05), percentile(residuals, 0.5), percentile(residuals, 0.95),
            percentile(magnitudes, 0.5), percentile(magnitudes, 0.95)};
}

double r_squared_of(std::span<const Sample> samples, const RobustFit& fit) {
    const Eigen::VectorXd weight = fit.weights.cwiseQuotient(fit.row_scale.cwiseAbs2());
    Eigen::VectorXd measured(static_cast<Eigen::Index>(samples.size()));
    for (std::size_t i = 0; i < samples.size(); ++i)
        measured[static_cast<Eigen::Index>(i)] = samples[i].measured_ns;
    const double mean = weight.dot(measured) / weight.sum();
    const double total = weight.dot((measured.array() - mean).square().matrix());
    const double rest = weight.dot((measured - fit.predicted).cwiseAbs2());
    return total > 0.0 ? 1.0 - rest / total : 0.0;
}

void cross_validate(std::span<const Sample> samples, std::span<const Term> terms, const FitOptions& options,
                    Fit& fit) {
    const std::size_t folds = std::min(options.folds, samples.size());
    double sum = 0.0, sum_of_squares = 0.0;
    fit.hold_out_errors.assign(samples.size(), 0.0);
    for (std::size_t fold = 0; fold < folds; ++fold) {
        std::vector<Sample> seen;
        for (std::size_t i = 0; i < samples.size(); ++i)
            if (i % folds != fold) seen.push_back(samples[i]);
        const Constants constants =
            constants_of(fit_model(seen, terms, options.combination).robust.constants, terms);
        for (std::size_t i = fold; i < samples.size(); i += folds) {
            const double measured = samples[i].measured_ns;
            const double predicted = predict_ns(constants, options.combination, samples[i].work);
            const double error = std::min(std::abs(predicted - measured) / measured, 1.0);
            fit.hold_out_errors[i] = error;
            sum += error;
            sum_of_squares += error * error;
        }
    }
    const double n = static_cast<double>(samples.size());
    fit.hold_out_error = sum / n;
    const double variance = std::max(0.0, sum_of_squares / n - fit.hold_out_error * fit.hold_out_error);
    fit.hold_out_standard_error = std::sqrt(variance / (n - 1.0));
}

Status check_sides(const ModelFit& model, std::size_t term_count) {
    const auto all = static_cast<std::size_t>(model.design.rows());
    const std::size_t cpu_bound = all - model.gpu_bound;
    const std::size_t fewest = term_count + 2;
    if (model.gpu_bound >= fewest && cpu_bound >= fewest) return success();
    const bool gpu = model.gpu_bound < fewest;
    return Error{
        std::string("the ") + (gpu ? "GPU" : "CPU") + "'s side is the longer one in only " +
        std::to_string(gpu ? model.gpu_bound : cpu_bound) + " of " + std::to_string(all) +
        " samples, too few for a maximum of both sides; measure more work of that side or fit the sum"};
}

std::vector<Coefficient> coefficients_of(const ModelFit& model, std::span<const Term> terms, double step_ns,
                                         std::span<const int> points) {
    const Eigen::MatrixXd covariance = covariance_of(model.robust, model.design, step_ns, points);
    const double t = t_quantile(static_cast<double>(model.design.rows() - model.design.cols()));
    std::vector<Coefficient> result;
    for (std::size_t j = 0; j < terms.size(); ++j) {
        const auto column = static_cast<Eigen::Index>(j);
        Coefficient c;
        c.term = terms[j];
        c.value_ns = model.robust.constants[column];
        c.standard_error_ns = std::sqrt(std::max(0.0, covariance(column, column)));
        c.low_ns = std::max(0.0, c.value_ns - t * c.standard_error_ns);
        c.high_ns = c.value_ns + t * c.standard_error_ns;
        c.at_bound = c.value_ns == 0.0;
        result.push_back(c);
    }
    return result;
}

Status check_all(std::span<const Sample> samples, std::span<const Term> terms, const FitOptions& options,
                 double& step_ns) {
    if (Status status = check_terms(terms, options); !status) return status;
    if (Status status = check_samples(samples, terms.size()); !status) return status;
    if (Status status = check_amounts(samples, terms); !status) return status;
    step_ns = timer_step_ns(samples);
    return check_timer(samples, step_ns, options.coarsest_step);
}

}  // namespace

Constants Fit::constants() const {
    Constants result{};
    for (const Coefficient& c : coefficients) result[index_of(c.term)] = c.value_ns;
    return result;
}

const Coefficient* Fit::find(Term term) const {
    const auto found = std::find_if(coefficients.begin(), coefficients.end(),
                                    [&](const Coefficient& c) { return c.term == term; });
    return found != coefficients.end() ? &*found : nullptr;
}

double predict_ns(const Fit& fit, const Work& work) {
    return predict_ns(fit.constants(), fit.combination, work);
}

Result<Fit> fit_terms(std::span<const Sample> samples, std::span<const Term> terms,
                      const FitOptions& options) {
    Fit fit;
    if (const Status status = check_all(samples, terms, options, fit.timer_step_ns); !status)
        return status.error();
    const ModelFit model = fit_model(samples, terms, options.combination);
    if (options.combination == Combination::MaxOfCpuAndGpu) {
        if (const Status status = check_sides(model, terms.size()); !status) return status.error();
    }
    fit.condition = condition_of(model.design, model.robust.row_scale);
    if (!(fit.condition <= options.worst_condition))
        return collinear_error(model.design, model.robust.row_scale, terms, fit.condition);

    fit.coefficients = coefficients_of(model, terms, fit.timer_step_ns, design_points(samples));
    fit.combination = options.combination;
    fit.residuals = percentiles_of(samples, model.robust.predicted);
    fit.r_squared = r_squared_of(samples, model.robust);
    fit.samples = samples.size();
    fit.outliers = static_cast<std::size_t>((model.robust.weights.array() < 0.1).count());
    cross_validate(samples, terms, options, fit);
    return fit;
}

}  // namespace rhview
