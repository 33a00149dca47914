// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>

#include "rhview/base/result.h"
#include "rhview/gl/handle.h"
#include "rhview/pipeline/query_boxes.h"

namespace rhview::gl {

/// Draws widened boxes against the depth that is there, and writes nothing but words of a storage buffer.
class BoxDrawer {
  public:
    /// What a fragment that passes does.
    enum class Effect {
        None,      ///< an occlusion query counts it
        MarkSlot,  ///< writes 1 to the word of its box's slot, in storage buffer 0
    };

    /// `marks`: `Effect::MarkSlot` will be used; needs storage buffers.
    static Result<BoxDrawer> create(bool marks);

    /// Replaces the boxes to draw from.
    void upload(std::span<const BoxInstance> boxes);
    /// Adds boxes behind those that are there, and says where they begin. Not to be mixed with `upload`.
    std::uint32_t append(std::span<const BoxInstance> boxes);
    /// Sets program, vertex array and raster state, but for the depth test, its function and the clip
    /// control.
    void begin(const BoxWidener& widener, Effect effect) const;
    static void draw(std::uint32_t first, std::uint32_t count);

  private:
    struct Shader {
        Program program;
        int clip_from_relative = -1, depth_error = -1, nearer = -1;
    };
    static Result<Shader> link(const char* fragment_source);

    Shader shaders_[2];
    VertexArray vertex_array_;
    Buffer boxes_;
    std::size_t capacity_ = 0;  ///< bytes
    std::size_t filled_ = 0;    ///< of them, by `append`
};

}  // namespace rhview::gl
