// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Which triangle of a surface is nearest to a point.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "point_triangle.h"
#include "rhview/base/aabb.h"

namespace rhview {

/// A binary tree of boxes over triangles, split at the median along the longest side. Deterministic on any
/// number of threads. Cost: O(n log n) to build, about 60 bytes a triangle.
class TriangleTree {
  public:
    struct Nearest {
        std::uint32_t triangle = 0;  ///< into `triangle`
        double distance_squared = 0.0;
    };

    /// Three indices a triangle; at least one triangle. Nothing of the arguments is kept.
    TriangleTree(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);

    [[nodiscard]] Triangle triangle(std::uint32_t i) const {
        const auto& corners = triangles_[i];
        return {corners[0], corners[1], corners[2]};
    }

    [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }
    [[nodiscard]] const Aabb& bounds() const { return nodes_[0].bounds; }

    /// The nearest triangle, found the faster the nearer `hint` is. The distance is exactly that of the
    /// triangle that it names; another may be nearer by no more than what boxes lose by rounding.
    [[nodiscard]] Nearest nearest(const glm::dvec3& point, std::uint32_t hint) const;

  private:
    struct Node {
        Aabb bounds;
        std::uint32_t first = 0;  ///< leaf: first triangle; else the second child (the first one follows)
        std::uint32_t count = 0;  ///< of a leaf; 0: no leaf
    };
    struct Item {
        glm::vec3 centre;
        std::uint32_t triangle;
    };
    void build(std::span<Item> items, std::size_t node, std::uint32_t first);
    static std::size_t nodes_of(std::size_t triangles);

    std::vector<std::array<glm::vec3, 3>> triangles_;  ///< while building in the given order, then in leaves'
    std::vector<Node> nodes_;
};

}  // namespace rhview
