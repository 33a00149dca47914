// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/assert.h"

#include <cstdio>
#include <cstdlib>

namespace rhview {
namespace {

void abort_with_message(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "rhview: contract broken: %s (%s:%d)\n", condition, file, line);
    std::abort();
}

AssertHandler current_handler = abort_with_message;

}  // namespace

AssertHandler set_assert_handler(AssertHandler handler) {
    const AssertHandler previous = current_handler;
    current_handler = handler != nullptr ? handler : abort_with_message;
    return previous;
}

void report_assert(const char* condition, const char* file, int line) {
    current_handler(condition, file, line);
}

}  // namespace rhview
