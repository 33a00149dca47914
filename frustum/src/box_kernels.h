// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The vector loops, one set per instruction set.

#pragma once

#include <cstddef>
#include <cstdint>

#include "rhview/frustum/box_batch.h"

namespace rhview {

/// The planes of a mask. Octant bits: whether the normal's x, y, z is not negative.
struct KernelPlanes {
    struct Plane {
        float x, y, z, distance;
        std::uint32_t octant;
    };
    Plane planes[6];
    std::uint32_t count = 0;
    float eye[3];
};

KernelPlanes kernel_planes(const Frustum& frustum, PlaneMask mask);

void cull_arrays(const KernelPlanes* views, std::size_t view_count, const BoxSpans& boxes,
                 std::uint64_t* visible);
void cull_aabbs(const KernelPlanes& planes, const Aabb* boxes, std::size_t count, std::uint64_t* visible);
/// 64 boxes at most.
std::uint64_t cull_word(const KernelPlanes& planes, const BoxSpans& boxes);

}  // namespace rhview
