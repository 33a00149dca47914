// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/rho_writer.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "rho_format.h"
#include "rhview/base/checksum.h"

namespace rhview {
namespace {

/// Writes a section's pieces and hashes them on the way, a checksum block at a time.
class SectionStream {
  public:
    explicit SectionStream(ReplacementFile& file) : file_(file) { block_.reserve(kChecksumBlockBytes); }

    bool write(std::span<const std::byte> piece) {
        while (!piece.empty()) {
            const std::size_t taken = std::min(piece.size(), kChecksumBlockBytes - block_.size());
            block_.insert(block_.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(taken));
            piece = piece.subspan(taken);
            if (block_.size() == kChecksumBlockBytes && !write_block()) return false;
        }
        return true;
    }

    /// Ends the section.
    bool finish(RhoTableEntry& entry) {
        if (!block_.empty() && !write_block()) return false;
        entry.size = size_;
        entry.checksum = combine_block_hashes(hashes_);
        hashes_.clear();
        size_ = 0;
        return true;
    }

  private:
    bool write_block() {
        hashes_.push_back(xxh64(block_));
        const bool written = file_.write(block_);
        size_ += block_.size();
        block_.clear();
        return written;
    }

    ReplacementFile& file_;
    std::vector<std::byte> block_;
    std::vector<std::uint64_t> hashes_;
    std::uint64_t size_ = 0;
};

bool write_zeros(ReplacementFile& file, std::uint64_t count) {
    static constexpr std::array<std::byte, kSectionAlignment> kZeros{};
    for (; count > 0; count -= std::min<std::uint64_t>(count, kZeros.size())) {
        const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(count, kZeros.size()));
        if (!file.write(std::span(kZeros).first(size))) return false;
    }
    return true;
}

}  // namespace

Result<RhoWriter> RhoWriter::create(const std::filesystem::path& file) {
    Result<ReplacementFile> replacement = ReplacementFile::create(file);
    if (!replacement) return replacement.error();
    return RhoWriter(std::move(replacement).value());
}

void RhoWriter::add(SectionTag tag, std::uint32_t version, std::vector<std::span<const std::byte>> pieces) {
    RHVIEW_ASSERT(sections_.size() < kMaxSections &&
                  std::ranges::find(sections_, tag, &Section::tag) == sections_.end());
    sections_.push_back({tag, version, std::move(pieces)});
}

void RhoWriter::add_owned(SectionTag tag, std::uint32_t version, std::vector<std::byte> bytes) {
    owned_.push_back(std::make_unique<std::vector<std::byte>>(std::move(bytes)));
    add(tag, version, {*owned_.back()});
}

/// Header and table come last: a file that was not finished has none.
bool RhoWriter::write_sections(std::uint64_t& file_bytes) {
    std::vector<RhoTableEntry> table(sections_.size());
    std::uint64_t end = sizeof(RhoHeader) + table.size() * sizeof(RhoTableEntry);
    if (!write_zeros(file_, end)) return false;
    SectionStream stream(file_);
    for (std::size_t i = 0; i < sections_.size(); ++i) {
        if (!write_zeros(file_, aligned(end) - end)) return false;
        table[i].tag = sections_[i].tag;
        table[i].version = sections_[i].version;
        table[i].offset = aligned(end);
        for (const std::span<const std::byte> piece : sections_[i].pieces)
            if (!stream.write(piece)) return false;
        if (!stream.finish(table[i])) return false;
        end = table[i].offset + table[i].size;
    }
    RhoHeader header;
    header.file_bytes = file_bytes = end;
    header.section_count = static_cast<std::uint32_t>(table.size());
    header.checksum = header_checksum(header, table);
    return file_.seek(0) && file_.write(std::as_bytes(std::span(&header, 1))) &&
           file_.write(std::as_bytes(std::span(table)));
}

Result<std::uint64_t> RhoWriter::finish() {
    if constexpr (std::endian::native != std::endian::little)
        return Error{file_.file().string() + ": baked files are little-endian and this machine is not"};
    std::uint64_t file_bytes = 0;
    // What was not written fails the commit as well, and that has the sentence.
    write_sections(file_bytes);
    if (Status status = file_.commit(); !status) return status.error();
    return file_bytes;
}

}  // namespace rhview
