// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What it costs to ask the device whether something is hidden.
#pragma once

namespace rhview {

/// What one way of asking costs, ns: a query with b boxes that cover p pixels in all, on which d draws hang,
/// costs `query_ns + b·box_ns + p·pixel_ns + d·draw_ns`, and each frame that uses it `frame_ns` once.
struct AnswerCosts {
    double frame_ns = 0.0;
    double query_ns = 0.0;
    double box_ns = 0.0;
    double pixel_ns = 0.0;
    double draw_ns = 0.0;

    friend bool operator==(const AnswerCosts&, const AnswerCosts&) = default;
};

/// Both ways on one machine.
struct QueryCosts {
    AnswerCosts hardware;
    AnswerCosts box_pass;

    friend bool operator==(const QueryCosts&, const QueryCosts&) = default;
};

}  // namespace rhview
