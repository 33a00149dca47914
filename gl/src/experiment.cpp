// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/experiment.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <random>

#include "program.h"
#include "rhview/gl/context.h"
#include "rhview/gl/timer.h"
#include "rhview/gl/work_counter.h"
#include "state_guard.h"

namespace rhview::gl {
namespace {

constexpr glm::vec3 kBackground(0.5f);
constexpr std::size_t kWarmUpFrames = 8;

// The corners of a box from the vertex number: twelve triangles, no buffer.
constexpr const char* kBoxVertexShader = R"(#version 430 core
uniform mat4 clip_from_box;
const int corners[36] = int[36](0,1,3, 0,3,2, 4,6,7, 4,7,5, 0,4,5, 0,5,1, 2,3,7, 2,7,6, 0,2,6, 0,6,4, 1,5,7, 1,7,3);
void main() {
    int c = corners[gl_VertexID];
    gl_Position = clip_from_box * vec4(c & 1, (c >> 1) & 1, c >> 2, 1.0);
}
)";

constexpr const char* kBoxFragmentShader = R"(#version 430 core
void main() {}
)";

glm::mat4 clip_from_box(const View& view, const glm::dvec3& origin, const Aabb& box) {
    const glm::dvec3 extent(box.extent());
    glm::dmat4 relative_from_box(1.0);
    for (int axis = 0; axis < 3; ++axis) relative_from_box[axis][axis] = extent[axis];
    relative_from_box[3] = glm::dvec4(origin + glm::dvec3(box.min) - view.eye(), 1.0);
    return glm::mat4(view.clip_from_eye_relative() * relative_from_box);
}

/// Asks an occlusion query per box, as a culling frame would: against the depth that was drawn, nothing
/// written.
class BoxQueries {
  public:
    static Result<BoxQueries> create(std::size_t most) {
        Result<Program> program = link_program(kBoxVertexShader, kBoxFragmentShader);
        if (!program) return program.error();
        BoxQueries boxes;
        boxes.program_ = std::move(program).value();
        boxes.matrix_ = glGetUniformLocation(boxes.program_.name(), "clip_from_box");
        GLuint name = 0;
        glGenVertexArrays(1, &name);
        boxes.vertex_array_ = VertexArray(name);
        for (std::size_t i = 0; i < most; ++i) {
            glGenQueries(1, &name);
            boxes.queries_.emplace_back(name);
        }
        return boxes;
    }

    void ask(std::span<const Aabb> boxes, const View& view, const glm::dvec3& origin) const {
        const StateGuard guard(has_clip_control_);
        glUseProgram(program_.name());
        glBindVertexArray(vertex_array_.name());
        glEnable(GL_DEPTH_TEST);
        glDisable(GL_CULL_FACE);
        glDepthMask(GL_FALSE);
        glDepthFunc(view.clip_depth == ClipDepth::ReversedZeroToOne ? GL_GEQUAL : GL_LEQUAL);
        if (has_clip_control_)
            glClipControl(GL_LOWER_LEFT, view.clip_depth == ClipDepth::NegativeOneToOne
                                             ? GL_NEGATIVE_ONE_TO_ONE
                                             : GL_ZERO_TO_ONE);
        GLboolean colour_mask[4] = {};
        glGetBooleanv(GL_COLOR_WRITEMASK, colour_mask);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const glm::mat4 matrix = clip_from_box(view, origin, boxes[i]);
            glUniformMatrix4fv(matrix_, 1, GL_FALSE, glm::value_ptr(matrix));
            glBeginQuery(GL_ANY_SAMPLES_PASSED_CONSERVATIVE, queries_[i].name());
            glDrawArrays(GL_TRIANGLES, 0, 36);
            glEndQuery(GL_ANY_SAMPLES_PASSED_CONSERVATIVE);
        }
        glColorMask(colour_mask[0], colour_mask[1], colour_mask[2], colour_mask[3]);
    }

    /// Takes the answers, so that no query stays pending.
    void take(std::size_t count) const {
        for (std::size_t i = 0; i < count; ++i) {
            GLuint answer = 0;
            glGetQueryObjectuiv(queries_[i].name(), GL_QUERY_RESULT, &answer);
        }
    }

  private:
    Program program_;
    VertexArray vertex_array_;
    std::vector<Query> queries_;
    int matrix_ = -1;
    bool has_clip_control_ = has_clip_control();
};

struct Times {
    std::vector<double> frame_ns, submit_ns, gpu_ns;
};

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    if (values.size() % 2 != 0) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

class Experiment {
  public:
    Experiment(std::span<const ExperimentFrame> frames, const SceneBuffers& scene, Executor& executor,
               RenderTarget& target, const ExperimentOptions& options, BoxQueries boxes)
        : frames_(frames),
          scene_(scene),
          executor_(executor),
          target_(target),
          options_(options),
          boxes_(std::move(boxes)),
          times_(frames.size()),
          works_(frames.size()) {}

    void run() {
        const WallTimer clock;
        std::vector<std::size_t> order(frames_.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::mt19937 random(options_.shuffle);
        const int total = static_cast<int>(order.size()) * options_.rounds;
        int done = 0;
        for (int round = 0; round < options_.rounds; ++round) {
            for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
            if (round == 0)
                for (std::size_t i = 0; i < std::min(order.size(), kWarmUpFrames); ++i) time(order[i], false);
            for (const std::size_t frame : order) {
                if (round > 0 && clock.elapsed_ms() > 1e3 * options_.longest_s) return;
                if (options_.progress) options_.progress(done, total);
                time(frame, true);
                ++done;
            }
        }
    }

    [[nodiscard]] std::vector<FrameTiming> timings() const {
        std::vector<FrameTiming> result;
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            const Times& times = times_[i];
            FrameTiming timing;
            timing.work = works_[i];
            timing.frame_ns = median(times.frame_ns);
            timing.submit_ns = median(times.submit_ns);
            if (!times.gpu_ns.empty()) timing.gpu_ns = median(times.gpu_ns);
            timing.round_ns = times.frame_ns;
            result.push_back(timing);
        }
        return result;
    }

  private:
    void time(std::size_t index, bool keep) {
        const ExperimentFrame& frame = frames_[index];
        target_.begin(frame.view.clip_depth, kBackground);
        finish();
        const WallTimer timer;
        if (options_.use_gpu_timer) gpu_timer_.begin();
        counter_.begin();
        const FrameCounters counters =
            executor_.draw(frame.plan, scene_, frame.view, {.submission = frame.submission, .colour = {}});
        counter_.end();
        if (!frame.queried_boxes.empty()) boxes_.ask(frame.queried_boxes, frame.view, scene_.origin());
        if (options_.use_gpu_timer) gpu_timer_.end();
        const double submit_ms = timer.elapsed_ms();
        finish();
        const double frame_ms = timer.elapsed_ms();
        boxes_.take(frame.queried_boxes.size());
        works_[index] = work_of(counters);
        works_[index].queries = static_cast<double>(frame.queried_boxes.size());
        counter_.read(works_[index]);
        const double gpu_ms = options_.use_gpu_timer ? gpu_timer_.read_ms() : 0.0;
        if (!keep) return;
        times_[index].frame_ns.push_back(1e6 * frame_ms);
        times_[index].submit_ns.push_back(1e6 * submit_ms);
        if (options_.use_gpu_timer) times_[index].gpu_ns.push_back(1e6 * gpu_ms);
    }

    std::span<const ExperimentFrame> frames_;
    const SceneBuffers& scene_;
    Executor& executor_;
    RenderTarget& target_;
    const ExperimentOptions& options_;
    BoxQueries boxes_;
    WorkCounter counter_;
    GpuTimer gpu_timer_;
    std::vector<Times> times_;
    std::vector<Work> works_;
};

}  // namespace

Result<std::vector<FrameTiming>> run_experiment(std::span<const ExperimentFrame> frames,
                                                const SceneBuffers& scene, Executor& executor,
                                                RenderTarget& target, const ExperimentOptions& options) {
    RHVIEW_ASSERT(options.rounds > 0);
    take_error();
    const TargetGuard target_guard;
    std::size_t most_boxes = 0;
    for (const ExperimentFrame& frame : frames) most_boxes = std::max(most_boxes, frame.queried_boxes.size());
    Result<BoxQueries> boxes = BoxQueries::create(most_boxes);
    if (!boxes) return boxes.error();
    Experiment experiment(frames, scene, executor, target, options, std::move(boxes).value());
    experiment.run();
    if (const std::string error = take_error(); !error.empty())
        return Error{"the driver reported an error while frames were timed (" + error +
                     "); no timing constants were measured"};
    return experiment.timings();
}

std::vector<Sample> samples_of(std::span<const FrameTiming> timings, TimedPart part) {
    std::vector<Sample> samples;
    samples.reserve(timings.size());
    for (const FrameTiming& timing : timings)
        samples.push_back({timing.work, part == TimedPart::Frame ? timing.frame_ns : timing.submit_ns});
    return samples;
}

}  // namespace rhview::gl
