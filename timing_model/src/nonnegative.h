// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Non-negative least squares on normal equations.
#pragma once

#include <Eigen/Core>

namespace rhview {

/// The x >= 0 that minimises xᵀ·gram·x / 2 - momentᵀ·x; `gram` is symmetric, positive semidefinite, with a
/// unit diagonal (a zero row and column gives 0). For a handful of unknowns: cost about unknowns⁴. Source:
/// Lawson & Hanson 1974, chapter 23, on the Gram matrix (Bro & de Jong 1997).
Eigen::VectorXd solve_nonnegative(const Eigen::MatrixXd& gram, const Eigen::VectorXd& moment);

}  // namespace rhview
