// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Values one after the other in bytes, without gaps: numbers in the machine's order (which baked files
/// demand to be little-endian), texts behind their length.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace rhview {

/// Numbers and ids.
template <class T>
concept StreamedNumber = (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || std::is_enum_v<T>;

class ByteWriter {
  public:
    template <StreamedNumber T>
    void put(T value) {
        const auto bytes = std::as_bytes(std::span(&value, 1));
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    void put(bool value) { put<std::uint8_t>(value ? 1 : 0); }
    void put(const std::string& text);

    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    std::vector<std::byte> bytes_;
};

/// Reads what a `ByteWriter` wrote. After a read past the end everything is zero and `ok` is false: callers
/// check it before they use what they read.
class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <StreamedNumber T>
    void get(T& value) {
        value = {};
        const std::span<const std::byte> bytes = take(sizeof(T));
        if (!bytes.empty()) std::memcpy(&value, bytes.data(), sizeof(T));
    }
    /// Anything but 0 and 1 is a mistake.
    void get(bool& value);
    void get(std::string& text);
    /// The number of records that follow, each of `least_bytes` or more; 0 and a mistake if so many don't fit
    /// what is left.
    std::size_t get_count(std::size_t least_bytes);

    [[nodiscard]] bool ok() const { return ok_; }
    /// Whether nothing is left.
    [[nodiscard]] bool at_end() const { return position_ == bytes_.size(); }
    [[nodiscard]] std::size_t position() const { return position_; }

  private:
    /// The next `count` bytes; none, and a mistake, where they are not there.
    std::span<const std::byte> take(std::size_t count);

    std::span<const std::byte> bytes_;
    std::size_t position_ = 0;
    bool ok_ = true;
};

}  // namespace rhview
