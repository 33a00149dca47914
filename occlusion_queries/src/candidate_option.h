// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "item_history.h"
#include "query_prices.h"
#include "rhview/occlusion_queries/occlusion_scheduler.h"

namespace rhview {

enum class Ask : std::uint8_t {
    Nothing,
    First,  ///< what draws it hangs on the answer
    Test,   ///< it is drawn; the answer is for later
    Renew,  ///< latent mode: it is left out; the answer is for later
};

/// What could be asked about a candidate, what that is worth, and its price either way: times in ns.
struct CandidateOption {
    float render_ns = 0.0f;
    float value_ns = 0.0f;
    float hardware_ns = 0.0f;
    float box_pass_ns = 0.0f;
    Ask ask = Ask::Nothing;
    std::uint8_t rank = 0;    ///< of p(hidden) among those of this frame: 0 is the greatest
    bool alone = false;       ///< never in a multiquery
    bool explorable = false;  ///< nobody knows for long whether it is hidden, and that could pay
};

/// Prices the options of one frame.
class OptionPricer {
  public:
    static constexpr std::uint32_t kRanks = KeepProbability::kLast + 2;

    OptionPricer(const OcclusionSettings& settings, const QueryCosts& costs, const ItemHistories& histories);

    [[nodiscard]] CandidateOption option(const OcclusionCandidate& candidate, const ItemHistory& item) const;
    /// What is left of a `First` that is drawn at once instead, to be known by the next frame.
    [[nodiscard]] CandidateOption occluder(const OcclusionCandidate& candidate,
                                           const ItemHistory& item) const;

  private:
    struct Prices {
        double hardware = 0.0, box_pass = 0.0;
        [[nodiscard]] double least() const { return hardware < box_pass ? hardware : box_pass; }
    };
    [[nodiscard]] CandidateOption doubtful(const OcclusionCandidate& candidate, const ItemHistory& item,
                                           CandidateOption option) const;
    [[nodiscard]] CandidateOption visible(const OcclusionCandidate& candidate, const ItemHistory& item,
                                          CandidateOption option) const;
    [[nodiscard]] Prices test_prices(const OcclusionCandidate& candidate) const;
    [[nodiscard]] Prices first_prices(const OcclusionCandidate& candidate, double p_seen, double render_ns,
                                      bool alone) const;
    [[nodiscard]] double gain_while_hidden(const OcclusionCandidate& candidate, double render_ns) const;
    void set_test(CandidateOption& option, const OcclusionCandidate& candidate, double value_ns) const;
    [[nodiscard]] bool is_fresh(const ItemHistory& item) const;
    [[nodiscard]] std::uint8_t rank(const ItemHistory& item) const;
    [[nodiscard]] double waited(const ItemHistory& item) const;

    const OcclusionSettings& settings_;
    const QueryCosts& costs_;
    const ItemHistories& histories_;
    double most_members_;
    std::uint8_t unknown_rank_ = 0;
};

}  // namespace rhview
