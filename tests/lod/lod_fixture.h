// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "rhview/lod/lod_selection.h"
#include "rhview/lod/projected_error.h"
#include "uniform.h"

namespace rhview {

/// A chain of these triangle counts, finest first, with these errors.
inline LodChain made_chain(const std::vector<std::uint32_t>& triangles, const std::vector<float>& errors) {
    LodChain chain;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        chain.levels.own().push_back({0, 3 * triangles[i], errors[i], 0});
    return chain;
}

/// Each level has a fourth of the triangles of the one before at twice the error.
inline LodChain usual_chain(std::uint32_t triangles, std::size_t levels, float error) {
    std::vector<std::uint32_t> counts{triangles};
    std::vector<float> errors{0.0f};
    for (std::size_t i = 1; i < levels; ++i) {
        counts.push_back(counts.back() / 4);
        errors.push_back(i == 1 ? error : 2.0f * errors.back());
    }
    return made_chain(counts, errors);
}

inline LodChain random_chain(Uniform& uniform, std::size_t max_levels) {
    std::vector<std::uint32_t> counts{static_cast<std::uint32_t>(uniform(20, 2000))};
    std::vector<float> errors{0.0f};
    const auto levels = static_cast<std::size_t>(uniform(1, static_cast<double>(max_levels) + 0.999));
    while (counts.size() < levels && counts.back() > 4) {
        counts.push_back(static_cast<std::uint32_t>(uniform(0.1, 0.8) * counts.back()) + 1);
        errors.push_back(errors.back() + static_cast<float>(uniform.log(0.001, 1.0)));
    }
    return made_chain(counts, errors);
}

inline double error_px(const LodChain& chain, const LodObject& object, std::uint32_t level) {
    return projected_error_px(chain.levels[level].error, object.pixels_per_unit);
}

}  // namespace rhview
