// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "reveal_delays.h"

#include <gtest/gtest.h>

namespace rhview::cli {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

using Depths = std::vector<float>;
using Items = std::vector<std::uint32_t>;

TEST(RevealDelays, count_the_frames_in_a_row_that_an_item_lacks_a_pixel) {
    RevealDelays delays(3);
    const Items items{0, 1, 1, kNone};
    const Depths reference{0.5f, 0.5f, 0.5f, 0.0f};
    EXPECT_EQ(delays.add_frame(items, Depths{0.5f, 0.0f, 0.5f, 0.0f}, reference), 1u);  // 1 lacks a pixel
    EXPECT_EQ(delays.add_frame(items, Depths{0.0f, 0.5f, 0.0f, 0.0f}, reference), 2u);  // 0, and 1 another
    EXPECT_EQ(delays.add_frame(items, reference, reference), 0u);
    EXPECT_EQ(delays.add_frame(items, Depths{0.5f, 0.0f, 0.0f, 0.0f}, reference), 1u);  // 1 again, to the end
    EXPECT_EQ(delays.frames(), (std::vector<double>{1.0, 2.0, 1.0}));
}

TEST(RevealDelays, nothing_missing_is_no_delay) {
    RevealDelays delays(1);
    EXPECT_EQ(delays.add_frame(Items{0, kNone}, Depths{0.5f, 0.0f}, Depths{0.5f, 0.0f}), 0u);
    EXPECT_TRUE(delays.frames().empty());
}

TEST(RevealDelays, a_difference_where_there_is_no_item_is_nobodys) {
    RevealDelays delays(1);
    EXPECT_EQ(delays.add_frame(Items{kNone}, Depths{0.25f}, Depths{0.0f}), 0u);
    EXPECT_TRUE(delays.frames().empty());
}

}  // namespace
}  // namespace rhview::cli
