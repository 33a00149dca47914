// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Whether index values stay inside their vertices.
#pragma once

#include <cstdint>
#include <span>

namespace rhview {

/// Whether every index is below `vertex_count`. Cost: one pass, on all of oneTBB's threads.
bool all_below(std::span<const std::uint32_t> indices, std::uint64_t vertex_count);

}  // namespace rhview
