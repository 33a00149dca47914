// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/frame_planner.h"

#include <algorithm>
#include <array>
#include <bit>

#include "rhview/frustum/box_batch.h"

namespace rhview {

void append_visible_objects(const Frustum& frustum, std::span<const Aabb> boxes,
                            std::vector<ObjectId>& objects, std::span<const std::uint64_t> alive) {
    constexpr std::size_t kBoxesAtOnce = 4096;  // their bits stay on the stack
    std::array<std::uint64_t, visibility_words(kBoxesAtOnce)> visible;
    for (std::size_t first = 0; first < boxes.size(); first += kBoxesAtOnce) {
        const std::size_t count = std::min(kBoxesAtOnce, boxes.size() - first);
        cull_boxes(frustum, boxes.subspan(first, count), visible);
        for (std::size_t word = 0; word < visibility_words(count); ++word)
            for (std::uint64_t rest =
                     visible[word] & (alive.empty() ? ~std::uint64_t{0} : alive[first / 64 + word]);
                 rest != 0; rest &= rest - 1) {
                const std::size_t box = first + 64 * word + static_cast<std::size_t>(std::countr_zero(rest));
                objects.push_back(ObjectId{static_cast<std::uint32_t>(box)});
            }
    }
}

}  // namespace rhview
