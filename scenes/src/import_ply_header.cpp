// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// The format: Greg Turk, "The PLY Polygon File Format", Stanford, 1994.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "import_ply_internal.h"

namespace rhview::ply {
namespace {

std::optional<ScalarType> scalar_type(std::string_view word) {
    struct Named {
        std::string_view name;
        ScalarType type;
    };
    static constexpr std::array<Named, 16> kTypes{{{"char", {'i', 1}},
                                                   {"int8", {'i', 1}},
                                                   {"uchar", {'u', 1}},
                                                   {"uint8", {'u', 1}},
                                                   {"short", {'i', 2}},
                                                   {"int16", {'i', 2}},
                                                   {"ushort", {'u', 2}},
                                                   {"uint16", {'u', 2}},
                                                   {"int", {'i', 4}},
                                                   {"int32", {'i', 4}},
                                                   {"uint", {'u', 4}},
                                                   {"uint32", {'u', 4}},
                                                   {"float", {'f', 4}},
                                                   {"float32", {'f', 4}},
                                                   {"double", {'f', 8}},
                                                   {"float64", {'f', 8}}}};
    for (const Named& named : kTypes)
        if (named.name == word) return named.type;
    return std::nullopt;
}

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> words;
    while (!line.empty()) {
        const std::size_t begin = line.find_first_not_of(" \t\r");
        if (begin == std::string_view::npos) break;
        const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        line.remove_prefix(end);
    }
    return words;
}

/// One line of the header. False where it says nothing that this reader knows.
bool parse_line(const std::vector<std::string_view>& words, Header& header, bool& has_format) {
    if (words[0] == "comment" || words[0] == "obj_info") return true;
    if (words[0] == "format" && words.size() >= 2) {
        has_format = true;
        if (words[1] == "ascii")
            header.format = Format::Ascii;
        else if (words[1] == "binary_little_endian")
            header.format = Format::LittleEndian;
        else if (words[1] == "binary_big_endian")
            header.format = Format::BigEndian;
        else
            return false;
        return true;
    }
    if (words[0] == "element" && words.size() == 3) {
        Element& element = header.elements.emplace_back();
        element.name = words[1];
        const auto [end, code] =
            std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
        return code == std::errc() && end == words[2].data() + words[2].size();
    }
    if (words[0] != "property" || header.elements.empty()) return false;
    Property property;
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3) return false;
    const auto type = scalar_type(words[list ? 3 : 1]);
    if (!type) return false;
    property.name = words.back();
    property.type = *type;
    if (list) {
        property.list_count = scalar_type(words[2]);
        if (!property.list_count || property.list_count->kind == 'f') return false;
    }
    header.elements.back().properties.push_back(std::move(property));
    return true;
}

/// The fewest bytes that one element takes: an empty list is its count; a word is a digit and what parts it
/// from the next.
std::uint64_t fewest_bytes(Format format, const Element& element) {
    std::uint64_t bytes = 0;
    for (const Property& property : element.properties)
        bytes += format == Format::Ascii ? 2 : property.list_count.value_or(property.type).bytes;
    return bytes;
}

Status check_counts(const std::string& name, const Header& header, std::size_t bytes_left) {
    std::uint64_t room = bytes_left + 1;  // the last word may end with the file
    for (const Element& element : header.elements) {
        const std::uint64_t bytes = fewest_bytes(header.format, element);
        if (bytes == 0) continue;
        if (element.count > room / bytes) {
            return Error{
                fmt::format("{}: the header says {} elements '{}', the file has room for {} at most; it is "
                            "truncated or corrupt, export it again",
                            name, element.count, element.name, room / bytes)};
        }
        room -= element.count * bytes;
    }
    return success();
}

template <class T>
double load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

double load(ScalarType type, const unsigned char* bytes) {
    switch (type.kind) {
        case 'i':
            return type.bytes == 1   ? load<std::int8_t>(bytes)
                   : type.bytes == 2 ? load<std::int16_t>(bytes)
                                     : load<std::int32_t>(bytes);
        case 'u':
            return type.bytes == 1   ? load<std::uint8_t>(bytes)
                   : type.bytes == 2 ? load<std::uint16_t>(bytes)
                                     : load<std::uint32_t>(bytes);
        default:
            return type.bytes == 4 ? load<float>(bytes) : load<double>(bytes);
    }
}

}  // namespace

Result<Header> parse_header(const std::string& name, std::string_view bytes) {
    Header header;
    bool has_format = false;
    std::size_t at = 0;
    for (int line_number = 1; at < bytes.size(); ++line_number) {
        const std::size_t end = bytes.find('\n', at);
        if (end == std::string_view::npos) break;
        const std::vector<std::string_view> words = split(bytes.substr(at, end - at));
        at = end + 1;
        if (line_number == 1 && (words.size() != 1 || words[0] != "ply"))
            return Error{name + ": the file does not begin with 'ply'; export it again as Stanford PLY"};
        if (line_number == 1 || words.empty()) continue;
        if (words[0] == "end_header") {
            if (!has_format) return Error{name + ": the header names no format; export it again"};
            header.bytes = at;
            if (Status s = check_counts(name, header, bytes.size() - at); !s) return s.error();
            return header;
        }
        if (!parse_line(words, header, has_format)) {
            return Error{fmt::format("{}: header line {} ('{}') is not PLY; export it again", name,
                                     line_number, fmt::join(words, " "))};
        }
    }
    return Error{name + ": the header does not end; the file is truncated, export it again"};
}

double ValueReader::next_word() {
    const auto is_space = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (at_ < bytes_.size() && is_space(bytes_[at_])) ++at_;
    if (at_ < bytes_.size() && bytes_[at_] == '+') ++at_;
    const char* begin = bytes_.data() + at_;
    double value = 0.0;
    const auto [end, code] = std::from_chars(begin, bytes_.data() + bytes_.size(), value);
    at_ += static_cast<std::size_t>(end - begin);
    // Out of range: a coordinate that no number holds; the triangle is dropped later, as with infinities.
    if (code == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
    if (code != std::errc() || (at_ < bytes_.size() && !is_space(bytes_[at_]))) failed_ = true;
    return failed_ ? 0.0 : value;
}

double ValueReader::next(ScalarType type) {
    if (failed_) return 0.0;
    if (format_ == Format::Ascii) return next_word();
    if (left() < type.bytes) {
        failed_ = true;
        return 0.0;
    }
    std::array<unsigned char, 8> value{};
    std::memcpy(value.data(), bytes_.data() + at_, type.bytes);
    at_ += type.bytes;
    const bool native = (format_ == Format::LittleEndian) == (std::endian::native == std::endian::little);
    if (!native) std::reverse(value.begin(), value.begin() + type.bytes);
    return load(type, value.data());
}

}  // namespace rhview::ply
