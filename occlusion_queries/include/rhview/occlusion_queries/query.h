// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A question to the device, is anything of these boxes seen, and its answer, without a graphics API.
#pragma once

#include <cstdint>

#include "rhview/timing_model/query_costs.h"

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

}  // namespace rhview
