// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/executor.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "attributes.h"
#include "box_pass.h"
#include "object_drawer.h"
#include "occlusion_tests.h"
#include "program.h"
#include "rhview/base/assert.h"
#include "rhview/base/rounding.h"
#include "rhview/gl/work_counter.h"
#include "state_guard.h"

namespace rhview::gl {
namespace {

// The eye is subtracted as two floats: exact near the camera, wherever in the world that is.
constexpr const char* kVertexShader = R"(#version 430 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec4 colour;
uniform mat4 clip_from_relative;
uniform vec3 eye_high;
uniform vec3 eye_low;
out vec3 relative;
out vec3 surface_normal;
out vec3 surface_colour;
invariant gl_Position;
void main() {
    precise vec3 from_eye = (position - eye_high) - eye_low;
    precise vec4 clip = clip_from_relative * vec4(from_eye, 1.0);
    gl_Position = clip;
    relative = from_eye;
    surface_normal = normal.xyz;
    surface_colour = colour.rgb;
}
)";

// A sun, a sky and the light that the ground throws back. Without normals the surface is flat, facing the
// viewer.
constexpr const char* kFragmentShader = R"(#version 430 core
in vec3 relative;
in vec3 surface_normal;
in vec3 surface_colour;
uniform vec4 override_colour;
layout(location = 0) out vec4 pixel;
void main() {
    vec3 n = surface_normal;
    if (dot(n, n) < 0.01) {
        n = cross(dFdx(relative), dFdy(relative));
        n = dot(n, relative) > 0.0 ? -n : n;
    } else if (!gl_FrontFacing) {
        n = -n;
    }
    n = normalize(n);
    float sun = max(dot(n, vec3(0.48, 0.74, 0.47)), 0.0);
    vec3 ambient = mix(vec3(0.20, 0.19, 0.18), vec3(0.40, 0.45, 0.52), n.y * 0.5 + 0.5);
    float grey = dot(surface_colour, vec3(0.3, 0.6, 0.1));
    vec3 colour = mix(surface_colour, override_colour.rgb * (0.4 + 1.2 * grey), override_colour.a);
    pixel = vec4(sqrt(clamp(colour * (ambient + sun * vec3(0.80, 0.76, 0.68)), 0.0, 1.0)), 1.0);
}
)";

const void* index_offset(std::uint32_t first_index) {
    return reinterpret_cast<const void*>(static_cast<std::uintptr_t>(first_index) * sizeof(std::uint32_t));
}

BatchId batch_of(const DrawRange& range) {
    return range.batch;
}

BatchId batch_of(const ConditionalRange& conditional) {
    return conditional.range.batch;
}

/// Where the draws of the batch of entry `first` end.
template <class Draw>
std::size_t end_of_batch(const std::vector<Draw>& draws, std::size_t first) {
    std::size_t end = first + 1;
    while (end < draws.size() && batch_of(draws[end]) == batch_of(draws[first])) ++end;
    return end;
}

/// While it lives, the device draws only if the query saw something; it waits for that, the CPU does not.
class Condition {
  public:
    /// No query, 0: it draws.
    explicit Condition(GLuint query) : query_(query) {
        if (query_ != 0) glBeginConditionalRender(query_, GL_QUERY_WAIT);
    }
    ~Condition() {
        if (query_ != 0) glEndConditionalRender();
    }
    Condition(const Condition&) = delete;
    Condition& operator=(const Condition&) = delete;

  private:
    GLuint query_;
};

}  // namespace

Executor::Executor() = default;
Executor::Executor(Executor&&) noexcept = default;
Executor& Executor::operator=(Executor&&) noexcept = default;
Executor::~Executor() = default;

Result<Executor> Executor::create(const ExecutorOptions& options) {
    const StateGuard guard(has_clip_control());
    Result<Program> program = link_program(kVertexShader, kFragmentShader);
    if (!program) return program.error();
    Executor executor;
    Result<OcclusionTests> tests = OcclusionTests::create(options.lost_after_frames);
    if (!tests) return tests.error();
    executor.tests_ = std::make_unique<OcclusionTests>(std::move(tests).value());
    executor.program_ = std::move(program).value();
    Result<ObjectDrawer> objects = ObjectDrawer::create(kFragmentShader);
    if (!objects) return objects.error();
    executor.objects_ = std::make_unique<ObjectDrawer>(std::move(objects).value());
    executor.clip_control_ = has_clip_control();
    const auto location = [&](const char* name) {
        return glGetUniformLocation(executor.program_.name(), name);
    };
    executor.uniforms_ = {location("clip_from_relative"), location("eye_high"), location("eye_low"),
                          location("override_colour")};
    return executor;
}

void Executor::begin(const View& view) const {
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    const bool reversed = view.clip_depth == ClipDepth::ReversedZeroToOne;
    glDepthFunc(reversed ? GL_GEQUAL : GL_LEQUAL);
    glCullFace(GL_BACK);
    RHVIEW_ASSERT(clip_control_ || view.clip_depth == ClipDepth::NegativeOneToOne);
    if (clip_control_)
        glClipControl(GL_LOWER_LEFT, view.clip_depth == ClipDepth::NegativeOneToOne ? GL_NEGATIVE_ONE_TO_ONE
                                                                                    : GL_ZERO_TO_ONE);
}

void Executor::begin_static(const View& view, const glm::dvec3& origin, const DrawOptions& options) const {
    const SplitPosition eye = split_position(view.eye() - origin);
    const glm::mat4 clip(view.clip_from_eye_relative());
    const glm::vec3 colour = options.colour.value_or(glm::vec3(0.0f));
    glUseProgram(program_.name());
    glUniformMatrix4fv(uniforms_.clip_from_relative, 1, GL_FALSE, glm::value_ptr(clip));
    glUniform3fv(uniforms_.eye_high, 1, glm::value_ptr(eye.high));
    glUniform3fv(uniforms_.eye_low, 1, glm::value_ptr(eye.low));
    glUniform4f(uniforms_.override_colour, colour.r, colour.g, colour.b, options.colour ? 1.0f : 0.0f);
    glFrontFace(GL_CCW);
}

void Executor::set_state(const DrawState& state) {
    glBindVertexArray(state.vertex_array);
    glVertexAttrib4f(kNormalAttribute, 0.0f, 0.0f, 0.0f, 0.0f);
    if (!state.vertex_colours)
        glVertexAttrib4f(kColourAttribute, state.colour.r, state.colour.g, state.colour.b, 1.0f);
    state.two_sided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
}

std::uint64_t Executor::draw_ranges(std::span<const DrawRange> ranges, Submission submission) {
    if (submission == Submission::Plain) {
        for (const DrawRange& range : ranges)
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.index_count), GL_UNSIGNED_INT,
                           index_offset(range.first_index));
        return ranges.size();
    }
    counts_.clear();
    offsets_.clear();
    for (const DrawRange& range : ranges) {
        counts_.push_back(static_cast<GLsizei>(range.index_count));
        offsets_.push_back(index_offset(range.first_index));
    }
    glMultiDrawElements(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_INT, offsets_.data(),
                        static_cast<GLsizei>(counts_.size()));
    return 1;
}

void Executor::draw_at_once(const FramePlan& plan, const SceneBuffers& scene, const View& view,
                            const DrawOptions& options, FrameCounters& counters) {
    begin_static(view, scene.origin(), options);
    for (std::size_t first = 0; first < plan.opaque.size();) {
        const std::size_t end = end_of_batch(plan.opaque, first);
        const auto ranges = std::span(plan.opaque).subspan(first, end - first);
        set_state(scene.batches()[index_of(ranges.front().batch)]);
        ++counters.material_changes;
        counters.draw_calls += draw_ranges(ranges, options.submission);
        counters.sub_draws += ranges.size();
        for (const DrawRange& range : ranges) counters.indices += range.index_count;
        first = end;
    }
    if (objects_->at_once().empty()) return;
    objects_->begin(options.colour);
    for (const ObjectRun& run : objects_->at_once()) {
        objects_->set_state(run);
        ObjectDrawer::draw(run);
        ++counters.material_changes;
        ++counters.draw_calls;
        ++counters.sub_draws;
        ++counters.object_draws;
        counters.instances += run.instances;
        counters.indices += run.indices();
    }
}

void Executor::draw_conditional_batch(std::span<const ConditionalRange> ranges, Submission submission,
                                      std::size_t& command, FrameCounters& counters) {
    GLsizei indirect = 0;
    for (std::size_t first = 0; first < ranges.size();) {
        const std::uint32_t query = ranges[first].query;
        run_.clear();
        for (; first < ranges.size() && ranges[first].query == query; ++first) {
            counters.conditional_indices += ranges[first].range.index_count;
            run_.push_back(ranges[first].range);
        }
        if (tests_->is_indirect(query)) {
            indirect += static_cast<GLsizei>(run_.size());
            continue;
        }
        const Condition condition(tests_->condition(query));
        counters.conditional_draws += draw_ranges(run_, submission);
    }
    counters.conditional_sub_draws += ranges.size();
    if (indirect == 0) return;
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, BoxPass::command_offset(command), indirect, 0);
    command += static_cast<std::size_t>(indirect);
    ++counters.conditional_draws;
    ++counters.indirect_calls;
}

void Executor::draw_conditional_objects(std::size_t& command, FrameCounters& counters) {
    const std::span<const ObjectRun> runs = objects_->conditional();
    for (std::size_t first = 0; first < runs.size();) {
        objects_->set_state(runs[first]);
        ++counters.material_changes;
        GLsizei indirect = 0;
        std::size_t end = first;
        for (; end < runs.size() && runs[end].shares_state(runs[first]); ++end) {
            ++counters.conditional_sub_draws;
            counters.conditional_instances += runs[end].instances;
            counters.conditional_indices += runs[end].indices();
            if (tests_->is_indirect(runs[end].query)) {
                ++indirect;
                continue;
            }
            const Condition condition(tests_->condition(runs[end].query));
            ObjectDrawer::draw(runs[end]);
            ++counters.conditional_draws;
        }
        first = end;
        if (indirect == 0) continue;
        glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, BoxPass::command_offset(command), indirect,
                                    0);
        command += static_cast<std::size_t>(indirect);
        ++counters.conditional_draws;
        ++counters.indirect_calls;
    }
}

void Executor::draw_conditional(const FramePlan& plan, const SceneBuffers& scene, const View& view,
                                const DrawOptions& options, FrameCounters& counters) {
    std::size_t command = 0;
    tests_->bind_commands();
    begin_static(view, scene.origin(), options);
    for (std::size_t first = 0; first < plan.conditional.size();) {
        const std::size_t end = end_of_batch(plan.conditional, first);
        set_state(scene.batches()[index_of(plan.conditional[first].range.batch)]);
        ++counters.material_changes;
        draw_conditional_batch(std::span(plan.conditional).subspan(first, end - first), options.submission,
                               command, counters);
        first = end;
    }
    if (options.late.prepare != nullptr && !plan.conditional_objects.empty()) {
        prepare_late(plan, scene, view, options, counters);
        command = 0;
    }
    if (objects_->conditional().empty()) return;
    objects_->begin(options.colour);
    draw_conditional_objects(command, counters);
}

void Executor::prepare_late(const FramePlan& plan, const SceneBuffers& scene, const View& view,
                            const DrawOptions& options, FrameCounters& counters) {
    tests_->look(plan);
    places_.clear();
    for (std::uint32_t i = 0; i < plan.conditional_objects.size(); ++i)
        if (!tests_->is_found_hidden(plan.conditional_objects[i].query)) places_.push_back(i);
    counters.found_hidden += plan.conditional_objects.size() - places_.size();
    if (places_.empty()) return;
    options.late.prepare(options.late.context, places_);
    objects_->place_late(plan, places_, scene, view, options.placements);
    RHVIEW_ASSERT(objects_->largest_growth() <= asked_growth_);
    tests_->command_late(*objects_);
}

FrameCounters Executor::draw(const FramePlan& plan, const SceneBuffers& scene, const View& view,
                             const DrawOptions& options) {
    const StateGuard guard(clip_control_);
    FrameCounters counters;
    begin(view);
    const bool late = options.late.prepare != nullptr;
    objects_->place(plan, scene, view, options.placements, late);
    draw_at_once(plan, scene, view, options, counters);
    tests_->begin_frame();
    if (plan.queries.empty()) {
        RHVIEW_ASSERT(plan.conditional.empty() && plan.conditional_objects.empty());
        return counters;
    }
    const QueryStateGuard query_guard;
    if (options.counter != nullptr) options.counter->pause();
    asked_growth_ = objects_->largest_growth();
    if (late) asked_growth_ = std::max(asked_growth_, options.late.largest_growth);
    tests_->ask(plan, scene, view, *objects_, asked_growth_, counters);
    if (options.counter != nullptr) options.counter->resume();
    query_guard.put_back_raster_state();
    begin(view);
    draw_conditional(plan, scene, view, options, counters);
    return counters;
}

bool Executor::has_box_pass() const {
    return tests_->has_box_pass();
}

void Executor::poll_answers(std::vector<QueryAnswer>& answers) {
    tests_->poll(answers);
}

void Executor::wait_for_answers(std::vector<QueryAnswer>& answers) {
    tests_->wait(answers);
}

AnswerCounters Executor::answer_counters() const {
    return tests_->counters();
}

}  // namespace rhview::gl
