// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Draws for methods that ask and wait within a frame, with an executor's shaders, state and counters.
#pragma once

#include <memory>

#include "rhview/gl/executor.h"
#include "rhview/pipeline/occlusion_device.h"

namespace rhview::gl {

/// Between `begin` and `end` of a frame, calls of `OcclusionDevice` become OpenGL calls at once. Draws have
/// the depths that `Executor::draw` gives them, boxes are widened as `pipeline/query_boxes.h` proves, and
/// queries are GL_ANY_SAMPLES_PASSED_CONSERVATIVE. Draws and boxes may alternate: each change sets the state
/// that differs.
class SteppedExecutor final : public OcclusionDevice {
  public:
    /// `executor` outlives it.
    static Result<SteppedExecutor> create(Executor& executor);
    SteppedExecutor(SteppedExecutor&&) noexcept;
    SteppedExecutor& operator=(SteppedExecutor&&) noexcept;
    ~SteppedExecutor() override;

    /// Draws into the bound framebuffer and viewport. `scene` outlives the frame. `options.counter` is not
    /// used: OpenGL knows one occlusion query at a time. `options.object_levels` holds for all objects of the
    /// frame: those of one call are drawn by mesh and level. Otherwise as for `Executor::draw`.
    void begin(const SceneBuffers& scene, const View& view, const DrawOptions& options = {});
    /// Puts OpenGL's state back. All draws count as draws at once.
    FrameCounters end();

    void draw(std::span<const DrawRange> ranges, std::span<const ObjectId> objects) override;
    QueryHandle draw_and_ask(std::span<const DrawRange> ranges, std::span<const ObjectId> objects) override;
    void ask(std::span<const BoxQuery> queries, std::span<const Aabb> boxes,
             std::vector<QueryHandle>& handles) override;
    bool has_answer(QueryHandle query) override;
    bool take_answer(QueryHandle query) override;

    /// Of all frames.
    [[nodiscard]] const AnswerCounters& answer_counters() const;
    /// What the calls of this frame took so far, of the CPU's time and of waiting.
    [[nodiscard]] double device_ms() const;

  private:
    struct State;
    explicit SteppedExecutor(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace rhview::gl
