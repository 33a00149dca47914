// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// How fine to cut. Let a frame show v indices of a batch in leaves of at most l. Leaves that the frustum cuts
// are drawn with what lies outside: there are about (v / l)^(2/3) of them, so the waste is
// a·c1·v^(2/3)·l^(1/3) (a = 0.65 fitted on `town`, l from 768 to 49,152). Planning visits v / l leaves of k
// ns each. The sum is least at l = (3·k / (a·c1))^(3/4) · v^(1/4). Much below what a draw is worth, finer
// leaves give gaps that are bridged anyway. All this is flat around its minimum: docs/draw-list.md.

#include <algorithm>
#include <cmath>

#include "rhview/base/assert.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {
namespace {

constexpr double kWaste = 0.65;
constexpr double kLeafNs = 107.0;            // per l indices in view: most leaves are smaller than l
constexpr double kShareInView = 0.3;         // of the indices
constexpr double kRecordNs = 25.0;           // planning a record must be worth its indices
constexpr double kLeastDraws = 0.5;          // that a leaf holds
constexpr double kLeastLeaf = 3.0 * 2048.0;  // finer ones take longer to plan than 100 us, whatever c1
constexpr double kLargestLeaf = 3.0 * 16384.0;

}  // namespace

OctreeOptions choose_octree_options(const DrawCosts& costs, std::uint64_t index_count,
                                    std::size_t batch_count) {
    RHVIEW_ASSERT(costs.index_ns >= 0.0 && costs.draw_ns >= 0.0);
    const double in_view = kShareInView * static_cast<double>(index_count) /
                           static_cast<double>(std::max<std::size_t>(batch_count, 1));
    // Free indices: both are infinite, and the largest leaves do.
    const double draw_indices = costs.draw_ns / costs.index_ns;
    // To the power of 3/4 by square roots alone: they round alike on every machine.
    const double ratio = std::sqrt(3.0 * kLeafNs / (kWaste * costs.index_ns));
    const double planning = ratio * std::sqrt(ratio) * std::sqrt(std::sqrt(in_view));
    const auto within = [](double value, double low, double high) {
        return value >= low ? std::min(value, high) : low;  // NaN, of free draws and indices: low
    };
    OctreeOptions options;
    options.costs = costs;
    options.replica_budget = 1.0;
    options.count_leaf_per_batch = true;
    options.max_leaf_triangles = static_cast<std::uint32_t>(
        within(std::fmax(kLeastDraws * draw_indices, planning), kLeastLeaf, kLargestLeaf) / 3.0);
    options.min_record_indices = static_cast<std::uint32_t>(
        within(std::fmax(draw_indices / 8.0, kRecordNs / costs.index_ns), 3.0, kLargestLeaf / 8.0));
    return options;
}

}  // namespace rhview
