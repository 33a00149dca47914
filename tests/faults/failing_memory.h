// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// This program's `operator new`, which counts and fails when it is told to.
#pragma once

#include <cstdint>

namespace rhview {

/// How memory runs out.
enum class Shortage {
    Once,     ///< one allocation fails, those after it succeed: what a cleanup needs is there
    ForGood,  ///< all fail from then on
};

/// From now on the allocation number `index` (from 0) fails, of all threads together.
void fail_allocation(std::uint64_t index, Shortage shortage);
/// None fails any more. Whether one did since `fail_allocation`.
bool stop_failing();
/// Blocks that were allocated and not given back.
std::int64_t blocks_in_use();

}  // namespace rhview
