// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The library prints nothing: what it has to say goes to one callback, which the application sets.
#pragma once

#include <string_view>

namespace rhview {

/// How much a message matters; the least first.
enum class LogLevel { Debug, Info, Warning, Error };

/// Takes a sentence, which is valid during the call.
using LogCallback = void (*)(LogLevel level, std::string_view message);

/// Sets the callback (null: messages are dropped, the default) and returns the one before.
/// The callback may be called from any thread that uses the library.
LogCallback set_log_callback(LogCallback callback);

/// Passes `message` on to the callback.
void log(LogLevel level, std::string_view message);

}  // namespace rhview
