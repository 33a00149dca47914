// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// One level of detail per object and view: by an error bound in pixels, by fragments, within a budget.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "rhview/lod/lod_chain.h"

namespace rhview {

/// An object that will be drawn, or may be.
struct LodObject {
    std::uint32_t slot = 0;        ///< its number, the same in every frame; numbers are kept small
    std::uint32_t chain = 0;       ///< into the selector's chains
    double pixels_per_unit = 0.0;  ///< projected_error.h
    double size_px = 0.0;          ///< pixels that it covers, about; decides who is refined first in a budget
    /// Samples seen by its last query; none: not asked, or not known yet.
    std::optional<std::uint64_t> fragments{};
};

/// What drawing costs: numbers of the timing model.
struct LodCosts {
    double index_ns = 0.0;   ///< an index
    double object_ns = 0.0;  ///< an object, whatever its level
    double draw_ns = 0.0;    ///< a level of a mesh that at least one object is drawn at: an instanced call
};

/// What decides how coarse a level may be, where there is no budget.
enum class LodPolicy {
    ErrorBound,  ///< the coarsest level whose projected error is within the bound
    /// The paper's heuristic (Serpa & Rodrigues 2018): distance, by the bound, and fragments: no more
    /// triangles than `triangles_per_fragment` for each that was seen. The bound is no promise then.
    Fragments,
};

/// The bound, the budget, and how much must change for a level to change.
struct LodSelectionOptions {
    LodPolicy policy = LodPolicy::ErrorBound;
    double max_error_px = 1.0;            ///< 0: full detail
    double triangles_per_fragment = 1.0;  ///< of `LodPolicy::Fragments`
    /// What all objects may cost together. Where the bound costs more it gives way.
    double budget_ns = std::numeric_limits<double>::infinity();
    LodCosts costs{};
    /// A level is left for a coarser one only if that undercuts the bound by this share; a selection within a
    /// budget only if the new one is better by it. Below 1.
    double hysteresis = 0.15;
};

/// What was selected, and what it comes to.
struct LodSelection {
    std::vector<std::uint32_t> levels;  ///< of each object, in the order given
    double max_error_px = 0.0;          ///< the largest error on the screen
    double cost_ns = 0.0;               ///< of all objects, by `LodCosts`
    std::uint64_t indices = 0;
    bool bound_met = true;  ///< `max_error_px` is within the bound
    /// The cost is within the budget. False only if no selection is: then all objects are at their last
    /// level.
    bool budget_met = true;
    std::uint32_t switches = 0;  ///< objects whose level is not that of the last time they were selected
};

/// Remembers each object's level: one selector per view. Chains belong to the caller, and stay.
///
/// Within a budget: if the bound's levels cost too much, all objects start at their last level and are
/// refined step by step, the step with the greatest gain per index first, as long as it fits (greedy after
/// Funkhouser & Séquin 1993). The gain is the fall in wrong pixels, error_px × √size_px; an object's next
/// step is the one of the greatest gain per index among all its finer levels (the lower convex hull of Sinha
/// & Zoltners 1979), so that a small step of little use does not hide a large one. Where the step that no
/// longer fits gains more on its own than all before it, it is taken in their place: with draws that cost
/// nothing the gain is at least half the greatest possible. What is left of the budget goes to steps that
/// still fit. The last selection is kept where it fits and is nearly as good.
///
/// Equal inputs in an equal order give equal levels. A warm selector allocates nothing. Cost: linear in
/// objects and levels without a budget, O(n log n) in refinements with one.
class LodSelector {
  public:
    /// `chains` outlive it.
    explicit LodSelector(std::span<const LodChain> chains);

    /// Each slot occurs once, each chain is one of the selector's.
    void select(std::span<const LodObject> objects, const LodSelectionOptions& options, LodSelection& result);

    /// What `slot` was drawn at is forgotten: another object has the number now.
    void forget(std::uint32_t slot);

  private:
    static constexpr std::uint32_t kNoLevel = ~0u;

    /// An object's most rewarding refinement.
    struct Step {
        double gain_per_index = 0.0;
        std::uint32_t object = 0;
        std::uint32_t level = 0;
    };

    [[nodiscard]] std::span<const LodLevel> levels_of(std::size_t object) const;
    [[nodiscard]] double loss(std::size_t object, std::uint32_t level) const;
    [[nodiscard]] double total_loss(std::span<const std::uint32_t> levels) const;
    [[nodiscard]] std::uint32_t remembered(std::size_t object) const;
    [[nodiscard]] std::uint32_t wanted_level(std::size_t object) const;
    [[nodiscard]] std::uint32_t level_by_bound(std::size_t object) const;
    [[nodiscard]] std::uint32_t level_by_fragments(std::size_t object, std::uint64_t fragments) const;

    void count(std::span<const std::uint32_t> levels);
    [[nodiscard]] double cost(std::uint64_t indices, std::uint64_t groups) const;
    [[nodiscard]] double cost() const { return cost(indices_, groups_); }
    [[nodiscard]] bool fits(std::size_t object, std::uint32_t level) const;
    void move_to(std::size_t object, std::uint32_t level);

    void select_within_budget();
    void begin_refining();
    void refine();
    [[nodiscard]] static bool comes_later(const Step& a, const Step& b);
    void push_step(std::size_t object);
    void take_what_fits(std::size_t object);
    bool start_from_alone(const Step& step);
    void keep_last_selection();
    void finish(LodSelection& result);

    std::span<const LodChain> chains_;
    std::vector<std::size_t> first_group_;   ///< of each chain: its levels have consecutive groups
    std::vector<std::uint32_t> remembered_;  ///< by slot

    // Of the selection that is being made.
    std::span<const LodObject> objects_;
    const LodSelectionOptions* options_ = nullptr;
    std::vector<std::uint32_t> wanted_;  ///< levels, if they cost nothing
    std::vector<std::uint32_t> levels_;
    std::vector<std::uint32_t> last_;         ///< levels of the last selection
    std::vector<std::uint32_t> group_sizes_;  ///< objects at each level of each chain
    std::vector<Step> steps_;                 ///< a heap
    std::uint64_t indices_ = 0;
    std::uint64_t groups_ = 0;  ///< that have an object
    double gained_ = 0.0;
    bool budget_met_ = true;
};

}  // namespace rhview
