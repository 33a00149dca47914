// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "reveal_delays.h"

#include <algorithm>
#include <bit>

#include "rhview/base/assert.h"

namespace rhview::cli {

std::uint64_t RevealDelays::add_frame(std::span<const std::uint32_t> items, std::span<const float> culled,
                                      std::span<const float> reference) {
    RHVIEW_ASSERT(items.size() == culled.size() && items.size() == reference.size());
    std::ranges::fill(missing_now_, std::uint8_t{0});
    for (std::size_t i = 0; i < items.size(); ++i)
        if (std::bit_cast<std::uint32_t>(culled[i]) != std::bit_cast<std::uint32_t>(reference[i]) &&
            items[i] < missing_now_.size())
            missing_now_[items[i]] = 1;
    std::uint64_t late = 0;
    for (std::size_t item = 0; item < missing_now_.size(); ++item) {
        if (missing_now_[item] != 0) {
            ++missing_for_[item];
            ++late;
        } else if (missing_for_[item] != 0) {
            ended_.push_back(missing_for_[item]);
            missing_for_[item] = 0;
        }
    }
    return late;
}

std::vector<double> RevealDelays::frames() const {
    std::vector<double> all = ended_;
    for (const std::uint32_t frames : missing_for_)
        if (frames != 0) all.push_back(frames);
    return all;
}

}  // namespace rhview::cli
