// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A file's bytes in memory: mapped where the system can, read where it can't.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

#include "rhview/base/result.h"

namespace rhview {

/// Begins at a multiple of 64 bytes. While it lives the caller keeps the file as it is: replacing it by
/// another of the same name (`rename`) is fine, writing into it or cutting it short is not.
class FileBytes {
  public:
    /// Errors: missing, a folder, not a plain file, unreadable, larger than memory can hold. Cost: a mapping
    /// costs nothing until its pages are touched; else one pass over the file.
    static Result<std::shared_ptr<const FileBytes>> open(const std::filesystem::path& file);

    /// A copy of `bytes`, aligned as promised; null where memory runs out.
    static std::shared_ptr<const FileBytes> copy_of(std::span<const std::byte> bytes);

    FileBytes(const FileBytes&) = delete;
    FileBytes& operator=(const FileBytes&) = delete;
    ~FileBytes();

    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

  private:
    FileBytes() = default;
    static std::shared_ptr<FileBytes> allocate(std::size_t size);

    std::span<const std::byte> bytes_;
    bool mapped_ = false;
};

}  // namespace rhview
