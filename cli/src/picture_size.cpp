// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "picture_size.h"

#include <charconv>

namespace rhview::cli {

Result<PictureSize> parse_size(const std::string& text) {
    PictureSize size;
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
        const auto height = std::from_chars(width.ptr + 1, end, size.height);
        if (height.ec == std::errc() && height.ptr == end && size.width > 0 && size.height > 0) return size;
    }
    return Error{"--size " + text +
                 ": not a picture size; write WIDTHxHEIGHT, both at least 1, as in 1280x720"};
}

}  // namespace rhview::cli
