// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <random>

namespace rhview {

/// Seeded numbers that are the same with every standard library.
class Uniform {
  public:
    explicit Uniform(std::uint32_t seed) : engine_(seed) {}
    double operator()(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
    }
    double log(double low, double high) { return std::exp2((*this)(std::log2(low), std::log2(high))); }
    glm::dvec3 point(double reach) {
        return {(*this)(-reach, reach), (*this)(-reach, reach), (*this)(-reach, reach)};
    }

  private:
    std::mt19937 engine_;
};

}  // namespace rhview
