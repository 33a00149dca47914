// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The header of a PLY file, and a reader of the values behind it.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rhview/base/result.h"

namespace rhview::ply {

enum class Format { Ascii, LittleEndian, BigEndian };

struct ScalarType {
    char kind = 'f';  ///< 'i' signed, 'u' unsigned, 'f' floating
    std::uint8_t bytes = 4;
};

struct Property {
    std::string name;
    ScalarType type;
    std::optional<ScalarType> list_count;  ///< set for lists
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    Format format = Format::Ascii;
    std::vector<Element> elements;
    std::size_t bytes = 0;  ///< where the values begin
};

/// Errors begin with `name` and tell the line. A count that the rest of the file cannot hold is one of them.
Result<Header> parse_header(const std::string& name, std::string_view bytes);

/// Reads one value after the other. After the end, and on a word that is no number, `failed` is set and 0
/// returned.
class ValueReader {
  public:
    ValueReader(Format format, std::string_view bytes) : format_(format), bytes_(bytes) {}

    double next(ScalarType type);
    [[nodiscard]] bool failed() const { return failed_; }
    /// Bytes that are not read yet.
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

  private:
    double next_word();

    Format format_;
    std::string_view bytes_;
    std::size_t at_ = 0;
    bool failed_ = false;
};

}  // namespace rhview::ply
