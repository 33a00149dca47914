// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A yard whose objects come, wander and go, before two cameras that circle: what the soak test draws.
#pragma once

#include <vector>

#include "catalogue/hard_case.h"
#include "rhview/pipeline/moving_objects.h"

namespace rhview {

class SoakWorld {
  public:
    static constexpr double kFrameSeconds = 1.0 / 60.0;

    SoakWorld();

    [[nodiscard]] const Scene& scene() const { return scene_; }
    /// Some objects go and some come, the others wander on.
    void begin_frame(std::uint64_t frame);
    /// Places what `plan` may draw: no other object has to be where it is.
    void place_planned(const FramePlan& plan);
    /// Places all that are there.
    void place_all();
    void end_frame(const FramePlan& first, const FramePlan& second);

    [[nodiscard]] FrameInput input(const View& view, const glm::ivec2& viewport) const;
    /// The same, with every object's own box: for a planner that draws everything.
    [[nodiscard]] FrameInput exact_input(const View& view, const glm::ivec2& viewport);
    [[nodiscard]] std::span<const glm::dmat4> placements() const { return placements_; }
    [[nodiscard]] std::uint64_t came() const { return came_; }
    [[nodiscard]] std::uint64_t went() const { return went_; }
    [[nodiscard]] std::uint64_t slept() const { return slept_; }
    [[nodiscard]] const MovingObjects& movers() const { return movers_; }

    [[nodiscard]] static View camera(int number, std::uint64_t frame);

  private:
    struct Wanderer {
        glm::dvec3 start{0.0}, velocity{0.0};
        double since_s = 0.0;
        bool alive = false;
    };

    [[nodiscard]] glm::dmat4 place_of(std::size_t object) const;
    [[nodiscard]] Aabb box_of(std::size_t object) const;
    void come();
    void go();

    Scene scene_;
    MovingObjects movers_;
    Uniform uniform_{99};
    std::vector<Wanderer> wanderers_;  ///< by `ObjectId`
    std::vector<glm::dmat4> placements_;
    std::vector<std::uint32_t> groups_;
    std::vector<Aabb> exact_boxes_;
    double time_s_ = 0.0;
    std::uint64_t came_ = 0, went_ = 0, slept_ = 0;
};

}  // namespace rhview
