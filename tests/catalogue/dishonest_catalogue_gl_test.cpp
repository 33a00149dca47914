// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Linked with a planner that drops a visible node in so many (RHVIEW_DISHONEST_DROP): the catalogue must find
// out.

#include <gtest/gtest.h>

#include "case_run.h"
#include "rhview/gl/context.h"

namespace rhview {
namespace {

TEST(DroppedNode, is_found_by_the_catalogue) {
    Result<gl::Context> context = gl::Context::create_headless();
    ASSERT_TRUE(context.ok()) << context.error().message;
    const Tally tally = run_case(hard_cases().front(), 12, Amount::Sample);
    EXPECT_GT(tally.missing, 50u);
    EXPECT_EQ(tally.first_missing.substr(0, 6), "rhview");
}

}  // namespace
}  // namespace rhview
