// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A caller's vertices and indices as the library takes them: as they are, or copied.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rhview::capi {

/// Batches and meshes in C have these fields in common; zeros stand for the usual.
template <class Given>
void complete_arrays(Given& given) {
    if (given.index_bytes == 0) given.index_bytes = 4;
    if (given.position_stride == 0) given.position_stride = sizeof(glm::vec3);
}

/// What is wrong with them, apart from what the numbers say; null: nothing.
template <class Given>
const char* wrong_arrays(const Given& given) {
    if (given.index_bytes != 2 && given.index_bytes != 4) return "index_bytes is 2 or 4";
    if (given.position_stride < sizeof(glm::vec3)) return "position_stride is less than 12 bytes";
    if (given.positions == nullptr && given.vertex_count > 0) return "positions is null";
    if (given.indices == nullptr && given.index_count > 0) return "indices is null";
    return nullptr;
}

/// Keeps the copies. The spans are valid as long as it and the caller's arrays.
class SourceArrays {
  public:
    template <class Given>
    std::span<const glm::vec3> positions(const Given& given) {
        return positions(given.positions, given.position_stride, given.vertex_count);
    }
    template <class Given>
    std::span<const std::uint32_t> indices(const Given& given) {
        return indices(given.indices, given.index_bytes, given.index_count);
    }

  private:
    std::span<const glm::vec3> positions(const float* given, std::size_t stride, std::size_t count);
    std::span<const std::uint32_t> indices(const void* given, std::uint32_t bytes, std::size_t count);

    std::deque<std::vector<glm::vec3>> positions_;
    std::deque<std::vector<std::uint32_t>> indices_;
};

}  // namespace rhview::capi
