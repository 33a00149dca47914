// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The bodies of stb's single-header libraries.

#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb/stb_image_write.h>

#include "stb.h"

namespace rhview::gl {

std::vector<std::uint8_t> encode_png(const std::uint8_t* rgb, int width, int height) {
    std::vector<std::uint8_t> bytes;
    const auto append = [](void* target, void* data, int size) {
        auto* out = static_cast<std::vector<std::uint8_t>*>(target);
        const auto* begin = static_cast<const std::uint8_t*>(data);
        out->insert(out->end(), begin, begin + size);
    };
    if (stbi_write_png_to_func(append, &bytes, width, height, 3, rgb, width * 3) == 0) bytes.clear();
    return bytes;
}

}  // namespace rhview::gl
