// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "morton_sort.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <string>

namespace rhview {
namespace {

constexpr double kCells = 1 << kMortonLevels;
constexpr unsigned kDigitBits = 11;  // a pass's counters fit the first-level cache
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

/// Moves bit i of a 21-bit number to bit 3·i.
std::uint64_t spread_bits(std::uint64_t x) {
    x = (x | x << 32) & 0x001f00000000ffffull;
    x = (x | x << 16) & 0x001f0000ff0000ffull;
    x = (x | x << 8) & 0x100f00f00f00f00full;
    x = (x | x << 4) & 0x10c30c30c30c30c3ull;
    x = (x | x << 2) & 0x1249249249249249ull;
    return x;
}

/// Three times the centroid, in double: sums of finite floats don't overflow.
glm::dvec3 corner_sum(const TriangleBatch& batch, std::size_t triangle) {
    const std::uint32_t* corner = batch.indices.data() + 3 * triangle;
    return glm::dvec3(batch.positions[corner[0]]) + glm::dvec3(batch.positions[corner[1]]) +
           glm::dvec3(batch.positions[corner[2]]);
}

Status check_batch(const TriangleBatch& batch, std::size_t batch_index) {
    const auto where = [&](std::size_t index) {
        return "batch " + std::to_string(batch_index) + ", triangle " + std::to_string(index / 3) + ": ";
    };
    if (batch.indices.size() % 3 != 0)
        return Error{"batch " + std::to_string(batch_index) + " has " + std::to_string(batch.indices.size()) +
                     " indices, which is no multiple of three"};
    for (std::size_t i = 0; i < batch.indices.size(); ++i) {
        if (batch.indices[i] >= batch.positions.size())
            return Error{where(i) + "index " + std::to_string(batch.indices[i]) + " is out of range (" +
                         std::to_string(batch.positions.size()) + " vertices)"};
        const glm::vec3& p = batch.positions[batch.indices[i]];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return Error{where(i) + "a corner is not finite; drop the triangle first"};
    }
    return success();
}

/// Least-significant-digit radix sort: stable, so equal codes keep their order.
void radix_sort(std::vector<MortonTriangle>& triangles) {
    std::vector<MortonTriangle> other(triangles.size());
    for (unsigned shift = 0; shift < 3 * kMortonLevels; shift += kDigitBits) {
        std::array<std::uint32_t, kDigits> offset{};
        for (const MortonTriangle& t : triangles) ++offset[(t.code >> shift) & (kDigits - 1)];
        if (std::ranges::find(offset, triangles.size()) != offset.end())
            continue;  // one digit: sorted already
        std::uint32_t sum = 0;
        for (std::uint32_t& count : offset) sum += std::exchange(count, sum);
        for (const MortonTriangle& t : triangles) other[offset[(t.code >> shift) & (kDigits - 1)]++] = t;
        triangles.swap(other);
    }
}

}  // namespace

Result<std::vector<MortonTriangle>> sort_by_morton_code(std::span<const TriangleBatch> batches) {
    std::uint64_t index_count = 0;
    for (const TriangleBatch& batch : batches) index_count += batch.indices.size();
    if (index_count >= std::numeric_limits<std::uint32_t>::max())
        return Error{"the batches have " + std::to_string(index_count) +
                     " indices, more than 4,294,967,294; split the scene"};

    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-std::numeric_limits<double>::infinity());
    for (std::size_t b = 0; b < batches.size(); ++b) {
        if (Status status = check_batch(batches[b], b); !status) return status.error();
        for (std::size_t t = 0; t < batches[b].indices.size() / 3; ++t) {
            const glm::dvec3 sum = corner_sum(batches[b], t);
            low = glm::min(low, sum);
            high = glm::max(high, sum);
        }
    }
    const glm::dvec3 size = high - low;
    const double edge = std::max({size.x, size.y, size.z});
    const double cells_per_unit = edge > 0.0 ? kCells / edge : 0.0;

    std::vector<MortonTriangle> triangles;
    triangles.reserve(index_count / 3);
    for (std::uint32_t b = 0; b < batches.size(); ++b) {
        for (std::uint32_t t = 0; t < batches[b].indices.size() / 3; ++t) {
            const glm::dvec3 cell =
                glm::min((corner_sum(batches[b], t) - low) * cells_per_unit, kCells - 1.0);
            const auto bits = [](double c) { return spread_bits(static_cast<std::uint64_t>(c)); };
            triangles.push_back({bits(cell.x) | bits(cell.y) << 1 | bits(cell.z) << 2, b, t});
        }
    }
    radix_sort(triangles);
    return triangles;
}

}  // namespace rhview
