// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "platform_file.h"

#if defined(__unix__) || defined(__APPLE__)
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <limits>

namespace rhview {
namespace {

/// A file descriptor, closed at the end of its scope.
struct Descriptor {
    explicit Descriptor(const std::filesystem::path& path)
        : number(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int number;
};

}  // namespace

std::optional<std::span<const std::byte>> map_file(const std::filesystem::path& file) {
    const Descriptor descriptor(file);
    struct stat status {};
    if (descriptor.number < 0 || fstat(descriptor.number, &status) != 0 || status.st_size <= 0 ||
        static_cast<std::uintmax_t>(status.st_size) > std::numeric_limits<std::size_t>::max())
        return std::nullopt;
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const address = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor.number, 0);
    if (address == MAP_FAILED) return std::nullopt;
    return std::span(static_cast<const std::byte*>(address), size);
}

void unmap_file(std::span<const std::byte> bytes) {
    munmap(const_cast<std::byte*>(bytes.data()), bytes.size());
}

bool flush_to_disk(std::FILE* file) {
    return std::fflush(file) == 0 && fsync(fileno(file)) == 0;
}

void flush_folder(const std::filesystem::path& folder) {
    const Descriptor descriptor(folder);
    if (descriptor.number >= 0) fsync(descriptor.number);
}

}  // namespace rhview

#else

namespace rhview {

std::optional<std::span<const std::byte>> map_file(const std::filesystem::path&) {
    return std::nullopt;
}

void unmap_file(std::span<const std::byte>) {}

bool flush_to_disk(std::FILE* file) {
    return std::fflush(file) == 0;
}

void flush_folder(const std::filesystem::path&) {}

}  // namespace rhview

#endif
