// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/index_check.h"

#include <gtest/gtest.h>

#include <vector>

namespace rhview {
namespace {

TEST(IndexCheck, finds_one_index_at_or_above_the_count_anywhere) {
    for (const std::uint64_t count : {std::uint64_t{1}, std::uint64_t{7}, std::uint64_t{1} << 31,
                                      (std::uint64_t{1} << 31) + 5, (std::uint64_t{1} << 32) - 1}) {
        const auto last = static_cast<std::uint32_t>(count - 1);
        std::vector<std::uint32_t> indices(200'001, last);
        EXPECT_TRUE(all_below(indices, count)) << count;
        for (const std::size_t place : {std::size_t{0}, std::size_t{100'003}, indices.size() - 1}) {
            for (const std::uint32_t bad : {last + 1, last | 0x80000000u, 0xffffffffu}) {
                if (bad < count) continue;
                indices[place] = bad;
                EXPECT_FALSE(all_below(indices, count)) << count << " " << place << " " << bad;
                indices[place] = 0;
            }
        }
        EXPECT_TRUE(all_below(indices, count)) << count;
    }
}

TEST(IndexCheck, nothing_is_below_no_vertex_but_nothing) {
    const std::vector<std::uint32_t> zero{0};
    EXPECT_FALSE(all_below(zero, 0));
    EXPECT_TRUE(all_below({}, 0));
    EXPECT_TRUE(all_below(zero, std::uint64_t{1} << 33));
}

}  // namespace
}  // namespace rhview
