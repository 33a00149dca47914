// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What the table and the JSON of a walk both read off its frames.
#pragma once

#include <cmath>
#include <vector>

#include "statistics.h"
#include "walk_report.h"

namespace rhview::cli {

template <class Field>
std::vector<double> column(const WalkReport& report, Field field) {
    std::vector<double> values;
    values.reserve(report.frames.size());
    for (const FrameRecord& frame : report.frames) values.push_back(static_cast<double>(field(frame)));
    return values;
}

/// Counts are whole numbers, also where the model takes them as real ones.
inline std::uint64_t count(double value) {
    return static_cast<std::uint64_t>(value);
}

/// |predicted - measured| / measured.
template <class Field>
Statistics prediction_errors(const WalkReport& report, Field predicted_ms) {
    return summarise(column(report, [&](const FrameRecord& f) {
        return std::abs(predicted_ms(f).value_or(0.0) - f.frame_ms) / f.frame_ms;
    }));
}

inline constexpr auto kPredicted = [](const FrameRecord& f) { return f.predicted_ms; };
inline double share(double part, double whole) {
    return whole > 0.0 ? part / whole : 0.0;
}

inline constexpr auto kHiddenFraction = [](const OcclusionRecord& o, const FrameRecord& f) {
    return share(static_cast<double>(o.hidden), f.work.queries);
};
}  // namespace rhview::cli
