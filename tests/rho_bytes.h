// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "rhview/base/checksum.h"

namespace rhview {

/// A baked file's bytes for tests that damage them. Offsets are those of docs/files.md, written out again
/// here, so that the tests don't take the reader's word for them.
struct RhoBytes {
    static constexpr std::size_t kVersion = 8, kByteOrder = 12, kFileBytes = 16, kSectionCount = 24,
                                 kZero = 28, kChecksum = 32, kReserved = 40, kTable = 64, kEntry = 32;
    static constexpr std::size_t kEntryVersion = 4, kEntryOffset = 8, kEntrySize = 16, kEntryChecksum = 24;

    std::vector<std::byte> bytes;

    template <class T>
    [[nodiscard]] T get(std::size_t offset) const {
        T value{};
        std::memcpy(&value, bytes.data() + offset, sizeof(T));
        return value;
    }
    template <class T>
    void set(std::size_t offset, T value) {
        std::memcpy(bytes.data() + offset, &value, sizeof(T));
    }

    [[nodiscard]] std::size_t section_count() const { return get<std::uint32_t>(kSectionCount); }
    /// Where entry `i` of the table stands.
    static std::size_t entry(std::size_t i) { return kTable + i * kEntry; }
    /// The entry of a section, or the number of sections.
    [[nodiscard]] std::size_t find(const std::string& tag) const {
        std::size_t i = 0;
        while (i < section_count() && std::memcmp(bytes.data() + entry(i), tag.data(), 4) != 0) ++i;
        return i;
    }
    [[nodiscard]] std::size_t offset_of(const std::string& tag) const {
        return static_cast<std::size_t>(get<std::uint64_t>(entry(find(tag)) + kEntryOffset));
    }

    /// Lays the file out anew with another content of section `tag`; checksums are for `repair`.
    void replace(const std::string& tag, std::span<const std::byte> content) {
        RhoBytes result;
        result.bytes.assign(bytes.begin(),
                            bytes.begin() + static_cast<std::ptrdiff_t>(entry(section_count())));
        for (std::size_t i = 0; i < section_count(); ++i) {
            const auto offset = get<std::uint64_t>(entry(i) + kEntryOffset);
            const auto size = get<std::uint64_t>(entry(i) + kEntrySize);
            const std::span<const std::byte> section =
                i == find(tag) ? content : std::span<const std::byte>(bytes).subspan(offset, size);
            result.bytes.resize((result.bytes.size() + 63) / 64 * 64);
            result.set<std::uint64_t>(entry(i) + kEntryOffset, result.bytes.size());
            result.set<std::uint64_t>(entry(i) + kEntrySize, section.size());
            result.bytes.insert(result.bytes.end(), section.begin(), section.end());
        }
        *this = std::move(result);
    }

    /// Makes all checksums and the length fit whatever the bytes are now: what is wrong then must be found by
    /// what it says. Counts and places that leave the bytes are kept as they are.
    void repair() {
        if (bytes.size() < kTable) return;
        set<std::uint64_t>(kFileBytes, bytes.size());
        const std::size_t fitting = (bytes.size() - kTable) / kEntry;
        if (section_count() > fitting) return;
        for (std::size_t i = 0; i < section_count(); ++i) {
            const auto offset = get<std::uint64_t>(entry(i) + kEntryOffset);
            const auto size = get<std::uint64_t>(entry(i) + kEntrySize);
            if (offset > bytes.size() || size > bytes.size() - offset) continue;
            set(entry(i) + kEntryChecksum, block_checksum(std::span(bytes).subspan(offset, size)));
        }
        set<std::uint64_t>(kChecksum, 0);
        set(kChecksum, xxh64(std::span(bytes).first(kTable + section_count() * kEntry)));
    }
};

}  // namespace rhview
