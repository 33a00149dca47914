// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Objects that are placed only if the device has not found them hidden by then.
#pragma once

#include <cstdint>
#include <span>

namespace rhview::gl {

/// Objects that hang on queries may wait until the device was asked: what it has found hidden by then needs
/// neither level nor placement, and is not submitted. The CPU looks, it does not wait: where no answer is
/// there yet, as on a device that works frames behind, all of them are drawn as without this.
struct LateObjects {
    /// Called at most once in a frame, with places in `FramePlan::conditional_objects`: those that are left.
    /// When it returns, their placements are what they must be. It may set their levels in the plan, and
    /// reorder them: of neighbours of one mesh, level, mirroring and query one call is made. Null: nothing
    /// waits.
    void (*prepare)(void* context, std::span<std::uint32_t> places) = nullptr;
    void* context = nullptr;
    /// The caller guarantees that no object that hangs has a greater `rounding_growth`: boxes are asked about
    /// before it is known.
    double largest_growth = 3.0;
};

}  // namespace rhview::gl
