// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Measures what asking costs on the machine at hand, by either way.
#pragma once

#include <cstdint>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/gl/render_target.h"
#include "rhview/occlusion_queries/query.h"

namespace rhview::gl {

/// How long to measure.
struct AnswerCostOptions {
    double longest_s = 1.0;  ///< of timing; the first two rounds are always whole
    int rounds = 25;         ///< at most, each in another order
    std::uint32_t seed = 1;
};

/// One frame of the experiment: so many queries of so many boxes, three quarters of them hidden, of so many
/// pixels, on which so many draws hang that are not executed.
struct AskedFrame {
    QueryWay way = QueryWay::HardwareQuery;
    double queries = 0.0, boxes = 0.0, pixels = 0.0, draws = 0.0;
    double ns = 0.0;  ///< median, less that of a frame that asks nothing
};

/// The fit, and the frames that it is of.
struct MeasuredAnswerCosts {
    QueryCosts costs;
    std::vector<AskedFrame> frames;
};

/// What a way costs that the device lacks: more than any frame.
inline constexpr double kImpossibleNs = 1e12;

/// Times frames that only ask, into `target`, on the wall clock, from an idle device until it is idle again,
/// and fits the costs of each way, none negative, by least squares of relative errors. Where the device has
/// no box pass, its `frame_ns` is `kImpossibleNs`. OpenGL's state is put back. Errors: the driver's.
Result<MeasuredAnswerCosts> measure_answer_costs(RenderTarget& target, const AnswerCostOptions& options = {});

/// The costs that explain `frames`, all of one way, best.
AnswerCosts fit_answer_costs(const std::vector<AskedFrame>& frames);

}  // namespace rhview::gl
