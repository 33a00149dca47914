// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Container of baked files (`.rho`): a checked table of sections, each with a tag, a version and a checksum.
///
/// What the sections hold is their modules' business; this reader proves that a section is whole before it
/// hands it out. Little-endian; sections begin at multiples of 64 bytes. The bytes are those of the file, not
/// copied. Errors are one sentence that names the file, the place and the mend. Layout: docs/files.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "rhview/base/file_bytes.h"
#include "rhview/base/mappable_array.h"
#include "rhview/base/result.h"

namespace rhview {

/// Four letters that say what a section holds.
using SectionTag = std::array<char, 4>;

/// "ONOD" -> tag; anything but four letters does not compile.
consteval SectionTag section_tag(const char (&letters)[5]) {
    return {letters[0], letters[1], letters[2], letters[3]};
}

/// An open baked file: its sections, found by tag. Copies share the mapped bytes.
class RhoFile {
  public:
    /// The format's version that is written, and the newest that is read.
    static constexpr std::uint32_t kVersion = 1;

    /// Maps `file` and checks header and table. Errors as `FileBytes::open`, and: empty, cut short or too
    /// long, another format, another byte order, a newer version, a damaged header or table, sections that
    /// overlap or leave the file. Cost: independent of the sections' sizes.
    static Result<RhoFile> open(const std::filesystem::path& file);

    /// The same of bytes in memory; errors call them `name`.
    static Result<RhoFile> parse(std::shared_ptr<const FileBytes> bytes, std::string name);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::size_t size_bytes() const { return bytes_->bytes().size(); }
    /// What keeps the sections' bytes alive.
    [[nodiscard]] const std::shared_ptr<const FileBytes>& owner() const { return bytes_; }
    [[nodiscard]] bool has(SectionTag tag) const { return find(tag) != nullptr; }

    /// The bytes of a section that is whole. Errors: it is absent, it is of a version above `version` or
    /// below `oldest`, its checksum is wrong. Cost: one pass over it, on all of oneTBB's threads.
    [[nodiscard]] Result<MappableArray<std::byte>> section(SectionTag tag, std::uint32_t version,
                                                           std::uint32_t oldest = 1) const;

    /// The version of a section that `section` accepted; 0 where there is none.
    [[nodiscard]] std::uint32_t version_of(SectionTag tag) const;

    /// The section as records of `T`. `T` has no pointers and no padding. Another error: its size is no
    /// multiple of a record's.
    template <class T>
    [[nodiscard]] Result<MappableArray<T>> array(SectionTag tag, std::uint32_t version) const {
        static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 64);
        const Result<MappableArray<std::byte>> bytes = section(tag, version);
        if (!bytes) return bytes.error();
        if (bytes->size() % sizeof(T) != 0) return not_records(tag, bytes->size(), sizeof(T));
        return MappableArray<T>(
            std::span(reinterpret_cast<const T*>(bytes->data()), bytes->size() / sizeof(T)), bytes_);
    }

    /// "<name>: section TAG: <what>; <mend>": what a module says of a section that contradicts itself.
    [[nodiscard]] Error error(SectionTag tag, std::string_view what) const;

  private:
    struct Section {
        SectionTag tag;
        std::uint32_t version;
        std::uint64_t offset;
        std::uint64_t size;
        std::uint64_t checksum;
    };

    RhoFile() = default;
    Status read_header(std::uint32_t& section_count) const;
    Status read_table(std::uint32_t section_count);
    Status check_gap(std::uint64_t begin, std::uint64_t end) const;
    [[nodiscard]] const Section* find(SectionTag tag) const;
    [[nodiscard]] Error error(std::string_view what) const;
    [[nodiscard]] Error not_records(SectionTag tag, std::size_t bytes, std::size_t record_bytes) const;

    std::string name_;
    std::shared_ptr<const FileBytes> bytes_;
    std::vector<Section> sections_;
};

}  // namespace rhview
