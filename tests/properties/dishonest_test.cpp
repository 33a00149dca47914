// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Linked with a planner that drops a visible node in so many (RHVIEW_DISHONEST_DROP) or rotates what hangs on
// its queries (RHVIEW_DISHONEST_ANSWERS): the property checks must find out.

#include <gtest/gtest.h>

#include <iostream>

#include "run_property.h"

namespace rhview {
namespace {

#ifdef RHVIEW_DISHONEST_DROP
#define RHVIEW_DISHONEST_SUITE DroppedNode
#else
#define RHVIEW_DISHONEST_SUITE RotatedAnswer
#endif

TEST(RHVIEW_DISHONEST_SUITE, is_found_and_shrunk_to_a_case_that_fails_when_it_is_read_back) {
    std::uint32_t failed = 0;
    PropertyCase first;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        const PropertyCase property = random_property_case(seed);
        if (run_property(property).failure.empty()) continue;
        if (failed++ == 0) first = property;
    }
    std::cout << failed << " of 60 cases fail\n";
    ASSERT_GT(failed, 0u);
    const PropertyCase simplest = shrink(first);
    EXPECT_LE(simplest.triangles, first.triangles);
    EXPECT_LE(simplest.frames, first.frames);
    EXPECT_FALSE(simplest == first);
    const std::optional<PropertyCase> back = read_property_case(text_of(simplest));
    ASSERT_TRUE(back.has_value());
    const std::string failure = run_property(*back).failure;
    EXPECT_NE(failure, "");
    std::cout << failure << '\n' << text_of(simplest);
}

}  // namespace
}  // namespace rhview
