// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Fits a sum, or a maximum of two sums, to samples that were checked.
#pragma once

#include <span>

#include "rhview/timing_model/fit.h"
#include "robust.h"

namespace rhview {

/// A maximum is linear where it is known which side is greater: a row holds 0 for the terms of the other
/// side.
struct ModelFit {
    Eigen::MatrixXd design;
    RobustFit robust;
    std::size_t gpu_bound = 0;  ///< samples on the GPU's side; only under MaxOfCpuAndGpu
};

ModelFit fit_model(std::span<const Sample> samples, std::span<const Term> terms, Combination combination);

Constants constants_of(const Eigen::VectorXd& values, std::span<const Term> terms);

}  // namespace rhview
