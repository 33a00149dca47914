// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Refuses a scene that would not fit, before anything is allocated.
#pragma once

#include <cstdint>
#include <string>

#include "rhview/base/result.h"

namespace rhview {

/// Bytes of memory that are free for use now; 2^62 where the system does not tell.
std::uint64_t available_memory_bytes();

/// Bytes that a scene of this size takes from import to the first frame: pools, indices, the octree's build
/// and its ordered copy, and the driver's copies (on a software renderer they are in main memory too).
std::uint64_t estimated_scene_bytes(std::uint64_t triangles, std::uint64_t vertices,
                                    std::uint64_t bytes_per_vertex);

/// An error that names both figures when `needed_bytes` is more than is available. `what` begins the
/// sentence.
Status check_memory(const std::string& what, std::uint64_t needed_bytes);

}  // namespace rhview
