// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/checksum.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

namespace rhview {
namespace {

// The algorithm's five primes.
constexpr std::uint64_t kPrime1 = 0x9e3779b185ebca87ull;
constexpr std::uint64_t kPrime2 = 0xc2b2ae3d27d4eb4full;
constexpr std::uint64_t kPrime3 = 0x165667b19e3779f9ull;
constexpr std::uint64_t kPrime4 = 0x85ebca77c2b2ae63ull;
constexpr std::uint64_t kPrime5 = 0x27d4eb2f165667c5ull;

/// `Bytes` bytes, the lowest first. Written out so that any machine reads the same; compilers see one load.
template <std::size_t Bytes>
std::uint64_t read_little_endian(const std::byte* p) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < Bytes; ++i) value |= static_cast<std::uint64_t>(p[i]) << (8 * i);
    return value;
}

std::uint64_t mix_in(std::uint64_t lane, std::uint64_t word) {
    return std::rotl(lane + word * kPrime2, 31) * kPrime1;
}

/// Four lanes over whole stripes of 32 bytes, merged; `p` is left behind the last stripe.
std::uint64_t hash_stripes(const std::byte*& p, std::size_t stripes, std::uint64_t seed) {
    std::array<std::uint64_t, 4> lanes{seed + kPrime1 + kPrime2, seed + kPrime2, seed, seed - kPrime1};
    for (; stripes > 0; --stripes, p += 32)
        for (std::size_t i = 0; i < 4; ++i) lanes[i] = mix_in(lanes[i], read_little_endian<8>(p + 8 * i));
    std::uint64_t hash =
        std::rotl(lanes[0], 1) + std::rotl(lanes[1], 7) + std::rotl(lanes[2], 12) + std::rotl(lanes[3], 18);
    for (const std::uint64_t lane : lanes) hash = (hash ^ mix_in(0, lane)) * kPrime1 + kPrime4;
    return hash;
}

std::uint64_t avalanche(std::uint64_t hash) {
    hash = (hash ^ hash >> 33) * kPrime2;
    hash = (hash ^ hash >> 29) * kPrime3;
    return hash ^ hash >> 32;
}

}  // namespace

std::uint64_t xxh64(std::span<const std::byte> bytes, std::uint64_t seed) {
    const std::byte* p = bytes.data();
    const std::byte* const end = p + bytes.size();
    std::uint64_t hash = bytes.size() >= 32 ? hash_stripes(p, bytes.size() / 32, seed) : seed + kPrime5;
    hash += bytes.size();
    for (; end - p >= 8; p += 8)
        hash = std::rotl(hash ^ mix_in(0, read_little_endian<8>(p)), 27) * kPrime1 + kPrime4;
    if (end - p >= 4) {
        hash = std::rotl(hash ^ read_little_endian<4>(p) * kPrime1, 23) * kPrime2 + kPrime3;
        p += 4;
    }
    for (; p != end; ++p) hash = std::rotl(hash ^ static_cast<std::uint64_t>(*p) * kPrime5, 11) * kPrime1;
    return avalanche(hash);
}

std::uint64_t combine_block_hashes(std::span<const std::uint64_t> hashes) {
    std::vector<std::byte> bytes;
    bytes.reserve(8 * hashes.size());
    for (const std::uint64_t hash : hashes)
        for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<std::byte>(hash >> (8 * i)));
    return xxh64(bytes);
}

std::uint64_t block_checksum(std::span<const std::byte> bytes) {
    std::vector<std::uint64_t> hashes((bytes.size() + kChecksumBlockBytes - 1) / kChecksumBlockBytes);
    tbb::parallel_for(std::size_t{0}, hashes.size(), [&](std::size_t block) {
        const std::size_t first = block * kChecksumBlockBytes;
        hashes[block] = xxh64(bytes.subspan(first, std::min(kChecksumBlockBytes, bytes.size() - first)));
    });
    return combine_block_hashes(hashes);
}

}  // namespace rhview
