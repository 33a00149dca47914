// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "../../rhoctree/src/vertex_cache_order.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>

namespace rhview {
namespace {

using Labelled = std::pair<std::array<std::uint32_t, 3>, std::uint8_t>;

std::vector<Labelled> labelled(const std::vector<std::uint32_t>& indices,
                               const std::vector<std::uint8_t>& labels) {
    std::vector<Labelled> result;
    for (std::size_t t = 0; t < labels.size(); ++t)
        result.push_back({{indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]}, labels[t]});
    return result;
}

/// The triangles of a grid in a random order, each randomly rotated; vertex numbers are far apart.
std::vector<std::uint32_t> shuffled_grid(std::uint32_t side, std::mt19937& random) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const auto vertex = [&](std::uint32_t x, std::uint32_t y) {
        return 1'000'003u * (x + y * (side + 1)) + 17u;
    };
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            triangles.push_back({vertex(x, y), vertex(x + 1, y), vertex(x, y + 1)});
            triangles.push_back({vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)});
        }
    }
    for (std::size_t i = triangles.size(); i-- > 1;) std::swap(triangles[i], triangles[random() % (i + 1)]);
    std::vector<std::uint32_t> indices;
    for (std::array<std::uint32_t, 3>& t : triangles) {
        std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random() % 3), t.end());
        indices.insert(indices.end(), t.begin(), t.end());
    }
    return indices;
}

double misses_per_triangle(const std::vector<std::uint32_t>& indices) {
    std::vector<unsigned> local(indices.size());
    std::vector<std::uint32_t> vertices(indices);
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (std::size_t i = 0; i < indices.size(); ++i)
        local[i] = static_cast<unsigned>(std::ranges::lower_bound(vertices, indices[i]) - vertices.begin());
    return static_cast<double>(
        meshopt_analyzeVertexCache(local.data(), local.size(), vertices.size(), 16, 0, 0).acmr);
}

TEST(VertexCacheOrder, permutes_whole_triangles_with_their_labels_and_rotates_none) {
    std::mt19937 random(1);
    VertexCacheOrder order;
    for (const std::uint32_t side : {2u, 3u, 40u, 7u}) {
        std::vector<std::uint32_t> indices = shuffled_grid(side, random);
        // Duplicates, in two rotations, and triangles without area.
        indices.insert(indices.end(), {indices[0], indices[1], indices[2], indices[1], indices[2], indices[0],
                                       5, 5, 5, 5, 5, 9, indices[0], indices[1], indices[2]});
        std::vector<std::uint8_t> labels(indices.size() / 3);
        for (std::uint8_t& label : labels) label = static_cast<std::uint8_t>(random() % 7);
        std::vector<Labelled> before = labelled(indices, labels);
        order.apply(indices, labels);
        std::vector<Labelled> after = labelled(indices, labels);
        std::ranges::sort(before);
        std::ranges::sort(after);
        EXPECT_EQ(after, before);
    }
}

TEST(VertexCacheOrder, halves_the_misses_of_a_shuffled_grid) {
    std::mt19937 random(2);
    std::vector<std::uint32_t> indices = shuffled_grid(60, random);
    const double before = misses_per_triangle(indices);
    VertexCacheOrder().apply(indices, {});
    EXPECT_GT(before, 2.0);
    EXPECT_LT(misses_per_triangle(indices), 0.5 * before);
}

TEST(VertexCacheOrder, a_fan_a_thousand_times_over_takes_no_longer_than_other_triangles) {
    // All share a corner, most are the same: every search must end at once.
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 300'000; ++i) indices.insert(indices.end(), {0, 1 + i % 300, 2 + i % 300});
    std::vector<std::uint32_t> before = indices;
    VertexCacheOrder().apply(indices, {});
    std::ranges::sort(before);
    std::vector<std::uint32_t> after = indices;
    std::ranges::sort(after);
    EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace rhview
