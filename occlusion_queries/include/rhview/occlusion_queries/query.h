// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A question to the device, is anything of these boxes seen, and its answer, without a graphics API.
#pragma once

#include <cstdint>

namespace rhview {

/// Who decides on the device whether what hangs on a query is drawn. The CPU waits for neither.
enum class QueryWay : std::uint8_t {
    HardwareQuery,  ///< an occlusion query; draws by conditional rendering
    BoxPass,        ///< the boxes' fragments set a bit per query in a buffer; draws by indirect commands
};

/// An answer, some frames later; `ticket` is the one that the query was planned with.
struct QueryAnswer {
    std::uint64_t ticket = 0;
    bool visible = true;
    std::uint64_t samples = 0;  ///< that passed; only of queries that count them
};

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
