// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "closed_surfaces.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "rhview/baselines/solid_cells.h"

namespace rhview {
namespace {

/// Numbers equal positions alike (-0 is 0). Open addressing, linear probing.
class Welder {
  public:
    explicit Welder(std::size_t most_positions)
        : slots_(std::bit_ceil(2 * most_positions + 1), kEmpty), mask_(slots_.size() - 1) {}

    std::uint32_t number(const glm::vec3& given) {
        const glm::vec3 position = given + glm::vec3(0.0f);
        for (std::size_t slot = hash(position) & mask_;; slot = (slot + 1) & mask_) {
            if (slots_[slot] == kEmpty) {
                slots_[slot] = static_cast<std::uint32_t>(positions_.size());
                positions_.push_back(position);
                return slots_[slot];
            }
            if (positions_[slots_[slot]] == position) return slots_[slot];
        }
    }
    [[nodiscard]] const std::vector<glm::vec3>& positions() const { return positions_; }

  private:
    static constexpr std::uint32_t kEmpty = 0xffffffffu;

    static std::size_t hash(const glm::vec3& p) {
        std::uint64_t h = 0;
        for (int a = 0; a < 3; ++a)
            h = (h ^ std::bit_cast<std::uint32_t>(p[a])) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
        return static_cast<std::size_t>(h);
    }

    std::vector<std::uint32_t> slots_;
    std::size_t mask_;
    std::vector<glm::vec3> positions_;
};

class Sets {
  public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t root(std::uint32_t i) {
        for (; parent_[i] != i; i = parent_[i]) parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// The lesser root stays: the result does not depend on the order.
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a), b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

struct Edge {
    std::uint32_t low = 0, high = 0;  ///< corners, numbered
    std::int32_t direction = 0;       ///< +1: from low to high

    friend auto operator<=>(const Edge&, const Edge&) = default;
};

using Numbers = std::array<std::uint32_t, 3>;

std::vector<Edge> sorted_edges(const std::vector<Numbers>& numbers, const std::vector<bool>& joins) {
    std::vector<Edge> edges;
    edges.reserve(3 * numbers.size());
    for (std::size_t t = 0; t < numbers.size(); ++t)
        for (std::size_t k = 0; joins[t] && k < 3; ++k) {
            const std::uint32_t a = numbers[t][k], b = numbers[t][(k + 1) % 3];
            if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
    std::sort(edges.begin(), edges.end());
    return edges;
}

}  // namespace

ClosedSurfaces find_closed_surfaces(const std::vector<Corners>& triangles, const std::vector<bool>& joins,
                                    float open_y) {
    Welder welder(3 * triangles.size());
    std::vector<Numbers> numbers(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; joins[t] && k < 3; ++k) numbers[t][k] = welder.number(triangles[t][k]);
    Sets sets(welder.positions().size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (joins[t]) sets.join(numbers[t][0], numbers[t][1]), sets.join(numbers[t][0], numbers[t][2]);

    std::vector<std::uint8_t> open(welder.positions().size(), 0), below(open);
    const std::vector<Edge> edges = sorted_edges(numbers, joins);
    for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
        int sum = 0;
        for (end = first;
             end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high;
             ++end)
            sum += edges[end].direction;
        if (sum == 0) continue;
        const bool at_bottom = welder.positions()[edges[first].low].y == open_y &&
                               welder.positions()[edges[first].high].y == open_y;
        (at_bottom ? below : open)[sets.root(edges[first].low)] = 1;
    }

    ClosedSurfaces result;
    result.surface_of.assign(triangles.size(), SolidCells::kOpen);
    std::vector<std::uint32_t> number_of(open.size(), SolidCells::kOpen);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (!joins[t]) continue;
        const std::uint32_t root = sets.root(numbers[t][0]);
        if (open[root] != 0) continue;
        if (number_of[root] == SolidCells::kOpen) number_of[root] = result.count++;
        result.surface_of[t] = number_of[root];
        result.opened_below |= below[root] != 0;
    }
    return result;
}

}  // namespace rhview
