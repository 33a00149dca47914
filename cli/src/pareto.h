// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rhview::cli {

/// What `compare --pareto` walks, as a list for `parse_methods`: `rhview` in exact mode, in latent mode, and
/// in latent mode with each visibility threshold (4, 16, 64 pixels); with `levels` of detail, each of them
/// with each bound of their error (0, 0.5, 1, 2, 4, 8 pixels).
std::string pareto_methods(bool levels);

/// The choices to which no other one is better in cost or error and as good in the other, by ascending error,
/// then cost, then number. Of choices equal in both, all. NaN is worse than anything. Spans of one length.
std::vector<std::size_t> pareto_front(std::span<const double> costs, std::span<const double> errors);

}  // namespace rhview::cli
