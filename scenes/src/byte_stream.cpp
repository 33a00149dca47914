// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "byte_stream.h"

namespace rhview {

void ByteWriter::put(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size()));
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

std::span<const std::byte> ByteReader::take(std::size_t count) {
    if (!ok_ || count > bytes_.size() - position_) {
        ok_ = false;
        return {};
    }
    position_ += count;
    return bytes_.subspan(position_ - count, count);
}

void ByteReader::get(bool& value) {
    std::uint8_t byte = 0;
    get(byte);
    ok_ = ok_ && byte <= 1;
    value = byte == 1;
}

void ByteReader::get(std::string& text) {
    std::uint32_t size = 0;
    get(size);
    const std::span<const std::byte> bytes = take(size);
    text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

std::size_t ByteReader::get_count(std::size_t least_bytes) {
    std::uint64_t count = 0;
    get(count);
    if (count > (bytes_.size() - position_) / least_bytes) ok_ = false;
    return ok_ ? static_cast<std::size_t>(count) : 0;
}

}  // namespace rhview
