// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "output_file.h"

#include <unistd.h>

#include <string>
#include <system_error>

namespace rhview::cli {
namespace {

Error unwritable(const std::filesystem::path& file) {
    return Error{file.string() +
                 ": can't be written; check that the folder exists, may be written to and has space"};
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path file, std::filesystem::path temporary)
    : file_(std::move(file)),
      temporary_(std::move(temporary)),
      stream_(temporary_.empty() ? file_ : temporary_, std::ios::binary) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : file_(std::move(other.file_)),
      temporary_(std::move(other.temporary_)),
      stream_(std::move(other.stream_)) {
    other.temporary_.clear();
}

OutputFile::~OutputFile() {
    if (temporary_.empty()) return;
    stream_.close();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
}

Result<OutputFile> OutputFile::open(const std::filesystem::path& file) {
    std::error_code error;
    if (file.empty()) return Error{"an output file needs a name"};
    if (std::filesystem::is_directory(file, error))
        return Error{file.string() + ": is a folder; name a file in it"};
    // Through links to the file meant; devices and pipes are written to, never replaced.
    std::filesystem::path target = resolved(file);
    if (target.empty()) return unwritable(file);
    const bool in_place =
        std::filesystem::exists(target, error) && !std::filesystem::is_regular_file(target, error);
    std::filesystem::path temporary;
    if (!in_place) {
        temporary = target;
        temporary += "." + std::to_string(getpid()) + ".part";
        if (std::filesystem::exists(temporary, error)) return unwritable(file);
    }
    OutputFile output(std::move(target), std::move(temporary));
    if (!output.stream_.is_open()) {
        output.temporary_.clear();
        return unwritable(file);
    }
    return output;
}

Status OutputFile::commit(std::string_view text) {
    stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream_.close();
    if (!stream_) return unwritable(file_);
    if (temporary_.empty()) return success();
    std::error_code error;
    std::filesystem::rename(temporary_, file_, error);
    if (error) return unwritable(file_);
    temporary_.clear();
    return success();
}

std::filesystem::path resolved(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(file, error);
    if (error) return {};
    std::filesystem::path target = std::filesystem::weakly_canonical(absolute, error);
    return error ? std::filesystem::path() : target;
}

Status prepare_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder, error))
        return Error{folder.string() + ": can't be made as a folder; check the path and its permissions"};
    const Result<OutputFile> probe = OutputFile::open(folder / "rhview-probe");
    if (!probe) return Error{folder.string() + ": can't be written to; check its permissions"};
    return success();
}

}  // namespace rhview::cli
