// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

#include "rhview/base/result.h"

namespace rhview::cli {

/// A text file that appears whole or not at all: written beside its place, then renamed. Opening it first
/// tells of an unwritable place before any work is done. A device or pipe is written to as it is.
class OutputFile {
  public:
    static Result<OutputFile> open(const std::filesystem::path& file);

    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&&) = delete;
    ~OutputFile();

    /// Writes all of it and puts it in place.
    Status commit(std::string_view text);

  private:
    OutputFile(std::filesystem::path file, std::filesystem::path temporary);

    std::filesystem::path file_;
    std::filesystem::path temporary_;  ///< empty once it is gone, and for devices and pipes
    std::ofstream stream_;
};

/// The file that `file` means: absolute, links followed, also where it does not exist yet. Empty when it
/// can't be told.
std::filesystem::path resolved(const std::filesystem::path& file);

/// Makes `folder` where it is missing, and makes sure that files can be written there.
Status prepare_folder(const std::filesystem::path& folder);

}  // namespace rhview::cli
