// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Which things show at least one pixel: the exact visible set, found by drawing all of them in their
/// numbers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/base/view.h"
#include "rhview/gl/handle.h"
#include "rhview/gl/scene_buffers.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview::gl {

/// A part of a thing.
struct ItemRange {
    DrawRange range;
    std::uint32_t item = 0;
};

/// A target of the given size that holds the number of what is seen in each pixel. For measurements: it draws
/// each range with a call of its own and waits for the picture.
class ItemBuffer {
  public:
    /// Of that size; an error names what the driver refused.
    static Result<ItemBuffer> create(int width, int height);

    /// No item has this number: a pixel that shows nothing.
    static constexpr std::uint32_t kNoItem = 0xffffffffu;

    /// Draws `ranges` (by batch, best) and all objects of `scene`, where `placements` (by `ObjectId`) says,
    /// or if that is empty the scene, at `levels` of detail (by `ObjectId`), or if that is empty all of it;
    /// the items that are seen, ascending. Of surfaces at the same depth the first drawn is seen. State is
    /// put back.
    std::vector<std::uint32_t> visible_items(std::span<const ItemRange> ranges, const SceneBuffers& scene,
                                             const View& view, std::span<const glm::dmat4> placements = {},
                                             std::span<const std::uint8_t> levels = {});

    /// The same, as what each pixel shows, row after row from the lowest. Objects are the items from
    /// `first_object` on, or none where that is `kNoItem`. Valid until the next call.
    std::span<const std::uint32_t> item_pixels(std::span<const ItemRange> ranges, std::uint32_t first_object,
                                               const SceneBuffers& scene, const View& view,
                                               std::span<const glm::dmat4> placements = {},
                                               std::span<const std::uint8_t> levels = {});

  private:
    struct Uniforms {
        int clip_from_relative = -1;
        int eye_high = -1;
        int eye_low = -1;
        int item = -1;
    };

    void begin(const View& view) const;
    void set_transform(const View& view, const glm::dvec3& origin, const glm::dmat4& scene_from_mesh) const;
    void draw(const DrawState& state, std::uint32_t first_index, std::uint32_t index_count,
              std::uint32_t item) const;

    Program program_;
    Uniforms uniforms_;
    Framebuffer framebuffer_;
    Renderbuffer items_;
    Renderbuffer depth_;
    int width_ = 0;
    int height_ = 0;
    std::vector<std::uint32_t> pixels_;
};

}  // namespace rhview::gl
