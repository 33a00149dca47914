// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "median_interval.h"
#include "walk_report.h"

namespace rhview::cli {

/// Several methods along one path: what `rhview.compare/1` says.
struct CompareReport {
    struct Run {
        std::string label;
        const WalkReport* walk = nullptr;
    };

    std::vector<Run> runs;
    std::size_t reference = 0;  ///< the run that ratios refer to
    bool by_frame = true;       ///< methods took turns frame by frame, else walk by walk
    bool pareto = false;        ///< the picture's errors were measured, and the fronts are told
    std::string command;        ///< that makes it again

    /// Frame times of a run over those of another, frame by frame. Pairs share a camera, so that the interval
    /// of their median holds the noise alone, not the path's ups and downs.
    [[nodiscard]] std::optional<MedianInterval> time_ratio(std::size_t run, std::size_t other) const;
    /// The run that is faster than each other one: the interval of the ratio lies below 1. None where an
    /// interval does not.
    [[nodiscard]] std::optional<std::size_t> winner() const;
    [[nodiscard]] std::uint64_t missing_pixels_in_exact_mode() const;
};

std::string to_json(const CompareReport& report);
/// A line per method and frame.
std::string to_csv(const CompareReport& report);
/// For people.
std::string to_table(const CompareReport& report);

}  // namespace rhview::cli
