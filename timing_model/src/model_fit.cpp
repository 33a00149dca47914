// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "model_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace rhview {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

using Sides = std::vector<bool>;  // true: the GPU's side is the greater

constexpr int kSideRounds = 20;
/// How much dearer than in the sum the GPU's side is taken to be at each start of the search.
constexpr std::array<double, 5> kStarts{1.0, 0.25, 4.0, 1.0 / 16.0, 16.0};

VectorXd times_of(std::span<const Sample> samples) {
    VectorXd times(static_cast<Index>(samples.size()));
    for (std::size_t i = 0; i < samples.size(); ++i) times[static_cast<Index>(i)] = samples[i].measured_ns;
    return times;
}

/// Without sides: the design of the sum.
MatrixXd design_of(std::span<const Sample> samples, std::span<const Term> terms, const Sides& sides) {
    MatrixXd design(static_cast<Index>(samples.size()), static_cast<Index>(terms.size()));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        for (std::size_t j = 0; j < terms.size(); ++j) {
            const bool counts =
                sides.empty() || terms[j] == Term::Constant || is_on_gpu(terms[j]) == sides[i];
            design(static_cast<Index>(i), static_cast<Index>(j)) =
                counts ? amount_of(terms[j], samples[i].work) : 0.0;
        }
    }
    return design;
}

Sides sides_of(std::span<const Sample> samples, Constants constants, double gpu_factor) {
    for (const Term term : kAllTerms)
        if (is_on_gpu(term)) constants[index_of(term)] *= gpu_factor;
    Sides sides(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) sides[i] = is_gpu_bound(constants, samples[i].work);
    return sides;
}

/// Mean of the relative error, relative to the greater of both times.
double loss_of(std::span<const Sample> samples, const Constants& constants) {
    double sum = 0.0;
    for (const Sample& sample : samples) {
        const double predicted = predict_ns(constants, Combination::MaxOfCpuAndGpu, sample.work);
        sum += std::abs(predicted - sample.measured_ns) / std::max(predicted, sample.measured_ns);
    }
    return sum;
}

/// Alternates between fitting and telling the sides (max-affine regression: Magnani & Boyd 2009), from
/// several starts; the sides with the least loss win.
Sides find_sides(std::span<const Sample> samples, std::span<const Term> terms, const VectorXd& times) {
    const Constants sum = constants_of(fit_least_absolute(design_of(samples, terms, {}), times), terms);
    Sides best;
    double best_loss = std::numeric_limits<double>::infinity();
    for (const double start : kStarts) {
        Sides sides = sides_of(samples, sum, start);
        for (int round = 0; round < kSideRounds; ++round) {
            const Constants constants =
                constants_of(fit_least_absolute(design_of(samples, terms, sides), times), terms);
            if (const double loss = loss_of(samples, constants); loss < best_loss) {
                best_loss = loss;
                best = sides_of(samples, constants, 1.0);
            }
            Sides next = sides_of(samples, constants, 1.0);
            if (next == sides) break;
            sides = std::move(next);
        }
    }
    return best;
}

}  // namespace

Constants constants_of(const VectorXd& values, std::span<const Term> terms) {
    Constants constants{};
    for (std::size_t j = 0; j < terms.size(); ++j)
        constants[index_of(terms[j])] = values[static_cast<Index>(j)];
    return constants;
}

ModelFit fit_model(std::span<const Sample> samples, std::span<const Term> terms, Combination combination) {
    const VectorXd times = times_of(samples);
    ModelFit fit;
    Sides sides;
    if (combination == Combination::MaxOfCpuAndGpu) {
        sides = find_sides(samples, terms, times);
        fit.gpu_bound = static_cast<std::size_t>(std::count(sides.begin(), sides.end(), true));
    }
    fit.design = design_of(samples, terms, sides);
    fit.robust = fit_robust(fit.design, times);
    return fit;
}

}  // namespace rhview
