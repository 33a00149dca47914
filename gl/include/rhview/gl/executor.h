// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Draws frame plans through OpenGL, and counts what it submits where it submits it.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rhview/base/view.h"
#include "rhview/gl/handle.h"
#include "rhview/gl/late_objects.h"
#include "rhview/gl/query_pool.h"
#include "rhview/gl/scene_buffers.h"
#include "rhview/pipeline/frame_plan.h"

namespace rhview::gl {

/// What was submitted. Of the conditional draws only the device knows which it executed, until the answers
/// come: `count_executed`.
struct FrameCounters {
    std::uint64_t draw_calls =
        0;  ///< N: calls issued, of draws at once; a multi-draw is one, an instanced too
    std::uint64_t sub_draws = 0;     ///< index ranges submitted, of draws at once; once for all its instances
    std::uint64_t indices = 0;       ///< V: three per triangle, of draws at once; times instances
    std::uint64_t object_draws = 0;  ///< the part of `draw_calls` that drew objects
    std::uint64_t instances = 0;     ///< objects in those
    std::uint64_t material_changes = 0;  ///< times that state was set: per batch and per run of objects

    std::uint64_t queries = 0;                ///< asked, either way
    std::uint64_t query_boxes = 0;            ///< drawn for them
    std::uint64_t query_draw_calls = 0;       ///< that drew them
    std::uint64_t conditional_draws = 0;      ///< calls, direct and indirect
    std::uint64_t conditional_sub_draws = 0;  ///< index ranges in them
    std::uint64_t conditional_indices = 0;    ///< in those, times instances
    std::uint64_t conditional_instances = 0;
    std::uint64_t indirect_calls = 0;  ///< the part of `conditional_draws` whose commands the device wrote
    std::uint64_t found_hidden =
        0;  ///< objects not submitted: by then the device had answered (`LateObjects`)
};

/// The conditional part of a frame, as far as its answers are known.
struct ExecutedDraws {
    std::uint64_t sub_draws = 0;          ///< ranges and runs of objects whose query saw something
    std::uint64_t indices = 0;            ///< in those
    std::uint64_t unknown_sub_draws = 0;  ///< no answer among those given
    std::uint64_t unknown_indices = 0;
};

/// Which of the conditional draws of `plan` the device executed, by `answers`, which may hold others' too.
/// `placements` as in `DrawOptions`.
/// Cost: queries × log(answers); allocates.
ExecutedDraws count_executed(const FramePlan& plan, const SceneBuffers& scene,
                             std::span<const QueryAnswer> answers,
                             std::span<const glm::dmat4> placements = {});

class WorkCounter;

/// How index ranges become draw calls.
enum class Submission {
    Plain,      ///< one call per range
    MultiDraw,  ///< one call per batch
};

/// Of one frame.
struct DrawOptions {
    Submission submission = Submission::Plain;
    std::optional<glm::vec3> colour;  ///< instead of the materials' and vertices', whose brightness is kept
    WorkCounter* counter = nullptr;   ///< one that counts meanwhile: paused while boxes are drawn
    /// Where the objects are, by `ObjectId` (`scene_from_mesh`); only those in the plan are read. Empty:
    /// where the scene placed them.
    std::span<const glm::dmat4> placements{};
    /// Their levels of detail, by `ObjectId`, for `SteppedExecutor`: a plan names its own. Empty: all of it.
    std::span<const std::uint8_t> object_levels{};
    LateObjects late{};
};

/// Of all frames.
struct ExecutorOptions {
    /// A query without an answer after that many frames is given up, and answered as visible.
    std::uint32_t lost_after_frames = 64;
};

class ObjectDrawer;
class OcclusionTests;

/// Draws for one planner, or several whose tickets differ: answers come back by ticket.
class Executor {
  public:
    /// Needs a current context, which outlives it. Errors: a shader that the driver refuses.
    static Result<Executor> create(const ExecutorOptions& options = {});
    Executor(Executor&&) noexcept;
    Executor& operator=(Executor&&) noexcept;
    ~Executor();

    /// Whether plans may use `QueryWay::BoxPass`; the others can always be drawn.
    [[nodiscard]] bool has_box_pass() const;

    /// Neighbours in `plan.objects` of one mesh, level and mirroring are drawn by one instanced call; so are
    /// neighbours among the conditional objects that hang on one query. Of the box pass, all neighbours of
    /// one mesh and mirroring take one indirect call.
    ///
    /// Draws `plan` into the bound framebuffer and viewport. The vertex transform depends on `view` and the
    /// scene alone, so what two plans both draw gets the same depths to the last bit. Everything it touches
    /// of OpenGL's state is put back. `view.clip_depth` other than OpenGL's own needs
    /// `DeviceInfo::clip_control`. Cost: one API call per range, plus a handful per batch, object and query;
    /// no allocation after warm-up.
    ///
    /// First all draws at once, then the boxes of all queries against that depth, then the conditional draws,
    /// about which the device decides: by conditional rendering, or by indirect commands that it writes
    /// itself. The CPU waits for nothing. What is left out could not have changed a bit of the depths: see
    /// `pipeline/query_boxes.h`. Every query has a box. The application's depth range is [0, 1], and it uses
    /// no polygon offset and no occlusion query of its own meanwhile.
    FrameCounters draw(const FramePlan& plan, const SceneBuffers& scene, const View& view,
                       const DrawOptions& options = {});

    /// Appends the answers that have come to queries of earlier frames, in any order, each once; a query
    /// that was given up counts as visible. Never waits. Call it once per frame.
    void poll_answers(std::vector<QueryAnswer>& answers);
    /// Appends all answers that are due: waits for them and counts that. For tools; no frame needs it.
    void wait_for_answers(std::vector<QueryAnswer>& answers);
    /// Of all frames drawn. `blocking_reads` stays 0 unless `wait_for_answers` had to wait.
    [[nodiscard]] AnswerCounters answer_counters() const;

  private:
    friend class SteppedExecutor;

    struct Uniforms {
        int clip_from_relative = -1;
        int eye_high = -1;
        int eye_low = -1;
        int override_colour = -1;
    };

    void begin(const View& view) const;
    void begin_static(const View& view, const glm::dvec3& origin, const DrawOptions& options) const;
    static void set_state(const DrawState& state);
    /// Returns the number of calls.
    std::uint64_t draw_ranges(std::span<const DrawRange> ranges, Submission submission);
    void draw_at_once(const FramePlan& plan, const SceneBuffers& scene, const View& view,
                      const DrawOptions& options, FrameCounters& counters);
    void draw_conditional(const FramePlan& plan, const SceneBuffers& scene, const View& view,
                          const DrawOptions& options, FrameCounters& counters);
    /// Places the late objects that are left.
    void prepare_late(const FramePlan& plan, const SceneBuffers& scene, const View& view,
                      const DrawOptions& options, FrameCounters& counters);
    void draw_conditional_batch(std::span<const ConditionalRange> ranges, Submission submission,
                                std::size_t& command, FrameCounters& counters);
    void draw_conditional_objects(std::size_t& command, FrameCounters& counters);

    Executor();

    Program program_;
    Uniforms uniforms_;
    bool clip_control_ = false;
    std::vector<std::int32_t> counts_;  ///< scratch of a multi-draw
    std::vector<const void*> offsets_;
    std::vector<DrawRange> run_;         ///< scratch: ranges that hang on one query
    std::vector<std::uint32_t> places_;  ///< scratch: late objects that are left
    double asked_growth_ = 1.0;          ///< what boxes were widened for
    std::unique_ptr<ObjectDrawer> objects_;
    std::unique_ptr<OcclusionTests> tests_;
};

}  // namespace rhview::gl
