// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <vector>

#include "rhview/pipeline/object_levels.h"
#include "rhview/scenes/scene.h"
#include "verbs.h"
#include "walk_budget.h"

namespace rhview::cli {

/// The levels of detail of one walk's objects.
class WalkLevels {
  public:
    /// `chains` outlive it. `profile`: needed for a budget.
    WalkLevels(const Scene& scene, std::span<const LodChain> chains, const WalkOptions& options,
               const TimingProfile* profile);

    /// To the queries of the frames before.
    void absorb(std::span<const QueryAnswer> answers) { levels_.absorb(answers); }
    /// Of the objects of a plan that `input` was planned to.
    /// `profile`: the constants of now; null where nothing is predicted.
    void choose(const FrameInput& input, const TimingProfile* profile, FramePlan& plan, FrameRecord& record);
    /// Of those objects of the same plan that hang on queries and are left.
    void choose_late(const FrameInput& input, FramePlan& plan, std::span<std::uint32_t> places) {
        levels_.choose_late(input, plan, places);
    }
    /// Of all objects in the frustum, by `ObjectId`, for a method that draws as it finds.
    std::span<const std::uint8_t> choose_ahead(const FrameInput& input);
    /// The levels of what such a method drew.
    void name_levels(FramePlan& drawn) const;

    /// The largest error on the screen; of what hangs on queries only what they let pass.
    [[nodiscard]] double error_px(const FramePlan& plan, std::span<const QueryAnswer> answers) const;
    /// What planners reckon that an object has, for those in `plan`: what hangs on queries is reckoned anew
    /// when it comes into the plan, then every few frames, in turn.
    void count_indices(const FrameInput& input, const FramePlan& plan,
                       std::vector<std::uint32_t>& object_indices);
    void observe(const FrameRecord& record);

    /// Of all objects, by `ObjectId`: those of `plan`, and what the bound allows the others.
    std::span<const std::uint8_t> complete(const FrameInput& input, const FramePlan& plan);

  private:
    std::vector<std::uint32_t> whole_indices_;  ///< at full detail, by `ObjectId`
    LevelOptions options_;
    ObjectLevels levels_;
    std::optional<WalkBudget> budget_;
    std::vector<std::uint8_t> all_;
    std::vector<std::uint32_t> counted_;  ///< by `ObjectId`: the frame that it was priced in last
    std::uint32_t frame_ = 0;
};

}  // namespace rhview::cli
