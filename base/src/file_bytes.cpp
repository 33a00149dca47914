// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/file_bytes.h"

#include <cstring>
#include <fstream>
#include <limits>
#include <new>
#include <system_error>

#include "platform_file.h"

namespace rhview {
namespace {

constexpr std::align_val_t kAlignment{64};

Status check_plain_file(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    const std::string name = file.string() + ": ";
    switch (status.type()) {
        case std::filesystem::file_type::regular:
            return success();
        case std::filesystem::file_type::not_found:
            return Error{name + "there is no such file; check the name"};
        case std::filesystem::file_type::directory:
            return Error{name + "is a folder; name a file in it"};
        case std::filesystem::file_type::none:
            return Error{name + "can't be looked at (" + error.message() +
                         "); check its folders' permissions"};
        default:
            return Error{name + "is not a plain file; copy it to one first"};
    }
}

}  // namespace

std::shared_ptr<FileBytes> FileBytes::allocate(std::size_t size) {
    std::shared_ptr<FileBytes> file(new FileBytes);
    if (size == 0) return file;
    auto* memory = static_cast<std::byte*>(::operator new(size, kAlignment, std::nothrow));
    if (memory == nullptr) return nullptr;
    file->bytes_ = {memory, size};
    return file;
}

FileBytes::~FileBytes() {
    if (mapped_)
        unmap_file(bytes_);
    else if (!bytes_.empty())
        ::operator delete(const_cast<std::byte*>(bytes_.data()), kAlignment);
}

std::shared_ptr<const FileBytes> FileBytes::copy_of(std::span<const std::byte> bytes) {
    std::shared_ptr<FileBytes> file = allocate(bytes.size());
    if (file != nullptr && !bytes.empty())
        std::memcpy(const_cast<std::byte*>(file->bytes_.data()), bytes.data(), bytes.size());
    return file;
}

Result<std::shared_ptr<const FileBytes>> FileBytes::open(const std::filesystem::path& file) {
    if (Status status = check_plain_file(file); !status) return status.error();
    if (const auto mapping = map_file(file)) {
        std::shared_ptr<FileBytes> mapped(new FileBytes);
        mapped->bytes_ = *mapping;
        mapped->mapped_ = true;
        return std::shared_ptr<const FileBytes>(std::move(mapped));
    }
    const Error unreadable{file.string() + ": can't be read; check its permissions"};
    std::ifstream stream(file, std::ios::binary);
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (!stream || error) return unreadable;
    if (size > std::numeric_limits<std::size_t>::max() / 2)
        return Error{file.string() + ": is larger than this machine's memory can hold"};
    std::shared_ptr<FileBytes> read = allocate(static_cast<std::size_t>(size));
    if (read == nullptr)
        return Error{file.string() + ": needs " + std::to_string(size) +
                     " bytes of memory, which are not free"};
    if (size > 0 && !stream.read(reinterpret_cast<char*>(const_cast<std::byte*>(read->bytes_.data())),
                                 static_cast<std::streamsize>(size)))
        return unreadable;
    return std::shared_ptr<const FileBytes>(std::move(read));
}

}  // namespace rhview
