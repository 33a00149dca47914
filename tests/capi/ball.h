// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "rhview/rhview.h"

namespace rhview {

/// A ball of radius 1 whose triangles share their corners, dented.
struct Ball {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    explicit Ball(int rings) {
        for (int i = 0; i <= rings; ++i)
            for (int k = 0; k < 2 * rings; ++k) {
                const double a = 3.14159265358979 * i / rings, b = 3.14159265358979 * k / rings;
                const double r = 1.0 - 0.05 * (1.0 + std::sin(3.0 * a) * std::cos(3.0 * b));
                positions.emplace_back(r * std::sin(a) * std::cos(b), r * std::cos(a),
                                       r * std::sin(a) * std::sin(b));
            }
        const auto at = [&](int i, int k) {
            return static_cast<std::uint32_t>(i * 2 * rings + k % (2 * rings));
        };
        for (int i = 0; i < rings; ++i)
            for (int k = 0; k < 2 * rings; ++k)
                indices.insert(indices.end(), {at(i, k), at(i, k + 1), at(i + 1, k), at(i, k + 1),
                                               at(i + 1, k + 1), at(i + 1, k)});
    }

    [[nodiscard]] rhview_mesh mesh() const {
        return {&positions.data()->x, 0, positions.size(), indices.data(), indices.size(), 0, 0};
    }
};

}  // namespace rhview
