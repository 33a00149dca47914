// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// An offscreen picture: 8-bit colour and 32-bit floating-point depth.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/base/view.h"
#include "rhview/gl/handle.h"
#include "rhview/gl/picture.h"

namespace rhview::gl {

/// A picture and its depths without a window.
class RenderTarget {
  public:
    /// Sizes from 1×1 to what the driver allows; an error names the limit.
    static Result<RenderTarget> create(int width, int height);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// Binds the target for drawing, sets the viewport to all of it, turns depth writes on, clears colour and
    /// depth (to the far end of `clip_depth`).
    void begin(ClipDepth clip_depth, const glm::vec3& background);

    /// Depths, row after row from the bottom; waits for the drawing.
    void read_depth(std::vector<float>& depths);
    /// The picture, top row first; waits for the drawing.
    [[nodiscard]] Picture read_colour();
    /// Copies the colours to the window's framebuffer, which stays bound, scaled to `width` × `height` pixels
    /// from (x, y), its lower left corner.
    void show(int x, int y, int width, int height);

  private:
    Framebuffer framebuffer_;
    Renderbuffer colour_;
    Renderbuffer depth_;
    int width_ = 0;
    int height_ = 0;
};

/// What the window's framebuffer holds before it is shown, top row first; waits for the drawing.
Picture read_window(int width, int height);

/// Pixels whose depth differs in any bit: the oracle of `--check`. The depth buffer is the extreme over all
/// fragments, so it doesn't depend on draw order, and any difference is an error of the culling. The spans
/// are of one length.
std::size_t count_missing_pixels(std::span<const float> culled, std::span<const float> reference);

}  // namespace rhview::gl
