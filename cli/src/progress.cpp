// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace rhview::cli {
namespace {

constexpr int kBarWidth = 32;
constexpr const char* kEraseLine = "\r\x1b[K";

}  // namespace

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    clear();
}

void Progress::clear() {
    if (shown_) fmt::print(stderr, "{}", kEraseLine);
    shown_ = false;
}

void Progress::say(const std::string& what) {
    last_percent_ = -1;
    shown_ = terminal_;
    if (terminal_) fmt::print(stderr, "{}{} …", kEraseLine, what);
}

void Progress::show(const std::string& what, int done, int total) {
    const int percent = total > 0 ? 100 * done / total : 100;
    if (!terminal_ || percent == last_percent_) return;
    last_percent_ = percent;
    shown_ = true;
    const int filled = kBarWidth * percent / 100;
    fmt::print(stderr, "{}{} [{:#<{}}{:.<{}}] {}/{}", kEraseLine, what, "", filled, "", kBarWidth - filled,
               done, total);
}

}  // namespace rhview::cli
