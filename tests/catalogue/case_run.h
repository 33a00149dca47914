// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Draws a case of the catalogue by every method, and compares each frame with drawing everything.
///
/// Drivers do not draw all triangles alike whatever stands beside them: Mesa's draw module sends all of a
/// call's triangles through another path, with another rounding of their area, if one of them is clipped. So
/// everything is drawn twice, by a call per batch and by a call per triangle; where these differ nothing can
/// be said. A frame that differs elsewhere is drawn again with a call per triangle: what then is equal was
/// the driver's too. And some triangles are drawn by luck: those thinner than a sixteenth of a pixel, to
/// which a rasteriser gives any depth, and those thinner than one that are turned away, of which it may show
/// the back
/// (`kFacingSlack` says from when on it doesn't). A difference where one of these is seen, or would be, is
/// counted as doubtful.
#pragma once

#include <cstdint>
#include <string>

#include "hard_case.h"

namespace rhview {

/// Sums over a case.
struct Tally {
    std::uint64_t static_triangles = 0, objects = 0;
    std::uint64_t views = 0, frames = 0;
    std::uint64_t covered = 0;    ///< pixels of the views that show something
    std::uint64_t missing = 0;    ///< pixels that differ, though they were promised
    std::string first_missing;    ///< where
    std::uint64_t late = 0;       ///< pixels that differ in latent mode, before the camera stood long enough
    std::uint64_t undecided = 0;  ///< pixels that the driver itself draws in two ways
    std::uint64_t doubtful = 0;   ///< pixels that differ where a triangle is drawn by luck
    std::uint64_t hidden = 0;     ///< answers that nothing was seen
    std::uint64_t indices = 0, all_indices = 0;  ///< of `rhview`, exact, in its last frames; of everything
    /// How far a vertex in view is drawn from where it is, by `long double`, in pixels of a picture 1920
    /// wide.
    double worst_error_px = 0.0;
};

/// `views`: for each convention of depth, each format and each method. Needs a current context.
Tally run_case(const HardCase& hard_case, int views, Amount amount);

}  // namespace rhview
