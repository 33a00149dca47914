// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "box_drawer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>

#include "program.h"

namespace rhview::gl {
namespace {

// Vertex i is corner i % 6 of the face across axis i / 6. A corner is computed alike for each of its faces,
// so that faces meet without a gap. A face that is not drawn shrinks to a point outside.
constexpr const char* kVertexShader = R"(#version 430 core
layout(location = 0) in vec4 low_and_shift;
layout(location = 1) in vec3 high;
layout(location = 2) in uint faces_and_slot;
uniform mat4 clip_from_relative;
uniform vec4 depth_error;
uniform vec2 nearer;
flat out uint slot;
invariant gl_Position;
void main() {
    int axis = gl_VertexID / 6;
    int corner = gl_VertexID % 6;
    bool u = corner == 1 || corner == 2 || corner == 4;
    bool v = corner == 2 || corner == 4 || corner == 5;
    uint face = (faces_and_slot >> (2 * axis)) & 3u;
    slot = faces_and_slot >> 8;
    bool at = face == 2u;
    bvec3 at_high = axis == 0 ? bvec3(at, u, v) : axis == 1 ? bvec3(v, at, u) : bvec3(u, v, at);
    vec3 p = mix(low_and_shift.xyz, high, at_high);
    precise vec4 clip = clip_from_relative * vec4(p, 1.0);
    clip.z += nearer.x * (dot(depth_error.xyz, abs(p)) + depth_error.w + low_and_shift.w * clip.w);
    if (face == 0u) clip = vec4(-2.0, -2.0, 0.0, 1.0);
    if ((faces_and_slot & 64u) != 0u && axis == 0)
        clip = vec4(u ? 1.0 : -1.0, v ? 1.0 : -1.0, nearer.y, 1.0);
    gl_Position = clip;
}
)";

constexpr const char* kSilentFragmentShader = R"(#version 430 core
layout(early_fragment_tests) in;
void main() {}
)";

constexpr const char* kMarkingFragmentShader = R"(#version 430 core
layout(early_fragment_tests) in;
layout(std430, binding = 0) writeonly buffer Words { uint seen[]; };
flat in uint slot;
void main() { seen[slot] = 1u; }
)";

constexpr GLsizei kVertices = 18;

void set_attribute(GLuint index, GLint size, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(BoxInstance),
                          reinterpret_cast<const void*>(offset));
    glVertexAttribDivisor(index, 1);
}

}  // namespace

Result<BoxDrawer::Shader> BoxDrawer::link(const char* fragment_source) {
    Result<Program> program = link_program(kVertexShader, fragment_source);
    if (!program) return program.error();
    Shader shader;
    shader.program = std::move(program).value();
    const auto location = [&](const char* name) { return glGetUniformLocation(shader.program.name(), name); };
    shader.clip_from_relative = location("clip_from_relative");
    shader.depth_error = location("depth_error");
    shader.nearer = location("nearer");
    return shader;
}

Result<BoxDrawer> BoxDrawer::create(bool marks) {
    BoxDrawer drawer;
    for (int i = 0; i < (marks ? 2 : 1); ++i) {
        Result<Shader> shader = link(i == 0 ? kSilentFragmentShader : kMarkingFragmentShader);
        if (!shader) return shader.error();
        drawer.shaders_[i] = std::move(shader).value();
    }
    GLuint name = 0;
    glGenBuffers(1, &name);
    drawer.boxes_ = Buffer(name);
    glGenVertexArrays(1, &name);
    drawer.vertex_array_ = VertexArray(name);
    glBindVertexArray(name);
    glBindBuffer(GL_ARRAY_BUFFER, drawer.boxes_.name());
    set_attribute(0, 4, offsetof(BoxInstance, low));
    set_attribute(1, 3, offsetof(BoxInstance, high));
    glEnableVertexAttribArray(2);
    glVertexAttribIPointer(2, 1, GL_UNSIGNED_INT, sizeof(BoxInstance),
                           reinterpret_cast<const void*>(offsetof(BoxInstance, faces_and_slot)));
    glVertexAttribDivisor(2, 1);
    glBindVertexArray(0);
    return drawer;
}

void BoxDrawer::upload(std::span<const BoxInstance> boxes) {
    glBindBuffer(GL_ARRAY_BUFFER, boxes_.name());
    capacity_ = std::max(capacity_, boxes.size_bytes());
    // New storage, so that the device may go on reading the old.
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(capacity_), nullptr, GL_STREAM_DRAW);
    glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(boxes.size_bytes()), boxes.data());
}

std::uint32_t BoxDrawer::append(std::span<const BoxInstance> boxes) {
    constexpr std::size_t kLeastCapacity = 4096 * sizeof(BoxInstance);
    glBindBuffer(GL_ARRAY_BUFFER, boxes_.name());
    if (filled_ + boxes.size_bytes() > capacity_) {
        // New storage: boxes that are still to be drawn keep the old.
        capacity_ = std::max({kLeastCapacity, capacity_, 2 * boxes.size_bytes()});
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(capacity_), nullptr, GL_STREAM_DRAW);
        filled_ = 0;
    }
    glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(filled_),
                    static_cast<GLsizeiptr>(boxes.size_bytes()), boxes.data());
    const auto first = static_cast<std::uint32_t>(filled_ / sizeof(BoxInstance));
    filled_ += boxes.size_bytes();
    return first;
}

void BoxDrawer::begin(const BoxWidener& widener, Effect effect) const {
    const Shader& shader = shaders_[effect == Effect::None ? 0 : 1];
    glUseProgram(shader.program.name());
    glBindVertexArray(vertex_array_.name());
    glDepthMask(GL_FALSE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glDisable(GL_CULL_FACE);
    glDisable(GL_STENCIL_TEST);
    glEnable(GL_DEPTH_CLAMP);
    glUniformMatrix4fv(shader.clip_from_relative, 1, GL_FALSE, glm::value_ptr(widener.clip_from_relative()));
    glUniform4fv(shader.depth_error, 1, glm::value_ptr(widener.depth_error()));
    glUniform2f(shader.nearer, widener.nearer(), widener.nearest());
}

void BoxDrawer::draw(std::uint32_t first, std::uint32_t count) {
    glDrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, kVertices, static_cast<GLsizei>(count), first);
}

}  // namespace rhview::gl
