// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What was submitted in one frame, and how long that took.
#pragma once

namespace rhview {

/// Counts of one frame, as the executor makes the calls; finite and not negative. What only the device can
/// count (primitives, fragments, samples) is measured or estimated by the caller; 0 where nobody counts it.
struct Work {
    double indices = 0.0;     ///< V, three per triangle
    double draw_calls = 0.0;  ///< N, a multi-draw is one
    double sub_draws = 0.0;   ///< index ranges; equals `draw_calls` for plain draws
    double queries = 0.0;
    double material_changes = 0.0;
    double fragments = 0.0;       ///< fragment shader invocations
    double primitives = 0.0;      ///< triangles left after clipping, back-facing ones among them
    double passed_samples = 0.0;  ///< samples that passed the depth test
};

/// A frame: what was submitted, and how long it took.
struct Sample {
    Work work;
    double measured_ns = 0.0;  ///< positive and finite
};

}  // namespace rhview
