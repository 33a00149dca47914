// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Checksums that tell damaged bytes from whole ones. They are no protection against someone who means harm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace rhview {

/// XXH64 of `bytes`, the same on every machine. Source: Collet, "XXH64 algorithm description" (xxHash, 2012).
std::uint64_t xxh64(std::span<const std::byte> bytes, std::uint64_t seed = 0);

/// Bytes that `block_checksum` hashes on their own.
inline constexpr std::size_t kChecksumBlockBytes = std::size_t{1} << 20;

/// XXH64 of the little-endian XXH64 of each 1 MiB block (the last may be shorter): equal for equal bytes,
/// whatever the number of threads. Cost: one pass over the bytes, on all of oneTBB's threads.
std::uint64_t block_checksum(std::span<const std::byte> bytes);

/// `block_checksum` of bytes whose blocks have these hashes, in order.
std::uint64_t combine_block_hashes(std::span<const std::uint64_t> hashes);

}  // namespace rhview
