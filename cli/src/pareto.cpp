// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "pareto.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace rhview::cli {
namespace {

constexpr std::array kModes{"exact", "latent", "latent:visible-pixels=4", "latent:visible-pixels=16",
                            "latent:visible-pixels=64"};
constexpr std::array kLodErrors{"0", "0.5", "1", "2", "4", "8"};

double or_worst(double value) {
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

}  // namespace

std::string pareto_methods(bool levels) {
    std::vector<std::string> methods;
    for (const char* mode : kModes) {
        if (!levels) methods.push_back(fmt::format("rhview:mode={}", mode));
        for (const char* error : kLodErrors)
            if (levels) methods.push_back(fmt::format("rhview:mode={}:lod-error={}", mode, error));
    }
    return fmt::format("{}", fmt::join(methods, ","));
}

std::vector<std::size_t> pareto_front(std::span<const double> costs, std::span<const double> errors) {
    std::vector<std::size_t> order(costs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto key = [&](std::size_t i) { return std::tuple(or_worst(errors[i]), or_worst(costs[i]), i); };
    std::ranges::sort(order, {}, key);
    std::vector<std::size_t> front;
    for (const std::size_t i : order) {
        const bool has_equal = !front.empty() && or_worst(costs[front.back()]) == or_worst(costs[i]) &&
                               or_worst(errors[front.back()]) == or_worst(errors[i]);
        if (front.empty() || has_equal || or_worst(costs[i]) < or_worst(costs[front.back()]))
            front.push_back(i);
    }
    return front;
}

}  // namespace rhview::cli
