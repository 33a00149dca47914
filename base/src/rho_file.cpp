// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/rho_file.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "rho_format.h"
#include "rhview/base/checksum.h"

namespace rhview {
namespace {

constexpr std::string_view kMend = "; bake the scene again (rhview bake SCENE -o FILE.rho)";

std::string text_of(SectionTag tag) {
    std::string text;
    for (const char letter : tag) text += letter >= ' ' && letter <= '~' ? letter : '?';
    return text;
}

template <class T>
T read_at(std::span<const std::byte> bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

}  // namespace

std::uint64_t header_checksum(const RhoHeader& header, std::span<const RhoTableEntry> table) {
    RhoHeader unsummed = header;
    unsummed.checksum = 0;
    std::vector<std::byte> bytes(sizeof(RhoHeader) + table.size_bytes());
    std::memcpy(bytes.data(), &unsummed, sizeof(RhoHeader));
    if (!table.empty()) std::memcpy(bytes.data() + sizeof(RhoHeader), table.data(), table.size_bytes());
    return xxh64(bytes);
}

Error RhoFile::error(std::string_view what) const {
    return Error{name_ + ": " + std::string(what) + std::string(kMend)};
}

Error RhoFile::error(SectionTag tag, std::string_view what) const {
    return error("section " + text_of(tag) + ": " + std::string(what));
}

Error RhoFile::not_records(SectionTag tag, std::size_t bytes, std::size_t record_bytes) const {
    return error(tag, std::to_string(bytes) + " bytes are no whole number of records of " +
                          std::to_string(record_bytes));
}

const RhoFile::Section* RhoFile::find(SectionTag tag) const {
    const auto found = std::ranges::find(sections_, tag, &Section::tag);
    return found != sections_.end() ? &*found : nullptr;
}

Result<RhoFile> RhoFile::open(const std::filesystem::path& file) {
    Result<std::shared_ptr<const FileBytes>> bytes = FileBytes::open(file);
    if (!bytes) return bytes.error();
    return parse(std::move(bytes).value(), file.string());
}

Result<RhoFile> RhoFile::parse(std::shared_ptr<const FileBytes> bytes, std::string name) {
    RhoFile file;
    file.name_ = std::move(name);
    file.bytes_ = std::move(bytes);
    if (file.bytes_ == nullptr)
        return Error{file.name_ + ": there is not enough memory to hold it; make some free"};
    std::uint32_t section_count = 0;
    if (Status status = file.read_header(section_count); !status) return status.error();
    if (Status status = file.read_table(section_count); !status) return status.error();
    return file;
}

Status RhoFile::read_header(std::uint32_t& section_count) const {
    if constexpr (std::endian::native != std::endian::little)
        return Error{name_ +
                     ": baked files are little-endian and this machine is not; load the source scene"};
    const std::span<const std::byte> bytes = bytes_->bytes();
    if (bytes.empty()) return error("is empty");
    if (std::memcmp(bytes.data(), kRhoMagic.data(), std::min(bytes.size(), kRhoMagic.size())) != 0)
        return error("is not a baked file: it does not begin as one");
    if (bytes.size() < sizeof(RhoHeader))
        return error("is cut short in its header (" + std::to_string(bytes.size()) + " bytes)");
    const auto header = read_at<RhoHeader>(bytes, 0);
    if (header.byte_order == kOtherByteOrder)
        return error("header: is big-endian, and baked files are little-endian");
    if (header.byte_order != kByteOrderMark) return error("header: the byte-order mark is damaged");
    if (header.version > kVersion)
        return Error{name_ + ": is of format version " + std::to_string(header.version) +
                     ", and this program reads up to " + std::to_string(kVersion) +
                     "; update rhview or bake the scene again with this program"};
    if (header.version == 0) return error("header: there is no format version 0");
    if (header.file_bytes > bytes.size())
        return error("is cut short: " + std::to_string(bytes.size()) + " of " +
                     std::to_string(header.file_bytes) + " bytes are there");
    if (header.file_bytes < bytes.size())
        return error("has " + std::to_string(bytes.size() - header.file_bytes) + " bytes after its end");
    if (header.section_count > kMaxSections)
        return error("header: " + std::to_string(header.section_count) + " sections, at most " +
                     std::to_string(kMaxSections) + " are possible");
    if (sizeof(RhoHeader) + header.section_count * sizeof(RhoTableEntry) > bytes.size())
        return error("header: its table of " + std::to_string(header.section_count) +
                     " sections ends after the file");
    section_count = header.section_count;
    return success();
}

Status RhoFile::read_table(std::uint32_t section_count) {
    const std::span<const std::byte> bytes = bytes_->bytes();
    const auto header = read_at<RhoHeader>(bytes, 0);
    std::vector<RhoTableEntry> table(section_count);
    for (std::uint32_t i = 0; i < section_count; ++i)
        table[i] = read_at<RhoTableEntry>(bytes, sizeof(RhoHeader) + i * sizeof(RhoTableEntry));
    if (header_checksum(header, table) != header.checksum)
        return error("header: its checksum does not fit: the file is damaged");
    if (header.zero != 0 || std::ranges::any_of(header.reserved, [](std::uint8_t byte) { return byte != 0; }))
        return error("header: its unused bytes are not zero");
    std::uint64_t end = sizeof(RhoHeader) + section_count * sizeof(RhoTableEntry);
    for (const RhoTableEntry& entry : table) {
        if (has(entry.tag)) return error(entry.tag, "is there twice");
        if (entry.offset % kSectionAlignment != 0)
            return error(entry.tag, "offset " + std::to_string(entry.offset) + " is no multiple of 64");
        if (entry.offset < end)
            return error(entry.tag, "offset " + std::to_string(entry.offset) +
                                        " is inside what stands before it (up to " + std::to_string(end) +
                                        ")");
        if (entry.offset > bytes.size() || entry.size > bytes.size() - entry.offset)
            return error(entry.tag, std::to_string(entry.size) + " bytes at " + std::to_string(entry.offset) +
                                        " end after the file (" + std::to_string(bytes.size()) + " bytes)");
        if (Status status = check_gap(end, entry.offset); !status) return status.error();
        sections_.push_back({entry.tag, entry.version, entry.offset, entry.size, entry.checksum});
        end = entry.offset + entry.size;
    }
    return end == bytes.size() ? success()
                               : error(std::to_string(bytes.size() - end) + " bytes after the last section");
}

/// Sections follow each other as closely as their alignment allows, with zeros between: so every byte of the
/// file is checked by something.
Status RhoFile::check_gap(std::uint64_t begin, std::uint64_t end) const {
    if (end != aligned(begin))
        return error("there is a hole between " + std::to_string(begin) + " and " + std::to_string(end));
    for (std::uint64_t i = begin; i < end; ++i)
        if (bytes_->bytes()[i] != std::byte{0})
            return error("byte " + std::to_string(i) + ", between sections, is not zero");
    return success();
}

std::uint32_t RhoFile::version_of(SectionTag tag) const {
    const Section* const found = find(tag);
    return found == nullptr ? 0 : found->version;
}

Result<MappableArray<std::byte>> RhoFile::section(SectionTag tag, std::uint32_t version,
                                                  std::uint32_t oldest) const {
    const Section* const found = find(tag);
    if (found == nullptr) return error("section " + text_of(tag) + " is missing");
    if (found->version > version)
        return Error{name_ + ": section " + text_of(tag) + " is of version " +
                     std::to_string(found->version) + ", and this program reads up to " +
                     std::to_string(version) + "; update rhview or bake the scene again with this program"};
    if (found->version == 0) return error(tag, "there is no version 0");
    if (found->version < oldest)
        return Error{name_ + ": section " + text_of(tag) + " is of version " +
                     std::to_string(found->version) + ", and this program reads none before " +
                     std::to_string(oldest) + "; bake the scene again with this program"};
    const std::span<const std::byte> bytes = bytes_->bytes().subspan(found->offset, found->size);
    if (block_checksum(bytes) != found->checksum)
        return error(tag, "its checksum does not fit: the file is damaged");
    return MappableArray<std::byte>(bytes, bytes_);
}

}  // namespace rhview
