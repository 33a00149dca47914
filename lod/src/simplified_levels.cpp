// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "simplified_levels.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace rhview {
namespace {

using Indices = std::vector<std::uint32_t>;

// A level that takes away less is not worth its memory and its switches.
constexpr double kWorthALevel = 0.8;
// As far as a target may go: the error is measured afterwards, and the caller decides by it.
constexpr float kAnyError = 1e9f;

/// A level that the next one is made from: with the positions that it uses and no others. The simplifier
/// would take an unused one for part of a seam, and spend time on it.
class Working {
  public:
    Working(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices)
        : indices_(indices.begin(), indices.end()), positions_(positions.begin(), positions.end()) {
        sources_.resize(positions.size());
        std::iota(sources_.begin(), sources_.end(), 0u);
    }

    [[nodiscard]] const Indices& indices() const { return indices_; }
    [[nodiscard]] Indices simplified(const LodOptions& options) const;
    [[nodiscard]] Indices simplified_sloppily(const LodOptions& options) const;
    /// Corners at one position become one; triangles that this makes lines or points are left out.
    [[nodiscard]] Indices welded() const;

    /// Goes on with `indices`, which count in this one's positions.
    void become(const Indices& indices);
    /// The indices, counting in the first level's positions, in an order for the vertex cache.
    [[nodiscard]] Indices in_cache_order() const;

  private:
    [[nodiscard]] std::size_t target(const LodOptions& options) const {
        const auto triangles = static_cast<double>(indices_.size() / 3);
        return 3 * std::max<std::size_t>(static_cast<std::size_t>(options.ratio * triangles),
                                         options.min_triangles);
    }

    Indices indices_;
    std::vector<glm::vec3> positions_;
    Indices sources_;  ///< the first level's number of each position
};

Indices Working::simplified(const LodOptions& options) const {
    unsigned flags = 0;
    if (options.lock_borders) flags = meshopt_SimplifyLockBorder;
    Indices result(indices_.size());
    result.resize(meshopt_simplify(result.data(), indices_.data(), indices_.size(), &positions_[0].x,
                                   positions_.size(), sizeof(glm::vec3), target(options), kAnyError, flags,
                                   nullptr));
    return result;
}

Indices Working::simplified_sloppily(const LodOptions& options) const {
    Indices result(indices_.size());
    result.resize(meshopt_simplifySloppy(result.data(), indices_.data(), indices_.size(), &positions_[0].x,
                                         positions_.size(), sizeof(glm::vec3), target(options), kAnyError,
                                         nullptr));
    return result;
}

Indices Working::welded() const {
    Indices result(indices_.size());
    meshopt_generateShadowIndexBuffer(result.data(), indices_.data(), indices_.size(), positions_.data(),
                                      positions_.size(), sizeof(glm::vec3), sizeof(glm::vec3));
    std::size_t kept = 0;
    for (std::size_t t = 0; t + 2 < result.size(); t += 3) {
        const std::uint32_t a = result[t], b = result[t + 1], c = result[t + 2];
        if (a == b || b == c || c == a) continue;
        for (const std::uint32_t corner : {a, b, c}) result[kept++] = corner;
    }
    result.resize(kept);
    return result;
}

void Working::become(const Indices& indices) {
    constexpr std::uint32_t kUnused = ~0u;
    Indices places(positions_.size(), kUnused);
    Indices used;
    indices_.clear();
    for (const std::uint32_t index : indices) {
        if (places[index] == kUnused) {
            places[index] = static_cast<std::uint32_t>(used.size());
            used.push_back(index);
        }
        indices_.push_back(places[index]);
    }
    std::vector<glm::vec3> positions;
    positions.reserve(used.size());
    for (std::uint32_t& index : used) {
        positions.push_back(positions_[index]);
        index = sources_[index];
    }
    positions_.swap(positions);
    sources_.swap(used);
}

Indices Working::in_cache_order() const {
    Indices result(indices_.size());
    meshopt_optimizeVertexCache(result.data(), indices_.data(), indices_.size(), positions_.size());
    for (std::uint32_t& index : result) index = sources_[index];
    return result;
}

bool is_worth_a_level(const Indices& indices, const Indices& before) {
    return !indices.empty() &&
           static_cast<double>(indices.size()) <= kWorthALevel * static_cast<double>(before.size());
}

/// Whether an edge belongs to more than two of the triangles of `welded`.
bool has_shared_edges(const Indices& welded) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    edges.reserve(welded.size());
    for (std::size_t t = 0; t < welded.size(); t += 3)
        for (std::size_t i = 0; i < 3; ++i)
            edges.push_back(std::minmax(welded[t + i], welded[t + (i + 1) % 3]));
    std::ranges::sort(edges);
    for (std::size_t i = 0; i + 2 < edges.size(); ++i)
        if (edges[i] == edges[i + 2]) return true;
    return false;
}

}  // namespace

SimplifiedLevels simplify_to_levels(std::span<const glm::vec3> positions,
                                    std::span<const std::uint32_t> indices, const LodOptions& options,
                                    const BuildProgress& progress) {
    Working working(positions, indices);
    SimplifiedLevels result;
    const auto smallest = [&] { return working.indices().size() <= 3 * std::size_t{options.min_triangles}; };
    bool welded = false, sloppy = false;
    while (!smallest() && !progress.stopped()) {
        const Indices level = sloppy ? working.simplified_sloppily(options) : working.simplified(options);
        if (is_worth_a_level(level, working.indices())) {
            working.become(level);
            result.levels.push_back({working.in_cache_order(), sloppy});
        } else if (!welded) {
            working.become(working.welded());
            welded = true;
        } else if (!sloppy && options.allow_sloppy) {
            sloppy = true;
        } else {
            break;
        }
    }
    if (!smallest()) result.end = has_shared_edges(working.indices()) ? LodEnd::NonManifold : LodEnd::Locked;
    return result;
}

}  // namespace rhview
