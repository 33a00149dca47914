// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What the standard library has no word for: mapped files, and writes that are on the disk when they return.
/// On systems without POSIX calls nothing is mapped or forced to the disk, and the rest goes on as well.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>

namespace rhview {

/// The file's bytes, read only; nothing where the system can't map it. Not for empty files.
std::optional<std::span<const std::byte>> map_file(const std::filesystem::path& file);
void unmap_file(std::span<const std::byte> bytes);

/// Hands what was written to `file` to the disk; false when it did not take it.
bool flush_to_disk(std::FILE* file);
/// Makes a renamed entry of `folder` last; as far as the system can.
void flush_folder(const std::filesystem::path& folder);

}  // namespace rhview
