// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace rhview::cli {

/// For how many frames in a row things that should be seen are not: the error of latent mode over time.
class RevealDelays {
  public:
    explicit RevealDelays(std::size_t item_count)
        : missing_for_(item_count, 0), missing_now_(item_count, 0) {}

    /// The next frame: by pixel, the item that should be seen there (`gl::ItemBuffer::kNoItem`: none), and
    /// the depths of the picture and of everything drawn. An item is late where it lacks a pixel. Returns
    /// how many items are late.
    std::uint64_t add_frame(std::span<const std::uint32_t> items, std::span<const float> culled,
                            std::span<const float> reference);

    /// Frames for which items were late, one entry each time that one was; those that are late in the last
    /// frame included.
    [[nodiscard]] std::vector<double> frames() const;

  private:
    std::vector<std::uint32_t> missing_for_;  ///< frames in a row
    std::vector<std::uint8_t> missing_now_;
    std::vector<double> ended_;
};

}  // namespace rhview::cli
