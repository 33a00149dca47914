// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "source_arrays.h"

#include <cstring>

namespace rhview::capi {

std::span<const glm::vec3> SourceArrays::positions(const float* given, std::size_t stride,
                                                   std::size_t count) {
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    if (stride == sizeof(glm::vec3)) return {reinterpret_cast<const glm::vec3*>(given), count};
    std::vector<glm::vec3>& copy = positions_.emplace_back(count);
    const auto* bytes = reinterpret_cast<const unsigned char*>(given);
    for (std::size_t i = 0; i < count; ++i) std::memcpy(&copy[i], bytes + i * stride, sizeof(glm::vec3));
    return copy;
}

std::span<const std::uint32_t> SourceArrays::indices(const void* given, std::uint32_t bytes,
                                                     std::size_t count) {
    if (bytes == 4) return {static_cast<const std::uint32_t*>(given), count};
    const auto* narrow = static_cast<const std::uint16_t*>(given);
    return indices_.emplace_back(narrow, narrow + count);
}

}  // namespace rhview::capi
