// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What drawing and asking cost, between C and C++.
#pragma once

#include <optional>

#include "rhview/pipeline/node_visibility.h"
#include "rhview/rhoctree/draw_costs.h"
#include "rhview/rhview.h"

namespace rhview::capi {

/// What a caller's `rhview_costs` says; null: a desktop GPU's, without queries.
struct KnownCosts {
    DrawCosts draw{};
    double shown_index_ns = 0.0;
    std::optional<QueryCosts> queries{};  ///< a way that the renderer lacks has an infinite price
};

rhview_status take_costs(const rhview_costs* given, KnownCosts& costs) noexcept;

}  // namespace rhview::capi
