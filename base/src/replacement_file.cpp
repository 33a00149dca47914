// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/replacement_file.h"

#include <string>
#include <system_error>
#include <utility>

#include "platform_file.h"

namespace rhview {
namespace {

Error unwritable(const std::filesystem::path& file) {
    return Error{file.string() +
                 ": can't be written; check that the folder exists, may be written to and has space"};
}

/// What is replaced may be for its owner's eyes only: so is what replaces it, from its first byte on.
void take_permissions(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(from, error);
    if (status.type() == std::filesystem::file_type::regular)
        std::filesystem::permissions(to, status.permissions(), error);
}

}  // namespace

ReplacementFile::ReplacementFile(std::filesystem::path file, std::filesystem::path temporary)
    : file_(std::move(file)), temporary_(std::move(temporary)) {}

bool ReplacementFile::open() {
    const std::string name = temporary_.string();
    stream_.reset(std::fopen(name.c_str(), "wbx"));
    is_there_ = stream_ != nullptr;
    return is_there_;
}

ReplacementFile::ReplacementFile(ReplacementFile&& other) noexcept
    : file_(std::move(other.file_)),
      temporary_(std::move(other.temporary_)),
      stream_(std::move(other.stream_)),
      is_there_(std::exchange(other.is_there_, false)),
      failed_(other.failed_) {}

ReplacementFile::~ReplacementFile() {
    if (!is_there_) return;
    stream_.reset();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
}

Result<ReplacementFile> ReplacementFile::create(const std::filesystem::path& file) {
    if (file.empty()) return Error{"an output file needs a name"};
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(file, error);
    if (error) return unwritable(file);
    const std::filesystem::path target = std::filesystem::weakly_canonical(absolute, error);
    if (error) return unwritable(file);
    if (std::filesystem::is_directory(target, error))
        return Error{file.string() + ": is a folder; name a file in it"};
    if (std::filesystem::exists(target, error) && !std::filesystem::is_regular_file(target, error))
        return Error{file.string() + ": is not a plain file, and only such can be replaced; name another"};
    // Another writer, or one that crashed, may have left its temporary file: the next free name is taken. The
    // mode "x" opens nothing that is there already, and follows no link.
    constexpr int kNames = 100;
    for (int i = 0; i < kNames; ++i) {
        std::filesystem::path temporary = target;
        temporary += i == 0 ? std::string(".part") : "." + std::to_string(i) + ".part";
        // Whose it is stands before it is there: it is removed again also where memory runs out here.
        ReplacementFile replacement(target, std::move(temporary));
        if (replacement.open()) {
            take_permissions(target, replacement.temporary_);
            return replacement;
        }
        if (!std::filesystem::exists(std::filesystem::symlink_status(replacement.temporary_, error))) break;
    }
    return unwritable(file);
}

bool ReplacementFile::write(std::span<const std::byte> bytes) {
    if (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) != bytes.size())
        failed_ = true;
    return !failed_;
}

bool ReplacementFile::seek(long offset) {
    if (std::fseek(stream_.get(), offset, SEEK_SET) != 0) failed_ = true;
    return !failed_;
}

Status ReplacementFile::commit() {
    bool written = !failed_ && flush_to_disk(stream_.get());
    written = std::fclose(stream_.release()) == 0 && written;
    if (!written) return unwritable(file_);
    std::error_code error;
    std::filesystem::rename(temporary_, file_, error);
    if (error) return unwritable(file_);
    is_there_ = false;
    flush_folder(file_.parent_path());
    return success();
}

}  // namespace rhview
