// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/log.h"

#include <atomic>

namespace rhview {
namespace {

std::atomic<LogCallback> current_callback{nullptr};

}  // namespace

LogCallback set_log_callback(LogCallback callback) {
    return current_callback.exchange(callback);
}

void log(LogLevel level, std::string_view message) {
    if (const LogCallback callback = current_callback.load()) callback(level, message);
}

}  // namespace rhview
