// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

namespace rhview::gl {

/// Whether the current context has glClipControl. Asks the driver: not for every frame.
bool has_clip_control();

/// Remembers the state that drawing touches and puts it back: program, vertex array, generic attribute
/// values, culling, front face, depth test, depth function, depth mask, clip control and array buffer.
class StateGuard {
  public:
    explicit StateGuard(bool clip_control);
    ~StateGuard();
    StateGuard(const StateGuard&) = delete;
    StateGuard& operator=(const StateGuard&) = delete;

  private:
    int program_ = 0;
    int vertex_array_ = 0;
    int array_buffer_ = 0;
    int cull_face_mode_ = 0;
    int front_face_ = 0;
    int depth_function_ = 0;
    int clip_origin_ = 0;
    int clip_depth_ = 0;
    std::uint8_t depth_mask_ = 0;
    bool cull_face_ = false;
    bool depth_test_ = false;
    bool clip_control_ = false;
    float attributes_[2][4] = {};  ///< normal and colour
};

/// Puts back what asking queries and conditional draws change besides: colour masks, stencil test, depth
/// clamp, storage buffers 0 to 2, and the buffers for indirect draws and copies.
class QueryStateGuard {
  public:
    QueryStateGuard();
    ~QueryStateGuard();
    QueryStateGuard(const QueryStateGuard&) = delete;
    QueryStateGuard& operator=(const QueryStateGuard&) = delete;
    /// Colour masks, stencil test and depth clamp already, for draws that follow.
    void put_back_raster_state() const;

  private:
    static constexpr unsigned kColourBuffers = 8;
    static constexpr unsigned kStorageBuffers = 3;
    struct Storage {
        int name = 0;
        std::int64_t start = 0, size = 0;
    };

    std::uint8_t colour_mask_[kColourBuffers][4] = {};
    bool stencil_test_ = false;
    bool depth_clamp_ = false;
    int storage_buffer_ = 0;
    int indirect_buffer_ = 0;
    int copy_read_buffer_ = 0;
    int copy_write_buffer_ = 0;
    Storage storage_[kStorageBuffers];
};

/// Puts back what making, binding and reading a target changes: framebuffers, renderbuffer, viewport, pack
/// alignment, depth mask.
class TargetGuard {
  public:
    TargetGuard();
    ~TargetGuard();
    TargetGuard(const TargetGuard&) = delete;
    TargetGuard& operator=(const TargetGuard&) = delete;

  private:
    int draw_ = 0;
    int read_ = 0;
    int renderbuffer_ = 0;
    int pack_alignment_ = 4;
    int viewport_[4] = {};
    std::uint8_t depth_mask_ = 0;
};

}  // namespace rhview::gl
