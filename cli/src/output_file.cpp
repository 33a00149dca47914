// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "output_file.h"

#include <system_error>

namespace rhview::cli {
namespace {

Error unwritable(const std::filesystem::path& file) {
    return Error{file.string() +
                 ": can't be written; check that the folder exists, may be written to and has space"};
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path file, std::filesystem::path temporary)
    : file_(std::move(file)), temporary_(std::move(temporary)), stream_(temporary_, std::ios::binary) {}

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
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
        return Error{file.string() + ": is a folder; name a file in it"};
    std::filesystem::path temporary = file;
    temporary += ".part";
    OutputFile output(file, temporary);
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
    std::error_code error;
    std::filesystem::rename(temporary_, file_, error);
    if (error) return unwritable(file_);
    temporary_.clear();
    return success();
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
