// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Runs a property case: what rhview promises of every plan, checked against `RayPicture`.
///
/// Of each frame: every range lies in the index buffer; what hangs on a query lies in one of its boxes; each
/// pixel shows the nearest of all triangles (in latent mode only until a first answer says hidden), with
/// queries answered by what the frame's own draws leave to be seen; a triangle clearly in view that faces the
/// eye is drawn or asked about; octrees built on one thread and on two give equal plans. Without queries: the
/// plan costs what it says, and no more than everything and what must be shown with random gaps bridged;
/// where records are not joined (`OctreeOptions::min_record_indices`), no more than the leaves, the paper's
/// list and random sets of nodes either.
#pragma once

#include <cstdint>
#include <string>

#include "property_case.h"

namespace rhview {

struct PropertyOutcome {
    std::string failure;     ///< empty: all held
    std::uint64_t hash = 0;  ///< of the plans
    std::uint64_t frames = 0, pixels = 0, conditional_ranges = 0, hidden_answers = 0, lists = 0;
};

PropertyOutcome run_property(const PropertyCase& property);

/// The simplest case found that fails as well, by giving up one thing after another.
PropertyCase shrink(PropertyCase failing, int most_runs = 400);

}  // namespace rhview
