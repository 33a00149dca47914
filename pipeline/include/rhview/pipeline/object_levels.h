// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The levels of detail that the objects of a frame are drawn at: what stands between a plan and its drawing.
///
/// A level is chosen by the box of an object, not by its placement: where a temporal volume stands in for a
/// mover, its level is good wherever in it the object is. Hidden or not, what may be drawn has a level, so
/// that the device can go on deciding about it.
///
/// A frame goes
///
///     planner.plan(input, plan)   levels.choose(input, options, plan)   draw
///
/// or, where a method draws as it finds, levels.choose(input, options) before it and `levels()` for its
/// draws.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <limits>
#include <span>
#include <vector>

#include "rhview/lod/lod_selection.h"
#include "rhview/pipeline/frame_plan.h"
#include "rhview/pipeline/frame_planner.h"
#include "rhview/pipeline/seen_fragments.h"

namespace rhview {

/// What an object's levels are, whatever it does.
struct LevelledObject {
    static constexpr std::uint32_t kNoChain = 0xffffffffu;

    std::uint32_t chain = kNoChain;  ///< into the chains; `kNoChain`: always full detail
    float scale = 1.0f;  ///< the longest that a unit of the mesh is in the scene: `largest_stretch`
};

/// How wrong a level may be, and what else decides.
struct LevelOptions {
    double max_error_px = 1.0;  ///< 0: full detail, unless the budget forbids it
    /// `Fragments`: by what the answers that were absorbed count; `OcclusionOptions::counts_samples` asks for
    /// them.
    LodPolicy policy = LodPolicy::ErrorBound;
    double triangles_per_fragment = 1.0;
    /// What the objects that a plan draws at once may cost together. What hangs on queries does not count; it
    /// is drawn no finer than them.
    double budget_ns = std::numeric_limits<double>::infinity();
    LodCosts costs{};  ///< of objects
};

/// What was chosen for the objects that are drawn at once.
struct LevelSummary {
    double max_error_px = 0.0;  ///< the largest on the screen; infinite where nothing bounds it
    double cost_ns = 0.0;       ///< by `LevelOptions::costs`
    std::uint64_t indices = 0;
    bool bound_met = true;
    bool budget_met = true;  ///< false only if no choice of levels fits
};

/// One per view: it remembers levels (`LodSelector`). Equal inputs in equal order give equal levels; no
/// allocation after warm-up.
class ObjectLevels {
  public:
    /// `chains` stay where they are; of 255 levels at most. `objects` by `ObjectId`; an object beyond the end
    /// has full detail.
    ObjectLevels(std::span<const LodChain> chains, std::span<const LevelledObject> objects);

    /// Another object has the number now; its chain is one of the chains. What its number was drawn at is
    /// forgotten where `FrameInput::new_objects` says so. Allocates for numbers beyond all before.
    void set_object(ObjectId object, const LevelledObject& levelled);

    /// Answers to the queries of earlier plans, for `LodPolicy::Fragments`.
    void absorb(std::span<const QueryAnswer> answers) { fragments_.absorb(answers); }

    /// Sets the levels of all objects in `plan`, and puts them in the order that it promises. `input` is what
    /// the plan was made from. What was known of `FrameInput::new_objects` is forgotten. Cost: about 0.15 µs
    /// per object of several levels.
    LevelSummary choose(const FrameInput& input, const LevelOptions& options, FramePlan& plan);
    /// The same of all objects in the frustum, as if all were drawn at once.
    LevelSummary choose(const FrameInput& input, const LevelOptions& options);
    /// The same of the objects of `plan` that are drawn at once. What hangs on queries waits for
    /// `choose_late`: level 0 stands for it in the plan.
    LevelSummary choose_at_once(const FrameInput& input, const LevelOptions& options, FramePlan& plan);
    /// Sets the levels of those of `plan.conditional_objects` whose `places` are named, and puts the places
    /// in order. By the bound alone, whatever was drawn before: so what follows does not depend on who was
    /// named, that is, on which answers came in time. After `choose_at_once`, of the same `input` and `plan`.
    void choose_late(const FrameInput& input, FramePlan& plan, std::span<std::uint32_t> places);
    /// What the bound allows the box of an object by itself.
    [[nodiscard]] std::uint8_t level_by_bound(const FrameInput& input, ObjectId object) const;

    /// By `ObjectId`: what was chosen last; 0 for what was not asked about.
    [[nodiscard]] std::span<const std::uint8_t> levels() const { return levels_; }
    /// Of an object at its level.
    [[nodiscard]] double error_px(ObjectId object) const { return errors_px_[index_of(object)]; }
    /// The indices of an object at its level; `whole` of one that has no chain.
    [[nodiscard]] std::uint32_t indices(ObjectId object, std::uint32_t whole) const;

    /// The same of any level of it.
    [[nodiscard]] std::uint32_t indices_at(ObjectId object, std::uint8_t level, std::uint32_t whole) const;

    /// Levels for all objects: of those in `plan` its own, for the rest what the bound allows for the boxes
    /// of `input`. For who draws everything to compare with. `levels` by `ObjectId`.
    void complete(const FrameInput& input, const LevelOptions& options, const FramePlan& plan,
                  std::vector<std::uint8_t>& levels) const;

  private:
    /// How large things are on the screen.
    struct Lens {
        glm::dmat4 clip_from_relative{1.0};
        glm::dvec3 eye{0.0};
        double width_px = 0.0, height_px = 0.0;
    };

    void begin(const FrameInput& input);
    [[nodiscard]] const LevelledObject* find(ObjectId object) const;
    [[nodiscard]] static Lens lens_of(const FrameInput& input);
    [[nodiscard]] static double pixels_per_scene_unit(const Lens& lens, const Aabb& box, double& size_px);
    [[nodiscard]] std::uint8_t level_within(const LevelledObject& object, double pixels_per_unit,
                                            double max_error_px) const;
    void add(const FrameInput& input, const Lens& lens, const LevelOptions& options, ObjectId object);
    void select(const LevelOptions& options);
    LevelSummary select_at_once(const FrameInput& input, const LevelOptions& options, const FramePlan& plan);
    void set_level(std::uint32_t object, std::uint8_t level, float error_px);

    std::span<const LodChain> chains_;
    std::vector<LevelledObject> objects_;  ///< by `ObjectId`
    LodSelector selector_;
    SeenFragments fragments_;
    ObjectSorter sorter_;
    std::vector<std::uint8_t> levels_;  ///< by `ObjectId`
    std::vector<float> errors_px_;
    std::vector<std::uint32_t> given_levels_;  ///< objects whose entries are not 0
    std::vector<LodObject> asked_;
    std::vector<ObjectId> in_view_;
    LevelOptions late_options_;  ///< of what hangs on queries
    Lens late_lens_;
    std::vector<std::uint32_t> places_;
    LodSelectionOptions selection_options_;
    LodSelection selection_;
};

}  // namespace rhview
