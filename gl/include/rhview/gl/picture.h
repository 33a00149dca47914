// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Pictures in main memory, and the sheet of four that shows what a culled frame is worth.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "rhview/base/result.h"

namespace rhview::gl {

/// 8-bit RGB, top row first.
class Picture {
  public:
    /// Black. Sizes are positive.
    Picture(int width, int height);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] std::uint8_t* row(int y) { return bytes_.data() + row_offset(y); }
    [[nodiscard]] const std::uint8_t* row(int y) const { return bytes_.data() + row_offset(y); }

    /// Copies `part` to where its top left corner is (x, y); what lies outside is cut off.
    void paste(const Picture& part, int x, int y);
    /// Writes white text on a dark band at the top left.
    void label(std::string_view text);
    /// As a PNG, to a temporary name first: nothing half-written is left. Errors name the file.
    [[nodiscard]] Status save_png(const std::filesystem::path& file) const;

  private:
    [[nodiscard]] std::size_t row_offset(int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) * 3;
    }

    int width_;
    int height_;
    std::vector<std::uint8_t> bytes_;
};

/// `reference` in dim grey, with the pixels whose depths differ in red, grown so that a single one can be
/// seen. Depths are as `RenderTarget::read_depth` gives them: bottom row first.
Picture difference_picture(const Picture& reference, std::span<const float> culled_depths,
                           std::span<const float> reference_depths);

/// Four pictures of one size as a sheet: top left, top right, bottom left, bottom right.
Picture sheet(const Picture& top_left, const Picture& top_right, const Picture& bottom_left,
              const Picture& bottom_right);

}  // namespace rhview::gl
