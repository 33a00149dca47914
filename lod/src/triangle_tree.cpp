// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "triangle_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>

namespace rhview {
namespace {

constexpr std::size_t kLeafTriangles = 4;
// Smaller subtrees are not worth a task.
constexpr std::size_t kTaskTriangles = 8192;
// Halving 2^32 triangles down to leaves: one node of each level waits.
constexpr std::size_t kMaxWaiting = 40;

glm::length_t longest_side(const glm::vec3& extent) {
    if (extent.x >= extent.y && extent.x >= extent.z) return 0;
    return extent.y >= extent.z ? 1 : 2;
}

double box_distance_squared(const Aabb& box, const glm::dvec3& p) {
    const glm::dvec3 off = glm::max(glm::max(glm::dvec3(box.min) - p, p - glm::dvec3(box.max)), 0.0);
    return glm::dot(off, off);
}

}  // namespace

std::size_t TriangleTree::nodes_of(std::size_t triangles) {
    if (triangles <= kLeafTriangles) return 1;
    return 1 + nodes_of(triangles / 2) + nodes_of(triangles - triangles / 2);
}

TriangleTree::TriangleTree(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    std::vector<Item> items(indices.size() / 3);
    triangles_.resize(items.size());
    for (std::size_t t = 0; t < items.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) triangles_[t][i] = positions[indices[3 * t + i]];
        const auto& [a, b, c] = triangles_[t];
        items[t] = {(a + b + c) / 3.0f, static_cast<std::uint32_t>(t)};
    }
    nodes_.resize(nodes_of(items.size()));
    build(items, 0, 0);
    std::vector<std::array<glm::vec3, 3>> ordered(items.size());
    for (std::size_t t = 0; t < items.size(); ++t) ordered[t] = triangles_[items[t].triangle];
    triangles_.swap(ordered);
}

void TriangleTree::build(std::span<Item> items, std::size_t node, std::uint32_t first) {
    Aabb bounds, centres;
    for (const Item& item : items) {
        for (const glm::vec3& corner : triangles_[item.triangle]) bounds.grow(corner);
        centres.grow(item.centre);
    }
    nodes_[node].bounds = bounds;
    if (items.size() <= kLeafTriangles) {
        nodes_[node].first = first;
        nodes_[node].count = static_cast<std::uint32_t>(items.size());
        return;
    }
    const glm::length_t side = longest_side(centres.extent());
    const std::size_t half = items.size() / 2;
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                     [side](const Item& a, const Item& b) {
                         return a.centre[side] != b.centre[side] ? a.centre[side] < b.centre[side]
                                                                 : a.triangle < b.triangle;
                     });
    const std::size_t second = node + 1 + nodes_of(half);
    nodes_[node].first = static_cast<std::uint32_t>(second);
    const auto build_first = [&] { build(items.first(half), node + 1, first); };
    const auto build_second = [&] {
        build(items.subspan(half), second, first + static_cast<std::uint32_t>(half));
    };
    if (items.size() < kTaskTriangles) {
        build_first();
        build_second();
    } else {
        tbb::parallel_invoke(build_first, build_second);
    }
}

TriangleTree::Nearest TriangleTree::nearest(const glm::dvec3& point, std::uint32_t hint) const {
    Nearest best{hint, distance_squared(point, triangle(hint))};
    std::array<std::pair<std::uint32_t, double>, kMaxWaiting> waiting;
    std::size_t count = 0;
    waiting[count++] = {0, box_distance_squared(nodes_[0].bounds, point)};
    while (count > 0) {
        auto [at, distance] = waiting[--count];
        while (distance < best.distance_squared) {
            const Node& node = nodes_[at];
            if (node.count > 0) {
                for (std::uint32_t t = node.first; t < node.first + node.count; ++t)
                    if (const double d = distance_squared(point, triangle(t)); d < best.distance_squared)
                        best = {t, d};
                break;
            }
            // The nearer child at once, the other one later.
            std::pair near{at + 1, box_distance_squared(nodes_[at + 1].bounds, point)};
            std::pair far{node.first, box_distance_squared(nodes_[node.first].bounds, point)};
            if (far.second < near.second) std::swap(near, far);
            if (far.second < best.distance_squared) waiting[count++] = far;
            at = near.first;
            distance = near.second;
        }
    }
    return best;
}

}  // namespace rhview
