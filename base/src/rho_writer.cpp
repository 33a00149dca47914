// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/rho_writer.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <system_error>

#include "platform_file.h"
#include "rho_format.h"
#include "rhview/base/checksum.h"

namespace rhview {
namespace {

Error unwritable(const std::filesystem::path& file) {
    return Error{file.string() +
                 ": can't be written; check that the folder exists, may be written to and has space"};
}

/// Writes a section's pieces and hashes them on the way, a checksum block at a time.
class SectionStream {
  public:
    explicit SectionStream(std::FILE* file) : file_(file) { block_.reserve(kChecksumBlockBytes); }

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
        const bool written = std::fwrite(block_.data(), 1, block_.size(), file_) == block_.size();
        size_ += block_.size();
        block_.clear();
        return written;
    }

    std::FILE* file_;
    std::vector<std::byte> block_;
    std::vector<std::uint64_t> hashes_;
    std::uint64_t size_ = 0;
};

bool write_zeros(std::FILE* file, std::uint64_t count) {
    static constexpr std::array<std::byte, kSectionAlignment> kZeros{};
    for (; count > 0; count -= std::min<std::uint64_t>(count, kZeros.size())) {
        const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(count, kZeros.size()));
        if (std::fwrite(kZeros.data(), 1, size, file) != size) return false;
    }
    return true;
}

}  // namespace

RhoWriter::RhoWriter(std::filesystem::path file, std::filesystem::path temporary, std::FILE* stream)
    : file_(std::move(file)), temporary_(std::move(temporary)), stream_(stream) {}

RhoWriter::RhoWriter(RhoWriter&& other) noexcept
    : file_(std::move(other.file_)),
      temporary_(std::move(other.temporary_)),
      stream_(std::move(other.stream_)),
      sections_(std::move(other.sections_)),
      owned_(std::move(other.owned_)) {
    other.temporary_.clear();
}

RhoWriter::~RhoWriter() {
    if (temporary_.empty()) return;
    stream_.reset();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
}

Result<RhoWriter> RhoWriter::create(const std::filesystem::path& file) {
    if (file.empty()) return Error{"a baked file needs a name"};
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(file, error);
    if (error) return unwritable(file);
    const std::filesystem::path target = std::filesystem::weakly_canonical(absolute, error);
    if (error) return unwritable(file);
    if (std::filesystem::is_directory(target, error))
        return Error{file.string() + ": is a folder; name a file in it"};
    if (std::filesystem::exists(target, error) && !std::filesystem::is_regular_file(target, error))
        return Error{file.string() + ": is not a plain file, and only such can be baked to; name another"};
    // Another writer, or one that crashed, may have left its temporary file: the next free name is taken.
    constexpr int kNames = 100;
    for (int i = 0; i < kNames; ++i) {
        std::filesystem::path temporary = target;
        temporary += i == 0 ? std::string(".part") : "." + std::to_string(i) + ".part";
        if (std::FILE* const stream = std::fopen(temporary.string().c_str(), "wbx"))
            return RhoWriter(target, std::move(temporary), stream);
        if (!std::filesystem::exists(temporary, error)) break;
    }
    return unwritable(file);
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
    std::FILE* const file = stream_.get();
    std::vector<RhoTableEntry> table(sections_.size());
    std::uint64_t end = sizeof(RhoHeader) + table.size() * sizeof(RhoTableEntry);
    if (!write_zeros(file, end)) return false;
    SectionStream stream(file);
    for (std::size_t i = 0; i < sections_.size(); ++i) {
        if (!write_zeros(file, aligned(end) - end)) return false;
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
    return std::fseek(file, 0, SEEK_SET) == 0 && std::fwrite(&header, sizeof(header), 1, file) == 1 &&
           std::fwrite(table.data(), sizeof(RhoTableEntry), table.size(), file) == table.size() &&
           flush_to_disk(file);
}

Result<std::uint64_t> RhoWriter::finish() {
    if constexpr (std::endian::native != std::endian::little)
        return Error{file_.string() + ": baked files are little-endian and this machine is not"};
    std::uint64_t file_bytes = 0;
    bool written = write_sections(file_bytes);
    written = std::fclose(stream_.release()) == 0 && written;
    if (!written) return unwritable(file_);
    std::error_code error;
    std::filesystem::rename(temporary_, file_, error);
    if (error) return unwritable(file_);
    temporary_.clear();
    flush_folder(file_.parent_path());
    return file_bytes;
}

}  // namespace rhview
