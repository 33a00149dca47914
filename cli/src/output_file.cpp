// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "output_file.h"

#include <string>
#include <system_error>
#include <utility>

namespace rhview::cli {
namespace {

Error unwritable(const std::filesystem::path& file) {
    return Error{file.string() +
                 ": can't be written; check that the folder exists, may be written to and has space"};
}

}  // namespace

Result<OutputFile> OutputFile::open(const std::filesystem::path& file) {
    OutputFile output;
    output.file_ = file;
    // Devices and pipes are written to, never replaced.
    std::error_code error;
    const std::filesystem::file_type type = std::filesystem::status(file, error).type();
    if (type == std::filesystem::file_type::character || type == std::filesystem::file_type::fifo) {
        output.device_.reset(std::fopen(output.file_.string().c_str(), "wb"));
        if (output.device_ == nullptr) return unwritable(file);
        return output;
    }
    Result<ReplacementFile> replacement = ReplacementFile::create(file);
    if (!replacement) return replacement.error();
    output.replacement_.emplace(std::move(replacement).value());
    return output;
}

Status OutputFile::commit(std::string_view text) {
    if (replacement_) {
        replacement_->write(text);
        return replacement_->commit();
    }
    bool written = std::fwrite(text.data(), 1, text.size(), device_.get()) == text.size();
    written = std::fclose(device_.release()) == 0 && written;
    return written ? success() : unwritable(file_);
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
