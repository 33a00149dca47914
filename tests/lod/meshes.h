// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "rhview/lod/lod_chain.h"

namespace rhview {

struct TestMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    [[nodiscard]] LodMesh mesh() const { return {positions, indices}; }
    void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        indices.insert(indices.end(), {a, b, c, a, c, d});
    }
};

/// A closed torus with ripples, of 2·`around`·`along` triangles.
inline TestMesh rippled_torus(std::uint32_t around, std::uint32_t along, double ripple) {
    TestMesh mesh;
    const auto turn = [](std::uint32_t i, std::uint32_t n) { return 2.0 * std::numbers::pi * i / n; };
    for (std::uint32_t i = 0; i < along; ++i) {
        for (std::uint32_t j = 0; j < around; ++j) {
            const double u = turn(i, along), v = turn(j, around);
            const double r = 0.4 + ripple * std::cos(5 * u + 2 * v);
            mesh.positions.push_back(glm::vec3((1.0 + r * std::cos(v)) * std::cos(u), r * std::sin(v),
                                               (1.0 + r * std::cos(v)) * std::sin(u)));
            const std::uint32_t i2 = (i + 1) % along, j2 = (j + 1) % around;
            mesh.add_quad(i * around + j, i * around + j2, i2 * around + j2, i2 * around + j);
        }
    }
    return mesh;
}

/// A sheet of `n`×`n` quads over [0, 1]², its heights waves: it has a border.
inline TestMesh wavy_sheet(std::uint32_t n) {
    TestMesh mesh;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j) {
            const double x = 1.0 * i / n, z = 1.0 * j / n;
            mesh.positions.push_back(glm::vec3(x, 0.05 * std::sin(9 * x) * std::cos(7 * z), z));
            if (i == n || j == n) continue;
            const std::uint32_t a = i * (n + 1) + j;
            mesh.add_quad(a, a + 1, a + n + 2, a + n + 1);
        }
    return mesh;
}

/// The same triangles, no two of which share a vertex: a flat-shaded mesh.
inline TestMesh unshared(const TestMesh& source) {
    TestMesh mesh;
    for (const std::uint32_t index : source.indices) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(source.positions[index]);
    }
    return mesh;
}

/// The indices of a level, whichever array they stand in.
inline std::span<const std::uint32_t> indices_of(const LodChain& chain, const LodMesh& mesh,
                                                 std::size_t level) {
    if (level == 0) return mesh.indices;
    return chain.indices.span().subspan(chain.levels[level].first_index, chain.levels[level].index_count);
}

}  // namespace rhview
