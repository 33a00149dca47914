// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <vector>

#include "rhview/pipeline/moving_objects.h"
#include "rhview/scenes/object_motion.h"

namespace rhview::cli {

/// Where the objects of a walk are.
class WalkObjects {
  public:
    /// `scene` outlives it.
    explicit WalkObjects(const Scene& scene);

    /// As before the first frame. `sleeping`: what is not drawn sleeps and is not touched, and each frame is
    /// a `move`, a plan of `planner_input` and a `place_planned`; else all objects are where they are.
    void begin(bool sleeping);
    void move(double time_s);
    [[nodiscard]] FrameInput planner_input(const View& view, glm::ivec2 viewport) const;
    /// Only what the plan names is drawn: what is drawn at once now, the rest once it is known to be needed.
    void place_planned(const FramePlan& plan, double time_s);
    void place_late(const FramePlan& plan, std::span<const std::uint32_t> places, double time_s);
    [[nodiscard]] bool are_late() const { return movers_.has_value(); }
    /// At least `rounding_growth` of every object at any time.
    [[nodiscard]] double largest_growth() const { return largest_growth_; }

    /// Every object, drawn or not: for comparisons, and for methods that find as they draw.
    void place_all(double time_s) { place_objects(scene_, time_s, placements_); }
    /// How many meshes, each at a level and mirrored or not, the plan draws at once: what as few calls could
    /// draw as there are.
    [[nodiscard]] std::size_t count_mesh_levels(const FramePlan& plan);

    /// With all objects where they were placed last.
    [[nodiscard]] FrameInput input(const View& view, glm::ivec2 viewport) const;
    [[nodiscard]] std::span<const glm::dmat4> scene_from_mesh() const { return placements_.scene_from_mesh; }

  private:
    void place(std::size_t count, double time_s, const auto& object_at);

    const Scene& scene_;
    std::vector<std::uint32_t> groups_;
    ObjectWays ways_;
    ObjectPlacements placements_;  ///< of the frame; with `movers_`, of what was last drawn or compared
    std::optional<MovingObjects> movers_;
    std::vector<std::uint64_t> mesh_levels_;  ///< scratch
    double largest_growth_ = 1.0;
};

}  // namespace rhview::cli
