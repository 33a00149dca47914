// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The arithmetic that all box tests share. It is never contracted to fused operations (see CMakeLists.txt):
// a fused one rounds once less, and then the answer would depend on the machine.

#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>

#include "rhview/frustum/frustum.h"

namespace rhview {

/// Of corners relative to the eye. NaN if a coordinate is, infinite if one is: as integers, NaN is above all.
inline float box_slack(const glm::vec3& low, const glm::vec3& high) {
    std::uint32_t reach = 0;
    for (const float value : {low.x, low.y, low.z, high.x, high.y, high.z})
        reach = std::max(reach, std::bit_cast<std::uint32_t>(value) & 0x7fffffffu);
    return kBoxSlack * std::bit_cast<float>(reach);
}

}  // namespace rhview
