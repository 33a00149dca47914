// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "nonnegative.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

namespace rhview {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Keeps the factorisation of equal columns finite; far below what a condition of 300 makes of rounding.
constexpr double kRidge = 1e-12;

/// The unconstrained minimum over the free unknowns, 0 for the others.
VectorXd solve_free(const MatrixXd& gram, const VectorXd& moment, const std::vector<Index>& free) {
    MatrixXd part = gram(free, free);
    part.diagonal().array() += kRidge;
    const VectorXd solution = part.ldlt().solve(moment(free).eval());
    VectorXd x = VectorXd::Zero(moment.size());
    x(free) = solution;
    return x;
}

/// The free unknown that reaches 0 first on the way from `x` to `target`, and how far along it does.
struct Block {
    std::size_t position = 0;
    double step = 1.0;
    bool found = false;
};

Block first_block(const VectorXd& x, const VectorXd& target, const std::vector<Index>& free) {
    Block block;
    for (std::size_t i = 0; i < free.size(); ++i) {
        if (target[free[i]] > 0.0) continue;
        const double step = x[free[i]] > 0.0 ? x[free[i]] / (x[free[i]] - target[free[i]]) : 0.0;
        if (!block.found || step < block.step) block = {i, step, true};
    }
    return block;
}

Index best_entry(const VectorXd& slope, const std::vector<Index>& free, double tolerance) {
    Index best = -1;
    for (Index j = 0; j < slope.size(); ++j) {
        const bool is_free = std::find(free.begin(), free.end(), j) != free.end();
        if (!is_free && slope[j] > tolerance && (best < 0 || slope[j] > slope[best])) best = j;
    }
    return best;
}

}  // namespace

VectorXd solve_nonnegative(const MatrixXd& gram, const VectorXd& moment) {
    VectorXd x = VectorXd::Zero(moment.size());
    std::vector<Index> free;
    const double tolerance = 1e-12 * moment.cwiseAbs().maxCoeff();
    for (Index round = 0; round < 10 * moment.size(); ++round) {
        const VectorXd slope = moment - gram * x;
        const Index entry = best_entry(slope, free, tolerance);
        if (entry < 0) break;
        free.push_back(entry);
        while (!free.empty()) {
            const VectorXd target = solve_free(gram, moment, free);
            const Block block = first_block(x, target, free);
            if (!block.found) {
                x = target;
                break;
            }
            x += block.step * (target - x);
            x[free[block.position]] = 0.0;
            free.erase(free.begin() + static_cast<std::ptrdiff_t>(block.position));
        }
    }
    return x.cwiseMax(0.0);
}

}  // namespace rhview
