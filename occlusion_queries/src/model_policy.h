// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "candidate_option.h"
#include "exploration.h"
#include "multiqueries.h"
#include "query_writer.h"

namespace rhview {

/// The frame's decisions by the timing model: `OcclusionPolicy::Model`.
class ModelPolicy {
  public:
    explicit ModelPolicy(const OcclusionSettings& settings);

    void reserve(std::size_t candidates);
    void learn_explored(bool hidden) { exploration_.learn(hidden); }
    void begin_frame(double frame_ns, double screen_pixels);
    void decide(std::span<const OcclusionCandidate> candidates, const QueryCosts& costs,
                ItemHistories& histories, QueryWriter& writer, OcclusionDecisions& out);

  private:
    struct Ways {
        bool hardware = false, box_pass = false;
    };
    struct Choice {
        QueryWay way = QueryWay::HardwareQuery;
        bool pays = false;
    };
    /// An item not known yet that may be drawn for others to hide behind.
    struct Occluder {
        float distance = 0.0f;
        std::uint32_t item = 0;
        std::uint32_t candidate = 0;
    };

    void appraise(std::span<const OcclusionCandidate> candidates, const OptionPricer& pricer,
                  ItemHistories& histories);
    /// True if there are some whose answers are not known yet.
    bool put_occluders_in_front(std::span<const OcclusionCandidate> candidates, const OptionPricer& pricer,
                                const ItemHistories& histories);
    double collect_occluders(std::span<const OcclusionCandidate> candidates, const ItemHistories& histories);
    [[nodiscard]] Ways choose_ways(const QueryCosts& costs) const;
    static Choice choose(const CandidateOption& option, Ways ways);
    void ask_each(const OptionPricer& pricer, Ways ways, QueryWriter& writer, OcclusionDecisions& out);
    void ask_groups(const OptionPricer& pricer, QueryWriter& writer, OcclusionDecisions& out);

    const OcclusionSettings settings_;
    Exploration exploration_;
    Multiqueries first_, renewed_;
    std::vector<CandidateOption> options_;
    std::vector<Occluder> occluders_;
    bool explorable_ = false;
    double screen_pixels_ = 0.0;
    double covered_pixels_ = 0.0;  ///< by what is believed visible, and occluders
};

}  // namespace rhview
