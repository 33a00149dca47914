// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "candidate_option.h"
#include "learned_rates.h"
#include "query_writer.h"

namespace rhview {

/// Queries that the gate alone would not ask, the longest untested first: what is learned from answers alone
/// never learns of what is never asked. Each frame adds its share to a credit, and no more than the credit is
/// spent.
class Exploration {
  public:
    explicit Exploration(const OcclusionSettings& settings);

    void reserve(std::size_t count) { oldest_.reserve(count); }
    void learn(bool hidden) { found_.add(hidden); }
    void begin_frame(double frame_ns);
    /// Tests some of the explorable options that are drawn untested. Returns what that costs.
    double spend(std::span<const OcclusionCandidate> candidates, std::span<const CandidateOption> options,
                 const ItemHistories& histories, const OcclusionDecisions& decisions, QueryWriter& writer);

  private:
    struct Untested {
        std::uint32_t tested = 0;  ///< frame
        std::uint32_t item = 0;
        std::uint32_t candidate = 0;
    };
    struct Price {
        QueryWay way = QueryWay::HardwareQuery;
        double query_ns = 0.0;
        double frame_ns = 0.0;  ///< of a way that nobody else uses in this frame
    };
    void collect(std::span<const OcclusionCandidate> candidates, std::span<const CandidateOption> options,
                 const ItemHistories& histories, const OcclusionDecisions& decisions);
    static Price price(const OcclusionCandidate& candidate, const QueryWriter& writer);

    double share_;
    double floor_;
    LearnedProbability found_;
    double income_ns_ = 0.0;
    double credit_ns_ = 0.0;
    double needed_ns_ = 0.0;  ///< what the first in the queue waits for
    std::vector<Untested> oldest_;
};

}  // namespace rhview
