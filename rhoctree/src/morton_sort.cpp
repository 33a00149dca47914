// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "morton_sort.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <string>

namespace rhview {
namespace {

constexpr double kCells = 1 << kMortonLevels;
constexpr std::uint32_t kGrain = 1u << 15;  // triangles: long against the start of a task

using IdRange = tbb::blocked_range<std::uint32_t>;

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

bool is_finite(const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// The place of the first index that is out of range or of a corner that is not finite; else their number.
std::size_t first_bad_index(const TriangleBatch& batch) {
    const std::size_t count = batch.indices.size();
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, count, 3 * std::size_t{kGrain}), count,
        [&](const tbb::blocked_range<std::size_t>& part, std::size_t bad) {
            for (std::size_t i = part.begin(); i < std::min(part.end(), bad); ++i)
                if (batch.indices[i] >= batch.positions.size() ||
                    !is_finite(batch.positions[batch.indices[i]]))
                    return i;
            return bad;
        },
        [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

bool is_box(const Aabb& box) {
    return is_finite(box.min) && is_finite(box.max) && box.min.x <= box.max.x && box.min.y <= box.max.y &&
           box.min.z <= box.max.z;
}

Status check_objects(const TriangleBatch& batch, const std::string& name) {
    std::uint64_t next = 0;
    for (std::size_t i = 0; i < batch.objects.size(); ++i) {
        const BatchObject& object = batch.objects[i];
        const std::string where = name + ", object " + std::to_string(i) + ": ";
        if (object.first_index % 3 != 0 || object.index_count % 3 != 0)
            return Error{where + "its indices are no whole triangles"};
        if (object.first_index < next) return Error{where + "it begins before the one before it ends"};
        next = std::uint64_t{object.first_index} + object.index_count;
        if (next > batch.indices.size()) return Error{where + "it ends beyond the batch's indices"};
        if (object.index_count > 0 && !is_box(object.bounds)) return Error{where + "its box is none"};
    }
    return success();
}

Status check_batch(const TriangleBatch& batch, std::size_t number) {
    const std::string name = "batch " + std::to_string(number);
    if (batch.indices.size() % 3 != 0)
        return Error{name + " has " + std::to_string(batch.indices.size()) +
                     " indices, which is no multiple of three"};
    if (Status status = check_objects(batch, name); !status) return status;
    const std::size_t bad = first_bad_index(batch);
    if (bad == batch.indices.size()) return success();
    const std::string where = name + ", triangle " + std::to_string(bad / 3) + ": ";
    if (batch.indices[bad] >= batch.positions.size())
        return Error{where + "index " + std::to_string(batch.indices[bad]) + " is out of range (" +
                     std::to_string(batch.positions.size()) + " vertices)"};
    return Error{where + "a corner is not finite; drop the triangle first"};
}

struct Extent {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

/// Of the triangles' corner sums. Minima and maxima are the same in any order.
Extent extent_of(std::span<const TriangleBatch> batches, const TriangleIds& ids) {
    return tbb::parallel_reduce(
        IdRange(0, ids.count(), kGrain), Extent(),
        [&](const IdRange& range, Extent extent) {
            ids.for_each_part(range.begin(), range.end(),
                              [&](std::uint32_t b, std::uint32_t first, std::uint32_t end) {
                                  for (std::uint32_t t = first; t < end; ++t) {
                                      const glm::dvec3 sum = corner_sum(batches[b], t);
                                      extent.low = glm::min(extent.low, sum);
                                      extent.high = glm::max(extent.high, sum);
                                  }
                              });
            return extent;
        },
        [](const Extent& a, const Extent& b) {
            return Extent{glm::min(a.low, b.low), glm::max(a.high, b.high)};
        });
}

/// The cube that Morton codes divide. Works on sums of three corners: no division by three is rounded.
class MortonGrid {
  public:
    explicit MortonGrid(const Extent& extent) : low_(extent.low) {
        const glm::dvec3 size = extent.high - extent.low;
        edge_ = std::max({size.x, size.y, size.z});
        cells_per_unit_ = edge_ > 0.0 ? kCells / edge_ : 0.0;
    }

    /// Of three times a place; of places outside that of the nearest inside.
    [[nodiscard]] std::uint64_t code_of(const glm::dvec3& sum) const {
        const glm::dvec3 cell = glm::clamp((sum - low_) * cells_per_unit_, 0.0, kCells - 1.0);
        const auto bits = [](double c) { return spread_bits(static_cast<std::uint64_t>(c)); };
        return bits(cell.x) | bits(cell.y) << 1 | bits(cell.z) << 2;
    }
    /// Of a cell `level` levels below the root.
    [[nodiscard]] double edge_of(int level) const { return std::ldexp(edge_ / 3.0, -level); }

  private:
    glm::dvec3 low_;
    double edge_ = 0.0, cells_per_unit_ = 0.0;
};

// Every so many triangles are looked at to tell how large leaves will be: a leaf holds far more.
constexpr std::size_t kSampled = 16;

/// Gives all triangles of an object one code where the object fits into a leaf, so that they stay together.
/// A leaf's box is then that of whole objects: one that a cell's border cuts in two would make both sides'
/// boxes larger, and show them more often. An object that is longer than the leaf's cell would do that
/// itself.
class ObjectsTogether {
  public:
    ObjectsTogether(const MortonGrid& grid, std::size_t cell_triangles)
        : grid_(grid), cell_triangles_(cell_triangles) {}

    /// `triangles`: the batch's own, with the codes of their centroids.
    void keep(const TriangleBatch& batch, std::span<MortonTriangle> triangles) {
        if (batch.objects.empty()) return;
        codes_.clear();
        for (std::size_t t = 0; t < triangles.size(); t += kSampled) codes_.push_back(triangles[t].code);
        std::ranges::sort(codes_);
        for (const BatchObject& object : batch.objects) {
            if (object.index_count == 0 || object.index_count > 3 * cell_triangles_) continue;
            const glm::dvec3 low(object.bounds.min), high(object.bounds.max), size = high - low;
            const std::uint64_t code = grid_.code_of(1.5 * (low + high));
            if (!(std::max({size.x, size.y, size.z}) <= grid_.edge_of(leaf_level(code)))) continue;
            for (MortonTriangle& triangle : triangles.subspan(object.first_index / 3, object.index_count / 3))
                triangle.code = code;
        }
    }

  private:
    /// Of the cell at `code` that has few enough of the batch's triangles, by the sample.
    [[nodiscard]] int leaf_level(std::uint64_t code) const {
        for (int level = 0; level < kMortonLevels; ++level) {
            const int shift = 3 * (kMortonLevels - level);
            const std::uint64_t first = code >> shift << shift;
            const std::uint64_t last = first + ((std::uint64_t{1} << shift) - 1);
            const auto count = static_cast<std::size_t>(std::ranges::upper_bound(codes_, last) -
                                                        std::ranges::lower_bound(codes_, first));
            if (count * kSampled <= cell_triangles_) return level;
        }
        return kMortonLevels;
    }

    const MortonGrid& grid_;
    std::size_t cell_triangles_;
    std::vector<std::uint64_t> codes_;  ///< of every `kSampled`th triangle of the batch, sorted
};

std::vector<MortonTriangle> codes_of(std::span<const TriangleBatch> batches, const TriangleIds& ids,
                                     std::size_t cell_triangles, BuildProgress& progress) {
    const MortonGrid grid(extent_of(batches, ids));
    std::vector<MortonTriangle> triangles(ids.count());
    tbb::parallel_for(IdRange(0, ids.count(), kGrain), [&](const IdRange& range) {
        if (progress.stopped()) return;
        ids.for_each_part(range.begin(), range.end(),
                          [&](std::uint32_t b, std::uint32_t first, std::uint32_t end) {
                              for (std::uint32_t t = first; t < end; ++t) {
                                  const std::uint32_t id = ids.first_of(b) + t;
                                  triangles[id] = {grid.code_of(corner_sum(batches[b], t)), id, b};
                              }
                          });
        progress.advance(range.size());
    });
    if (progress.stopped()) return triangles;
    ObjectsTogether objects(grid, cell_triangles);
    for (std::uint32_t b = 0; b < batches.size(); ++b)
        objects.keep(batches[b],
                     std::span(triangles).subspan(ids.first_of(b), batches[b].indices.size() / 3));
    return triangles;
}

/// Radix sort from the highest digit down. Each split is stable and its buckets are octree cells, so the
/// order does not depend on how the work was shared out; cells that are small enough are left as they are.
class CellSort {
  public:
    CellSort(std::vector<MortonTriangle>& triangles, std::size_t cell_triangles, BuildProgress& progress)
        : triangles_(triangles),
          other_(triangles.size()),
          cell_triangles_(cell_triangles),
          progress_(progress) {}

    void run() { sort({triangles_, other_}, 3 * kMortonLevels, true); }

  private:
    // Four levels where there are many triangles, so that few passes go over memory that no cache holds; else
    // two, so that clearing the counters costs less than sorting.
    static constexpr std::size_t kManyTriangles = std::size_t{1} << 15;
    static constexpr int kLargeDigit = 12;
    static constexpr int kSmallDigit = 6;
    static constexpr std::size_t kChunk = std::size_t{1} << 17;  // of a split that is shared out

    struct Buffers {
        std::span<MortonTriangle> from;
        std::span<MortonTriangle> to;
    };

    /// Sorts `buffers.from` by its lowest `bits` bits. `home`: that is where the result belongs, else in
    /// `to`.
    void sort(Buffers buffers, int bits, bool home) {
        const std::size_t count = buffers.from.size();
        if (count <= cell_triangles_ || count < 2 || bits == 0 || progress_.stopped()) {
            if (!home) std::ranges::copy(buffers.from, buffers.to.begin());
            progress_.advance(count);
            return;
        }
        const int digit = std::min(bits, count > kManyTriangles ? kLargeDigit : kSmallDigit);
        const int shift = bits - digit;
        const std::vector<std::uint32_t> ends = split(buffers, shift, (std::size_t{1} << digit) - 1);
        const auto sort_bucket = [&](std::size_t d) {
            const std::size_t begin = d == 0 ? 0 : ends[d - 1];
            if (begin == ends[d]) return;
            const std::size_t size = ends[d] - begin;
            sort({buffers.to.subspan(begin, size), buffers.from.subspan(begin, size)}, shift, !home);
        };
        if (count > kManyTriangles)
            tbb::parallel_for(std::size_t{0}, ends.size(), sort_bucket);
        else
            for (std::size_t d = 0; d < ends.size(); ++d) sort_bucket(d);
    }

    /// Moves `from` to `to`, by digit; the end of each digit's bucket. Stable: by digit, then by chunk, then
    /// in order.
    static std::vector<std::uint32_t> split(Buffers buffers, int shift, std::size_t mask) {
        const std::size_t count = buffers.from.size();
        const std::size_t chunks = (count + kChunk - 1) / kChunk;
        std::vector<std::vector<std::uint32_t>> place(chunks);
        const auto chunk_of = [&](std::size_t c) {
            return buffers.from.subspan(c * kChunk, std::min(kChunk, count - c * kChunk));
        };
        tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
            place[c].assign(mask + 1, 0);
            for (const MortonTriangle& t : chunk_of(c)) ++place[c][(t.code >> shift) & mask];
        });
        std::vector<std::uint32_t> ends(mask + 1);
        std::uint32_t sum = 0;
        for (std::size_t d = 0; d <= mask; ++d) {
            for (std::size_t c = 0; c < chunks; ++c) sum += std::exchange(place[c][d], sum);
            ends[d] = sum;
        }
        tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
            for (const MortonTriangle& t : chunk_of(c)) buffers.to[place[c][(t.code >> shift) & mask]++] = t;
        });
        return ends;
    }

    std::vector<MortonTriangle>& triangles_;
    std::vector<MortonTriangle> other_;
    std::size_t cell_triangles_;
    BuildProgress& progress_;
};

}  // namespace

Status check_batches(std::span<const TriangleBatch> batches) {
    std::uint64_t index_count = 0;
    for (const TriangleBatch& batch : batches) index_count += batch.indices.size();
    if (index_count >= std::numeric_limits<std::uint32_t>::max())
        return Error{"the batches have " + std::to_string(index_count) +
                     " indices, more than 4,294,967,294; split the scene"};
    for (std::size_t b = 0; b < batches.size(); ++b)
        if (Status status = check_batch(batches[b], b); !status) return status;
    return success();
}

std::vector<MortonTriangle> sort_by_morton_code(std::span<const TriangleBatch> batches,
                                                const TriangleIds& ids, std::size_t cell_triangles,
                                                BuildProgress& progress) {
    progress.begin_phase(0.15, ids.count());
    std::vector<MortonTriangle> triangles = codes_of(batches, ids, cell_triangles, progress);
    progress.begin_phase(0.15, ids.count());
    CellSort(triangles, cell_triangles, progress).run();
    return triangles;
}

}  // namespace rhview
