// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/executor.h"

#include <epoxy/gl.h>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "attributes.h"
#include "program.h"
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
uniform mat3 normal_matrix;
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
    n = normalize(normal_matrix * n);
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

bool is_mirrored(const glm::dmat4& matrix) {
    return glm::determinant(glm::dmat3(matrix)) < 0.0;
}

}  // namespace

Result<Executor> Executor::create() {
    Result<Program> program = link_program(kVertexShader, kFragmentShader);
    if (!program) return program.error();
    Executor executor;
    executor.program_ = std::move(program).value();
    executor.clip_control_ = has_clip_control();
    const auto location = [&](const char* name) {
        return glGetUniformLocation(executor.program_.name(), name);
    };
    executor.uniforms_ = {location("clip_from_relative"), location("eye_high"), location("eye_low"),
                          location("normal_matrix"), location("override_colour")};
    return executor;
}

void Executor::begin(const View& view, const DrawOptions& options) const {
    glUseProgram(program_.name());
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    const bool reversed = view.clip_depth == ClipDepth::ReversedZeroToOne;
    glDepthFunc(reversed ? GL_GEQUAL : GL_LEQUAL);
    glCullFace(GL_BACK);
    RHVIEW_ASSERT(clip_control_ || view.clip_depth == ClipDepth::NegativeOneToOne);
    if (clip_control_)
        glClipControl(GL_LOWER_LEFT, view.clip_depth == ClipDepth::NegativeOneToOne ? GL_NEGATIVE_ONE_TO_ONE
                                                                                    : GL_ZERO_TO_ONE);
    const glm::vec3 colour = options.colour.value_or(glm::vec3(0.0f));
    glUniform4f(uniforms_.override_colour, colour.r, colour.g, colour.b, options.colour ? 1.0f : 0.0f);
}

void Executor::set_transform(const View& view, const glm::dvec3& origin,
                             const glm::dmat4& scene_from_mesh) const {
    const glm::dmat3 linear(scene_from_mesh);
    const glm::dvec3 eye = glm::inverse(linear) * (view.eye() - origin - glm::dvec3(scene_from_mesh[3]));
    const glm::vec3 high(eye);
    const glm::vec3 low(eye - glm::dvec3(high));
    const glm::mat4 clip(view.clip_from_eye_relative() * glm::dmat4(linear));
    const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1]));
    const glm::mat3 normals(is_mirrored(scene_from_mesh) ? -cofactor : cofactor);
    glUniformMatrix4fv(uniforms_.clip_from_relative, 1, GL_FALSE, glm::value_ptr(clip));
    glUniform3fv(uniforms_.eye_high, 1, glm::value_ptr(high));
    glUniform3fv(uniforms_.eye_low, 1, glm::value_ptr(low));
    glUniformMatrix3fv(uniforms_.normal_matrix, 1, GL_FALSE, glm::value_ptr(normals));
    glFrontFace(is_mirrored(scene_from_mesh) ? GL_CW : GL_CCW);
}

void Executor::set_state(const DrawState& state) {
    glBindVertexArray(state.vertex_array);
    glVertexAttrib4f(kNormalAttribute, 0.0f, 0.0f, 0.0f, 0.0f);
    if (!state.vertex_colours)
        glVertexAttrib4f(kColourAttribute, state.colour.r, state.colour.g, state.colour.b, 1.0f);
    state.two_sided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
}

void Executor::draw_ranges(std::span<const DrawRange> ranges, Submission submission,
                           FrameCounters& counters) {
    counts_.clear();
    offsets_.clear();
    for (const DrawRange& range : ranges) {
        ++counters.sub_draws;
        counters.indices += range.index_count;
        if (submission == Submission::MultiDraw) {
            counts_.push_back(static_cast<GLsizei>(range.index_count));
            offsets_.push_back(index_offset(range.first_index));
            continue;
        }
        ++counters.draw_calls;
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.index_count), GL_UNSIGNED_INT,
                       index_offset(range.first_index));
    }
    if (counts_.empty()) return;
    ++counters.draw_calls;
    glMultiDrawElements(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_INT, offsets_.data(),
                        static_cast<GLsizei>(counts_.size()));
}

FrameCounters Executor::draw(const FramePlan& plan, const SceneBuffers& scene, const View& view,
                             const DrawOptions& options) {
    const StateGuard guard(clip_control_);
    FrameCounters counters;
    begin(view, options);
    set_transform(view, scene.origin(), glm::dmat4(1.0));
    for (std::size_t first = 0; first < plan.opaque.size();) {
        const BatchId batch = plan.opaque[first].batch;
        std::size_t end = first + 1;
        while (end < plan.opaque.size() && plan.opaque[end].batch == batch) ++end;
        set_state(scene.batches()[index_of(batch)]);
        ++counters.material_changes;
        draw_ranges(std::span(plan.opaque).subspan(first, end - first), options.submission, counters);
        first = end;
    }
    for (const ObjectId id : plan.objects) {
        const ObjectInstance& object = scene.objects()[index_of(id)];
        set_state(object.state);
        ++counters.material_changes;
        set_transform(view, scene.origin(), object.scene_from_mesh);
        const DrawRange whole{BatchId{0}, object.first_index, object.index_count};
        draw_ranges(std::span(&whole, 1), Submission::Plain, counters);
    }
    return counters;
}

}  // namespace rhview::gl
