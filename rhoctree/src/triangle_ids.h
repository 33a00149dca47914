// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/triangle_batch.h"

namespace rhview {

/// Numbers the triangles of all batches through, batch after batch. At most 2^32 / 3 of them.
class TriangleIds {
  public:
    explicit TriangleIds(std::span<const TriangleBatch> batches) : first_{0} {
        for (const TriangleBatch& batch : batches)
            first_.push_back(first_.back() + static_cast<std::uint32_t>(batch.indices.size() / 3));
    }

    [[nodiscard]] std::uint32_t count() const { return first_.back(); }
    [[nodiscard]] std::uint32_t first_of(std::uint32_t batch) const { return first_[batch]; }
    /// `id` is below `count`.
    [[nodiscard]] std::uint32_t batch_of(std::uint32_t id) const {
        return static_cast<std::uint32_t>(std::ranges::upper_bound(first_, id) - first_.begin()) - 1;
    }

    /// Calls `part(batch, first, end)` for each batch that has some of the ids [begin, end), with the places
    /// of its own triangles.
    template <class Part>
    void for_each_part(std::uint32_t begin, std::uint32_t end, const Part& part) const {
        for (std::uint32_t b = begin < end ? batch_of(begin) : 0; begin < end; ++b) {
            const std::uint32_t stop = std::min(end, first_[b + 1]);
            if (begin < stop) part(b, begin - first_[b], stop - first_[b]);
            begin = std::max(begin, stop);
        }
    }

  private:
    std::vector<std::uint32_t> first_;  ///< of each batch, and the number of all
};

}  // namespace rhview
