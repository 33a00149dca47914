// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/result.h"

#include <gtest/gtest.h>

#include "rhview/base/log.h"
#include "rhview/base/version.h"

namespace rhview {
namespace {

int broken_contracts = 0;
std::string last_message;

TEST(Result, holds_a_value_or_an_error) {
    const Result<int> good = 7;
    ASSERT_TRUE(good.ok());
    EXPECT_EQ(*good, 7);
    const Result<int> bad = Error{"town.glb: truncated"};
    ASSERT_FALSE(bad.ok());
    EXPECT_EQ(bad.error().message, "town.glb: truncated");
}

TEST(Result, value_moves_out) {
    Result<std::string> text = std::string("moved");
    const std::string out = std::move(text).value();
    EXPECT_EQ(out, "moved");
}

TEST(Assert, broken_contract_is_counted_by_the_handler_where_asserts_are_on) {
    const AssertHandler previous =
        set_assert_handler([](const char*, const char*, int) { ++broken_contracts; });
    broken_contracts = 0;
    int evaluated = 0;
    RHVIEW_ASSERT(++evaluated > 100);
    set_assert_handler(previous);
    EXPECT_EQ(broken_contracts, RHVIEW_ENABLE_ASSERTS);
    EXPECT_EQ(evaluated, RHVIEW_ENABLE_ASSERTS);
}

TEST(Log, message_reaches_the_callback_and_is_dropped_without_one) {
    const LogCallback previous =
        set_log_callback([](LogLevel, std::string_view message) { last_message = message; });
    log(LogLevel::Info, "hello");
    EXPECT_EQ(last_message, "hello");
    set_log_callback(nullptr);
    log(LogLevel::Info, "dropped");
    EXPECT_EQ(last_message, "hello");
    set_log_callback(previous);
}

TEST(Version, numbers_and_text_agree) {
    EXPECT_EQ(std::string(kVersion), std::to_string(RHVIEW_VERSION_MAJOR) + "." +
                                         std::to_string(RHVIEW_VERSION_MINOR) + "." +
                                         std::to_string(RHVIEW_VERSION_PATCH));
}

}  // namespace
}  // namespace rhview
