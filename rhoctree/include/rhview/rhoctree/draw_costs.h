// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What drawing costs, as far as the octree and its draw lists need to know.
#pragma once

namespace rhview {

/// T = `index_ns`·V + `draw_ns`·N + `call_ns`·(batches drawn), V indices in N ranges. Finite, none negative.
///
/// Plain draws: `draw_ns` is a call, `call_ns` 0. Multi-draw: `draw_ns` is a sub-draw, `call_ns` the call
/// that a batch pays once. The defaults are a desktop GPU's order of magnitude: a draw for the price of 8,000
/// indices.
struct DrawCosts {
    double index_ns = 0.25;
    double draw_ns = 2000.0;
    double call_ns = 0.0;

    friend bool operator==(const DrawCosts&, const DrawCosts&) = default;
};

}  // namespace rhview
