// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What to draw at once, what to ask the device about, and what to draw only if it says so: the visibility
/// history of one view, and the decisions of its frames.
///
/// Items are numbers: the caller's octree nodes and objects. A frame goes
///
///     absorb(answers that came)  begin_frame  visit(item)…  decide(candidates)
///
/// In exact mode nothing is left out on the word of an earlier frame: an item that is not drawn at once hangs
/// on a query of this frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rhview/occlusion_queries/query.h"
#include "rhview/occlusion_queries/settings.h"

namespace rhview {

/// What earlier answers say of an item.
enum class Belief : std::uint8_t { Unknown, Visible, Hidden };

/// An item in the frustum, none of whose ancestors is a candidate, trials apart.
struct OcclusionCandidate {
    std::uint32_t item = 0;
    float render_ns = 0.0f;  ///< what drawing it takes by the model, if it is drawn; of a trial: what asking
                             ///< about it in place of its parts would save in a frame
    float pixels = 0.0f;     ///< that its boxes cover, about
    float distance = 0.0f;   ///< of its box from the eye, in any unit that all share
    std::uint16_t boxes = 1;
    std::uint16_t draws = 1;  ///< conditional draws it would take
    bool testable = true;     ///< false: the eye is in its boxes, or they cross the near plane: it is drawn
    bool counts_samples = false;  ///< the answer should say how many: hardware queries only
    bool trial = false;  ///< nothing is drawn of it: its parts are candidates, and `may_try` allowed this
};

/// What to do with a candidate in this frame.
enum class OcclusionAction : std::uint8_t {
    Draw,          ///< at once
    DrawAndQuery,  ///< at once; its query is for later frames
    QueryFirst,    ///< if its query of this frame sees something
    Skip,          ///< not at all: latent mode only; its query, if any, is for later frames
};

/// Of one candidate.
struct OcclusionDecision {
    static constexpr std::uint32_t kNoQuery = 0xffffffffu;

    OcclusionAction action = OcclusionAction::Draw;
    std::uint32_t query = kNoQuery;  ///< into `OcclusionDecisions::queries`
};

/// A question about one candidate or several.
struct ScheduledQuery {
    std::uint64_t ticket = 0;  ///< never used before by this scheduler
    QueryWay way = QueryWay::HardwareQuery;
    bool counts_samples = false;
    std::uint32_t first_member = 0;  ///< into `OcclusionDecisions::members`
    std::uint32_t member_count = 0;
};

/// What a frame decided. Reuse it: clearing keeps the memory.
struct OcclusionDecisions {
    std::vector<OcclusionDecision> decisions;  ///< by candidate
    std::vector<ScheduledQuery> queries;
    std::vector<std::uint32_t> members;  ///< candidates, query after query
    double query_ns = 0.0;               ///< what asking costs by `QueryCosts`
    double exploration_ns = 0.0;         ///< part of it that the gate alone would not have spent
    double saved_ns = 0.0;               ///< expected, against drawing all candidates: less `query_ns`
};

/// One per view; not thread-safe. Allocates when the largest frame grows, never after.
class OcclusionScheduler {
  public:
    /// Knows nothing of any item yet.
    explicit OcclusionScheduler(const OcclusionSettings& settings = {}, const QueryCosts& costs = {});
    ~OcclusionScheduler();
    OcclusionScheduler(OcclusionScheduler&&) noexcept;
    OcclusionScheduler& operator=(OcclusionScheduler&&) noexcept;

    /// Items are below `count`; new ones are Unknown, those beyond are forgotten.
    void resize(std::size_t count);
    /// `item` is another thing from now on, or somewhere else: nothing is known of it, and answers on the way
    /// say nothing. Before the frame's first `visit`.
    void forget(std::uint32_t item);
    /// A cost that is no number, or below 0, is not known: what it is part of is never asked.
    void set_costs(const QueryCosts& costs);
    /// What it decides by.
    [[nodiscard]] const OcclusionSettings& settings() const;

    /// Answers of earlier frames in any order, each at most once; unknown tickets (twice answered, long
    /// given up) are counted and otherwise ignored.
    void absorb(std::span<const QueryAnswer> answers);
    /// `frame_ns`: what the frame is predicted to take; exploration gets its share of it. `screen_pixels`: of
    /// the render target; 0 is "not known": nothing is then drawn at once for others to hide behind.
    void begin_frame(double frame_ns, double screen_pixels = 0.0);

    /// The traversal is at `item`, which is in the frustum: what is believed of it. An item that was not
    /// visited in the frame before is forgotten first, and then believed to be `otherwise` (Hidden: with the
    /// least confidence).
    Belief visit(std::uint32_t item, Belief otherwise = Belief::Unknown);
    /// The probability that `item` is hidden, by what is known of it. Of the items visited this frame.
    [[nodiscard]] double p_hidden(std::uint32_t item) const;
    /// Whether `item` was believed hidden until its last answer: its parts are probably hidden still.
    [[nodiscard]] bool turned_visible(std::uint32_t item) const;
    /// All parts of `item`, visited this frame, are believed hidden with probability `p_hidden` or more: may
    /// it be asked about as one, beside its parts? Then it is a candidate with `trial`, and once its answer
    /// is "hidden" it is believed so, as surely as its parts were. False: it was tried not long ago and seen,
    /// or the answer is on its way.
    bool may_try(std::uint32_t item, double p_hidden);

    /// Decides about all candidates of the frame; at most one call per frame. Deterministic.
    void decide(std::span<const OcclusionCandidate> candidates, OcclusionDecisions& out);

    /// Since it was made.
    struct Counters {
        std::uint64_t answers = 0, hidden = 0;        ///< absorbed; of those, taken for hidden
        std::uint64_t unknown_tickets = 0, lost = 0;  ///< answers that nobody asked for; queries given up
    };
    /// Of all frames so far.
    [[nodiscard]] const Counters& counters() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rhview
