// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Header and table of a `.rho` file, as they stand in it (docs/files.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rhview/base/rho_file.h"

namespace rhview {

/// A byte above 127, line ends of both kinds and an end-of-file mark: a transfer as text damages them first.
inline constexpr std::array<std::uint8_t, 8> kRhoMagic{0x8f, 'R', 'H', 'O', '\r', '\n', 0x1a, '\n'};
inline constexpr std::uint32_t kByteOrderMark =
    0x01020304;  ///< read as written on a machine of the same order
inline constexpr std::uint32_t kOtherByteOrder = 0x04030201;
inline constexpr std::size_t kSectionAlignment = 64;
inline constexpr std::uint32_t kMaxSections = 64;

struct RhoHeader {
    std::array<std::uint8_t, 8> magic = kRhoMagic;
    std::uint32_t version = RhoFile::kVersion;
    std::uint32_t byte_order = kByteOrderMark;
    std::uint64_t file_bytes = 0;
    std::uint32_t section_count = 0;
    std::uint32_t zero = 0;
    std::uint64_t checksum = 0;               ///< XXH64 of header and table, this field taken as 0
    std::array<std::uint8_t, 24> reserved{};  ///< zero
};
static_assert(sizeof(RhoHeader) == 64);

struct RhoTableEntry {
    SectionTag tag{};
    std::uint32_t version = 0;
    std::uint64_t offset = 0;    ///< from the file's beginning; a multiple of 64
    std::uint64_t size = 0;      ///< bytes
    std::uint64_t checksum = 0;  ///< `block_checksum` of them
};
static_assert(sizeof(RhoTableEntry) == 32);

constexpr std::uint64_t aligned(std::uint64_t offset) {
    return (offset + kSectionAlignment - 1) / kSectionAlignment * kSectionAlignment;
}

/// Of a header and the table after it, as in a file.
std::uint64_t header_checksum(const RhoHeader& header, std::span<const RhoTableEntry> table);

}  // namespace rhview
