// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace rhview::cli {

/// A line on standard error that is redrawn; nothing at all where that is no terminal.
class Progress {
  public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// What is being done, without a known length.
    void say(const std::string& what);
    /// A bar: `done` of `total`.
    void show(const std::string& what, int done, int total);
    /// Leaves an empty line, ready for other output.
    void clear();

  private:
    bool terminal_;
    bool shown_ = false;
    int last_percent_ = -1;
};

}  // namespace rhview::cli
