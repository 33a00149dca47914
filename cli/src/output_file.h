// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "rhview/base/replacement_file.h"

namespace rhview::cli {

/// A text file that appears whole or not at all (`ReplacementFile`). Opening it first tells of an unwritable
/// place before any work is done. A device or pipe is written to as it is.
class OutputFile {
  public:
    static Result<OutputFile> open(const std::filesystem::path& file);

    /// Writes all of it and puts it in place.
    Status commit(std::string_view text);

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    OutputFile() = default;

    std::filesystem::path file_;
    std::optional<ReplacementFile> replacement_;
    std::unique_ptr<std::FILE, Close> device_;  ///< where there is no replacement
};

/// The file that `file` means: absolute, links followed, also where it does not exist yet. Empty when it
/// can't be told.
std::filesystem::path resolved(const std::filesystem::path& file);

/// Makes `folder` where it is missing, and makes sure that files can be written there.
Status prepare_folder(const std::filesystem::path& folder);

}  // namespace rhview::cli
