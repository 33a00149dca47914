// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A file that appears whole or not at all.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "rhview/base/result.h"

namespace rhview {

/// Written beside the place meant (`FILE.part`), handed to the disk, renamed: whoever opens the file sees the
/// old one or the new one, also after a crash. What was not committed is removed; a process that is killed
/// leaves its temporary file behind, and the next one takes another name.
///
/// Only files that this object made are written to: a file or link that stands where the temporary one should
/// is never opened. The temporary file gets the permissions of the file that it replaces.
class ReplacementFile {
  public:
    /// Opens the temporary file, so that an unwritable place is told before any work is done. Links are
    /// followed to the file meant. Errors: no name, a folder, not a plain file, not writable.
    static Result<ReplacementFile> create(const std::filesystem::path& file);

    ReplacementFile(ReplacementFile&& other) noexcept;
    ReplacementFile& operator=(ReplacementFile&&) = delete;
    ~ReplacementFile();

    /// Appends; false when the disk did not take it. A later `commit` then fails too.
    bool write(std::span<const std::byte> bytes);
    bool write(std::string_view text) { return write(std::as_bytes(std::span(text))); }
    /// Goes on writing at `offset` from the beginning.
    bool seek(long offset);

    /// Puts the file in place. Only once. On an error the old file stands as it was.
    Status commit();

    /// The file meant: absolute, links followed.
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    ReplacementFile(std::filesystem::path file, std::filesystem::path temporary);
    bool open();

    std::filesystem::path file_;
    std::filesystem::path temporary_;
    std::unique_ptr<std::FILE, Close> stream_;
    bool is_there_ = false;  ///< the temporary file, and it is ours
    bool failed_ = false;
};

}  // namespace rhview
