// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <span>

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
    /// How sure one can be of an item: by the number of its hidden answers; one more for the unknown.
    static constexpr std::uint32_t kRanks = KeepProbability::kLast + 2;

    OptionPricer(const OcclusionSettings& settings, const QueryCosts& costs, const ItemHistories& histories);

    void price(const OcclusionCandidate& candidate, const ItemHistory& item, CandidateOption& option) const;
    /// What is left of a `First` that is drawn at once instead, to be known by the next frame.
    void price_occluder(const OcclusionCandidate& candidate, CandidateOption& option) const;
    /// p(hidden) by rank.
    [[nodiscard]] std::span<const float> p_by_rank() const { return p_by_rank_; }

  private:
    struct Prices {
        float hardware = 0.0f, box_pass = 0.0f;
        [[nodiscard]] float least() const { return hardware < box_pass ? hardware : box_pass; }
    };
    /// AnswerCosts, in the precision that a decision needs.
    struct Costs {
        float query_ns, box_ns, pixel_ns, draw_ns;
        explicit Costs(const AnswerCosts& costs);
    };
    void set_doubtful(CandidateOption& option, const OcclusionCandidate& candidate,
                      const ItemHistory& item) const;
    void set_renewal(CandidateOption& option, const OcclusionCandidate& candidate, const ItemHistory& item,
                     float p) const;
    void set_visible(CandidateOption& option, const OcclusionCandidate& candidate,
                     const ItemHistory& item) const;
    void set_test(CandidateOption& option, const OcclusionCandidate& candidate, float value_ns) const;
    [[nodiscard]] Prices test_prices(const OcclusionCandidate& candidate, float hardware_query_ns) const;
    [[nodiscard]] Prices first_prices(const OcclusionCandidate& candidate, float hardware_query_ns) const;
    [[nodiscard]] float gain_while_hidden(const OcclusionCandidate& candidate, float render_ns) const;
    [[nodiscard]] float trusted_frames() const;
    [[nodiscard]] bool is_fresh(const ItemHistory& item) const;
    [[nodiscard]] float waited(const ItemHistory& item) const;
    void rank_beliefs();

    const OcclusionSettings& settings_;
    const ItemHistories& histories_;
    Costs hardware_, box_pass_;
    float most_members_;
    float latent_frames_;
    std::array<float, kRanks> p_by_rank_{};
    std::array<std::uint8_t, kRanks> rank_of_{};  ///< by hidden answers; the last is of the unknown
};

}  // namespace rhview
