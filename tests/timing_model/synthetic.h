// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Samples of a machine whose constants are known.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "rhview/timing_model/term.h"

namespace rhview::test {

/// Same numbers on every machine: std::mt19937 is specified, the distributions of the standard library are
/// not.
class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}

    /// In (0, 1).
    double uniform() { return (static_cast<double>(engine_()) + 0.5) / 4294967296.0; }
    /// Log-uniform between the two.
    double spread(double low, double high) { return low * std::pow(high / low, uniform()); }
    /// Box & Muller 1958.
    double normal() {
        const double radius = std::sqrt(-2.0 * std::log(uniform()));
        return radius * std::cos(6.283185307179586 * uniform());
    }

  private:
    std::mt19937 engine_;
};

/// A design over which every term varies on its own.
inline Work random_work(Random& random) {
    Work work;
    work.indices = std::floor(random.spread(1e3, 2e8));
    work.draw_calls = std::floor(random.spread(1.0, 2e4));
    work.sub_draws = work.draw_calls + std::floor(random.spread(1.0, 4e4));
    work.queries = std::floor(random.spread(1.0, 600.0)) - 1.0;
    work.material_changes = std::floor(random.spread(1.0, 3e3));
    work.fragments = std::floor(random.spread(1e4, 4e6));
    work.primitives = std::floor(work.indices * random.spread(0.01, 0.3));
    work.passed_samples = std::floor(random.spread(1e4, 4e6));
    return work;
}

/// Times are predicted × (1 + noise × normal), the normal cut at ±4 so that no time is negative.
inline std::vector<Sample> samples_of(const Constants& constants, Combination combination, std::size_t count,
                                      double noise, std::uint32_t seed) {
    Random random(seed);
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < count; ++i) {
        const Work work = random_work(random);
        const double error = noise * std::fmin(4.0, std::fmax(-4.0, random.normal()));
        samples.push_back({work, predict_ns(constants, combination, work) * (1.0 + error)});
    }
    return samples;
}

/// c0 = 50 µs, c1 = 0.3 ns, c3 = 400 ns.
inline constexpr Constants kCoreMachine{50e3, 0.3, 400.0, 0.0, 0.0, 0.0, 0.0};
inline constexpr std::array kCoreTerms{Term::Constant, Term::Indices, Term::DrawCalls};

}  // namespace rhview::test
