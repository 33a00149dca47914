// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/checksum.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace rhview {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

TEST(Checksum, xxh64_gives_the_values_that_other_programs_give) {
    // `printf %s TEXT | xxhsum -H1` of xxHash 0.8.1.
    EXPECT_EQ(xxh64(bytes_of("")), 0xef46db3751d8e999ull);
    EXPECT_EQ(xxh64(bytes_of("a")), 0xd24ec4f1a98c6e5bull);
    EXPECT_EQ(xxh64(bytes_of("abc")), 0x44bc2cf5ad770999ull);
    EXPECT_EQ(xxh64(bytes_of("Few draw calls that show every visible pixel, and one more.")),
              0x595d0343c9caee4bull);
}

TEST(Checksum, of_blocks_is_that_of_their_hashes_and_sees_each_byte) {
    std::vector<std::byte> bytes(2 * kChecksumBlockBytes + 77);
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * 2654435761u >> 13);
    const std::span<const std::byte> all(bytes);
    const std::vector<std::uint64_t> hashes{xxh64(all.first(kChecksumBlockBytes)),
                                            xxh64(all.subspan(kChecksumBlockBytes, kChecksumBlockBytes)),
                                            xxh64(all.subspan(2 * kChecksumBlockBytes))};
    const std::uint64_t whole = block_checksum(all);
    EXPECT_EQ(whole, combine_block_hashes(hashes));
    for (const std::size_t place : {std::size_t{0}, kChecksumBlockBytes - 1, bytes.size() - 1}) {
        bytes[place] ^= std::byte{1};
        EXPECT_NE(block_checksum(all), whole) << place;
        bytes[place] ^= std::byte{1};
    }
    EXPECT_EQ(block_checksum(all), whole);
}

}  // namespace
}  // namespace rhview
