// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The fuzzer's sessions of C calls with any compiler: the seeds as they are, and mutated.

#include "c_api_session.h"

#include <gtest/gtest.h>

#include <random>

namespace rhview {
namespace {

TEST(CApiSession, of_the_seeds_do_what_they_are_asked) {
    const auto seeds = c_api_seeds();
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        const StatusCounts counts = run_c_api_session(seeds[i]);
        EXPECT_GE(counts[RHVIEW_OK], seeds[i].size() / kRecordBytes / 2) << i;
        EXPECT_EQ(counts[RHVIEW_INVALID_ARGUMENT] + counts[RHVIEW_WRONG_STATE], 0u) << i;
        EXPECT_EQ(counts[RHVIEW_OUT_OF_MEMORY], 0u) << i;
    }
}

TEST(CApiSession, with_any_bytes_end_every_call_in_a_status_that_is_told_why) {
    std::mt19937 random(7);
    const auto seeds = c_api_seeds();
    StatusCounts all{};
    for (int round = 0; round < 3000; ++round) {
        std::vector<std::uint8_t> session = seeds[random() % seeds.size()];
        for (auto change = random() % 12; change-- > 0;)
            session[random() % session.size()] = static_cast<std::uint8_t>(random());
        if (random() % 4 == 0) session.insert(session.end(), session.begin(), session.end());
        const StatusCounts counts = run_c_api_session(session);
        for (std::size_t i = 0; i < all.size(); ++i) all[i] += counts[i];
    }
    for (const rhview_status status :
         {RHVIEW_OK, RHVIEW_INVALID_ARGUMENT, RHVIEW_INVALID_DATA, RHVIEW_WRONG_STATE, RHVIEW_OUT_OF_MEMORY})
        EXPECT_GT(all[static_cast<std::size_t>(status)], 100u) << status;
    EXPECT_EQ(all[RHVIEW_INTERNAL_ERROR], 0u);
}

}  // namespace
}  // namespace rhview
