// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Contract checks: what the caller promised. Bad data from outside is a `Result`, not an assert.
#pragma once

namespace rhview {

/// Called when a contract is broken. May return: the checked function then goes on, at the caller's risk.
using AssertHandler = void (*)(const char* condition, const char* file, int line);

/// Replaces the handler (default: print to standard error and abort) and returns the one before.
/// Null restores the default. Not thread-safe: set it before other threads use the library.
AssertHandler set_assert_handler(AssertHandler handler);

/// What `RHVIEW_ASSERT` calls; do not call it directly.
void report_assert(const char* condition, const char* file, int line);

}  // namespace rhview

#ifndef RHVIEW_ENABLE_ASSERTS
/// 1: broken contracts are looked for. The build sets it in Debug and RelWithDebInfo.
#define RHVIEW_ENABLE_ASSERTS 0
#endif

/// On in Debug and RelWithDebInfo builds of the library; evaluates nothing otherwise.
#if RHVIEW_ENABLE_ASSERTS
#define RHVIEW_ASSERT(condition) \
    ((condition) ? static_cast<void>(0) : ::rhview::report_assert(#condition, __FILE__, __LINE__))
#else
#define RHVIEW_ASSERT(condition) static_cast<void>(sizeof(!(condition)))
#endif
