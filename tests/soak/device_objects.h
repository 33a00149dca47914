// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

namespace rhview {

/// OpenGL's objects that exist in the current context, found by asking about every name below `names`.
struct DeviceObjects {
    std::uint32_t buffers = 0, vertex_arrays = 0, programs = 0, framebuffers = 0, renderbuffers = 0;
    std::uint32_t queries = 0, textures = 0;

    friend bool operator==(const DeviceObjects&, const DeviceObjects&) = default;
    [[nodiscard]] std::uint32_t without_queries() const {
        return buffers + vertex_arrays + programs + framebuffers + renderbuffers + textures;
    }
};
DeviceObjects count_device_objects(std::uint32_t names = 16384);

}  // namespace rhview
