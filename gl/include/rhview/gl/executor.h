// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Draws frame plans through OpenGL, and counts what it submits where it submits it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "rhview/base/view.h"
#include "rhview/gl/handle.h"
#include "rhview/gl/scene_buffers.h"
#include "rhview/pipeline/frame_plan.h"

namespace rhview::gl {

struct FrameCounters {
    std::uint64_t draw_calls = 0;        ///< N: calls issued; a multi-draw is one
    std::uint64_t sub_draws = 0;         ///< index ranges submitted
    std::uint64_t indices = 0;           ///< V: three per triangle
    std::uint64_t material_changes = 0;  ///< times that state was set: per batch and per object
};

enum class Submission {
    Plain,      ///< one call per range
    MultiDraw,  ///< one call per batch
};

struct DrawOptions {
    Submission submission = Submission::Plain;
    std::optional<glm::vec3> colour;  ///< instead of the materials' and vertices', whose brightness is kept
};

class Executor {
  public:
    static Result<Executor> create();

    /// Draws `plan` into the bound framebuffer and viewport. The vertex transform depends on `view` and the
    /// scene alone, so what two plans both draw gets the same depths to the last bit. Everything it touches
    /// of OpenGL's state is put back. `view.clip_depth` other than OpenGL's own needs
    /// `DeviceInfo::clip_control`. Cost: one API call per range, plus a handful per batch and object; no
    /// allocation after warm-up.
    FrameCounters draw(const FramePlan& plan, const SceneBuffers& scene, const View& view,
                       const DrawOptions& options = {});

  private:
    struct Uniforms {
        int clip_from_relative = -1;
        int eye_high = -1;
        int eye_low = -1;
        int normal_matrix = -1;
        int override_colour = -1;
    };

    void begin(const View& view, const DrawOptions& options) const;
    void set_transform(const View& view, const glm::dvec3& origin, const glm::dmat4& scene_from_mesh) const;
    static void set_state(const DrawState& state);
    void draw_ranges(std::span<const DrawRange> ranges, Submission submission, FrameCounters& counters);

    Program program_;
    Uniforms uniforms_;
    bool clip_control_ = false;
    std::vector<std::int32_t> counts_;  ///< scratch of a multi-draw
    std::vector<const void*> offsets_;
};

}  // namespace rhview::gl
