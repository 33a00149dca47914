// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "vertex_cache_order.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace rhview {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kFewTriangles = 8;  // any order draws them about as well

using Corners = std::array<std::uint32_t, 3>;

/// A triangle's corners, rotated so that the least comes first.
Corners least_first(const std::vector<std::uint32_t>& indices, std::size_t triangle) {
    const std::uint32_t* const c = indices.data() + 3 * triangle;
    if (c[0] <= c[1] && c[0] <= c[2]) return {c[0], c[1], c[2]};
    if (c[1] <= c[2]) return {c[1], c[2], c[0]};
    return {c[2], c[0], c[1]};
}

}  // namespace

void VertexCacheOrder::apply(std::span<std::uint32_t> indices, std::span<std::uint8_t> cluster_of) {
    const std::size_t triangles = indices.size() / 3;
    if (triangles < kFewTriangles) return;
    number_vertices(indices);
    // Without a shared vertex there is nothing to gain.
    if (vertices_.size() == indices.size()) return;
    ordered_.resize(indices.size());
    meshopt_optimizeVertexCache(ordered_.data(), local_.data(), local_.size(), vertices_.size());
    if (!map_back(triangles)) return;
    moved_.assign(indices.begin(), indices.end());
    for (std::size_t t = 0; t < triangles; ++t)
        std::copy_n(moved_.begin() + 3 * static_cast<std::ptrdiff_t>(source_[t]), 3,
                    indices.begin() + 3 * static_cast<std::ptrdiff_t>(t));
    if (cluster_of.empty()) return;
    moved_cluster_.assign(cluster_of.begin(), cluster_of.end());
    for (std::size_t t = 0; t < triangles; ++t) cluster_of[t] = moved_cluster_[source_[t]];
}

/// A hash table half full at most, by Fibonacci hashing (Knuth, volume 3, section 6.4).
void VertexCacheOrder::number_vertices(std::span<const std::uint32_t> indices) {
    const auto bits = static_cast<int>(std::bit_width(2 * indices.size()));
    slots_.assign(std::size_t{1} << bits, kNone);
    vertices_.clear();
    local_.resize(indices.size());
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        std::size_t slot = (indices[i] * 0x9e3779b97f4a7c15ull) >> (64 - bits);
        while (slots_[slot] != kNone && vertices_[slots_[slot]] != indices[i]) slot = (slot + 1) & mask;
        if (slots_[slot] == kNone) {
            slots_[slot] = static_cast<std::uint32_t>(vertices_.size());
            vertices_.push_back(indices[i]);
        }
        local_[i] = slots_[slot];
    }
}

/// Which source triangle each ordered one is: the first with its corners, whatever its rotation, that is
/// still left. False if one is none of them: the order is then not used.
bool VertexCacheOrder::map_back(std::size_t triangles) {
    // A hash table of chains, each in source order: long only where triangles are the same.
    const auto bits = static_cast<int>(std::bit_width(2 * triangles));
    first_triangle_.assign(std::size_t{1} << bits, kNone);
    next_triangle_.resize(triangles);
    source_.resize(triangles);
    const auto chain_of = [&](const Corners& c) -> std::uint32_t& {
        const std::uint64_t mixed = (c[0] * 0x9e3779b97f4a7c15ull + c[1]) * 0x9e3779b97f4a7c15ull + c[2];
        return first_triangle_[(mixed * 0x9e3779b97f4a7c15ull) >> (64 - bits)];
    };
    for (std::size_t t = triangles; t-- > 0;) {
        std::uint32_t& first = chain_of(least_first(local_, t));
        next_triangle_[t] = first;
        first = static_cast<std::uint32_t>(t);
    }
    for (std::size_t t = 0; t < triangles; ++t) {
        const Corners drawn = least_first(ordered_, t);
        std::uint32_t* link = &chain_of(drawn);
        while (*link != kNone && least_first(local_, *link) != drawn) link = &next_triangle_[*link];
        if (*link == kNone) return false;
        source_[t] = *link;
        *link = next_triangle_[*link];
    }
    return true;
}

}  // namespace rhview
