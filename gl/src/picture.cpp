// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/picture.h"

#include <algorithm>
#include <bit>
#include <span>
#include <string>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

#include "rhview/base/assert.h"
#include "rhview/base/replacement_file.h"
#include "stb.h"

namespace rhview::gl {
namespace {

constexpr int kMargin = 6;
constexpr int kBand = 2 * kMargin + 12;

/// stb_easy_font's quads: four vertices of x, y, z and a colour.
struct FontVertex {
    float x, y, z;
    std::uint8_t colour[4];
};

void fill(Picture& picture, int x0, int y0, int x1, int y1, std::uint8_t value) {
    for (int y = std::max(y0, 0); y < std::min(y1, picture.height()); ++y)
        for (int x = std::max(x0, 0); x < std::min(x1, picture.width()); ++x)
            std::fill_n(picture.row(y) + 3 * x, 3, value);
}

}  // namespace

Picture::Picture(int width, int height)
    : width_(width),
      height_(height),
      bytes_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3) {}

void Picture::paste(const Picture& part, int x, int y) {
    const int columns = std::min(part.width(), width_ - x);
    for (int row_index = 0; row_index < std::min(part.height(), height_ - y) && columns > 0; ++row_index)
        std::copy_n(part.row(row_index), static_cast<std::size_t>(columns) * 3, row(y + row_index) + 3 * x);
}

void Picture::label(std::string_view text) {
    std::string copy(text);
    std::vector<FontVertex> vertices(copy.size() * 80 + 4);
    const int quads = stb_easy_font_print(0, 0, copy.data(), nullptr, vertices.data(),
                                          static_cast<int>(vertices.size() * sizeof(FontVertex)));
    // Large pictures are looked at scaled down: letters grow with them.
    const int scale = std::max(1, height_ / 300);
    fill(*this, 0, 0, scale * (2 * kMargin + stb_easy_font_width(copy.data())), scale * kBand, 24);
    for (int quad = 0; quad < quads; ++quad) {
        const FontVertex& low = vertices[static_cast<std::size_t>(4 * quad)];
        const FontVertex& high = vertices[static_cast<std::size_t>(4 * quad + 2)];
        const auto place = [&](float v) { return scale * (kMargin + static_cast<int>(v)); };
        fill(*this, place(low.x), place(low.y) + 2 * scale, place(high.x), place(high.y) + 2 * scale, 255);
    }
}

Status Picture::save_png(const std::filesystem::path& file) const {
    const std::vector<std::uint8_t> png = encode_png(bytes_.data(), width_, height_);
    if (png.empty())
        return Error{file.string() + ": can't be written: there is no memory for its compression"};
    Result<ReplacementFile> replacement = ReplacementFile::create(file);
    if (!replacement) return replacement.error();
    replacement->write(std::as_bytes(std::span(png)));
    return replacement->commit();
}

Picture difference_picture(const Picture& reference, std::span<const float> culled_depths,
                           std::span<const float> reference_depths) {
    const int width = reference.width(), height = reference.height();
    RHVIEW_ASSERT(culled_depths.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    Picture picture(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::uint8_t* from = reference.row(y) + 3 * x;
            const int grey = (from[0] * 2 + from[1] * 5 + from[2]) / 8;
            std::fill_n(picture.row(y) + 3 * x, 3, static_cast<std::uint8_t>(grey / 3));
        }
    }
    constexpr int kGrow = 2;
    const auto depth_index = [&](int x, int y) {
        return static_cast<std::size_t>(height - 1 - y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t i = depth_index(x, y);
            if (std::bit_cast<std::uint32_t>(culled_depths[i]) ==
                std::bit_cast<std::uint32_t>(reference_depths[i]))
                continue;
            for (int v = std::max(0, y - kGrow); v <= std::min(height - 1, y + kGrow); ++v) {
                for (int u = std::max(0, x - kGrow); u <= std::min(width - 1, x + kGrow); ++u) {
                    const std::uint8_t red[3] = {255, 40, 40};
                    std::copy_n(red, 3, picture.row(v) + 3 * u);
                }
            }
        }
    }
    return picture;
}

Picture sheet(const Picture& top_left, const Picture& top_right, const Picture& bottom_left,
              const Picture& bottom_right) {
    const int width = top_left.width(), height = top_left.height();
    Picture all(2 * width, 2 * height);
    all.paste(top_left, 0, 0);
    all.paste(top_right, width, 0);
    all.paste(bottom_left, 0, height);
    all.paste(bottom_right, width, height);
    return all;
}

}  // namespace rhview::gl
