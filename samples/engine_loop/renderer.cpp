// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace engine {
namespace {

constexpr const char* kVertexShader = R"(#version 430 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal_or_colour;
layout(location = 0) uniform mat4 clip_from_world;
out vec3 surface;
invariant gl_Position;
void main() {
    gl_Position = clip_from_world * vec4(position, 1.0);
    surface = normal_or_colour;
})";

constexpr const char* kFragmentShader = R"(#version 430 core
in vec3 surface;
layout(location = 1) uniform vec3 material;
layout(location = 2) uniform bool painted;
out vec4 pixel;
void main() {
    float light = 0.4 + 0.6 * max(dot(surface, normalize(vec3(1, 2, 0.5))), 0.0);
    pixel = vec4(painted ? surface : material * light, 1.0);
})";

constexpr const char* kBoxVertexShader = R"(#version 430 core
layout(location = 0) uniform mat4 clip_from_world;
layout(location = 1) uniform vec3 low;
layout(location = 2) uniform vec3 high;
const int kCorners[36] = int[36](0,2,1, 1,2,3, 4,5,6, 5,7,6, 0,1,4, 1,5,4,
                                 2,6,3, 3,6,7, 0,4,2, 2,4,6, 1,3,5, 3,7,5);
void main() {
    int corner = kCorners[gl_VertexID];
    vec3 at = mix(low, high, vec3(corner & 1, (corner >> 1) & 1, corner >> 2));
    gl_Position = clip_from_world * vec4(at, 1.0);
})";

constexpr const char* kNoFragments = "#version 430 core\nvoid main() {}";

GLuint compile(GLenum stage, const char* source) {
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    return shader;
}

GLuint link(const char* vertex, const char* fragment) {
    const GLuint program = glCreateProgram();
    for (const GLuint shader : {compile(GL_VERTEX_SHADER, vertex), compile(GL_FRAGMENT_SHADER, fragment)}) {
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == 0) {
        char log[1024] = "";
        glGetProgramInfoLog(program, sizeof log, nullptr, log);
        std::fprintf(stderr, "engine: a shader does not link: %s\n", log);
        std::exit(1);
    }
    return program;
}

/// Half a pixel, and what rounding moves: a box that is not seen must prove that what it holds is not.
rhview::Aabb widened(const rhview::Aabb& box, const glm::vec3& eye) {
    const glm::vec3 farthest = glm::max(glm::abs(box.min - eye), glm::abs(box.max - eye));
    const glm::vec3 margin(1e-3f * glm::length(farthest));
    return {box.min - margin, box.max + margin};
}

}  // namespace

Renderer::Renderer(const World& world, std::span<const std::uint32_t> indices) {
    glCreateBuffers(1, &index_buffer_);
    glNamedBufferStorage(index_buffer_, static_cast<GLsizeiptr>(indices.size_bytes()), indices.data(), 0);
    const auto lit = [&](const LitMesh& mesh) {
        add_batch(mesh.vertices.data(), mesh.vertices.size() * sizeof(LitVertex),
                  {0, 0, false, mesh.material_colour});
    };
    lit(world.ground);
    lit(world.walls);
    add_batch(world.furniture.vertices.data(), world.furniture.vertices.size() * sizeof(PaintedVertex),
              {0, 0, true, {}});
    program_ = link(kVertexShader, kFragmentShader);
    box_program_ = link(kBoxVertexShader, kNoFragments);
    glCreateVertexArrays(1, &box_array_);
    glCreateFramebuffers(2, framebuffers_);
    glCreateRenderbuffers(2, depths_);
    glCreateRenderbuffers(1, &colour_);
    glNamedRenderbufferStorage(colour_, GL_RGBA8, kWidth, kHeight);
    glNamedRenderbufferStorage(depths_[0], GL_DEPTH_COMPONENT32F, kWidth, kHeight);
    glNamedRenderbufferStorage(depths_[1], GL_DEPTH_COMPONENT32F, kShadowSize, kShadowSize);
    glNamedFramebufferRenderbuffer(framebuffers_[0], GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    for (int i = 0; i < 2; ++i)
        glNamedFramebufferRenderbuffer(framebuffers_[i], GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depths_[i]);
    glNamedFramebufferDrawBuffer(framebuffers_[1], GL_NONE);
    glNamedFramebufferReadBuffer(framebuffers_[1], GL_NONE);
}

Renderer::~Renderer() {
    for (const Question& question : asked_) spare_.push_back(question.query);
    glDeleteQueries(static_cast<GLsizei>(spare_.size()), spare_.data());
    for (const Batch& batch : batches_) {
        glDeleteVertexArrays(1, &batch.vertex_array);
        glDeleteBuffers(1, &batch.vertex_buffer);
    }
    glDeleteBuffers(1, &index_buffer_);
    glDeleteVertexArrays(1, &box_array_);
    glDeleteFramebuffers(2, framebuffers_);
    glDeleteRenderbuffers(2, depths_);
    glDeleteRenderbuffers(1, &colour_);
    glDeleteProgram(program_);
    glDeleteProgram(box_program_);
}

void Renderer::add_batch(const void* vertices, std::size_t bytes, const Batch& batch) {
    Batch added = batch;
    glCreateBuffers(1, &added.vertex_buffer);
    glNamedBufferStorage(added.vertex_buffer, static_cast<GLsizeiptr>(bytes), vertices, 0);
    glCreateVertexArrays(1, &added.vertex_array);
    // Both formats are two vectors of three floats.
    glVertexArrayVertexBuffer(added.vertex_array, 0, added.vertex_buffer, 0, sizeof(LitVertex));
    for (const GLuint attribute : {0u, 1u}) {
        glEnableVertexArrayAttrib(added.vertex_array, attribute);
        glVertexArrayAttribFormat(added.vertex_array, attribute, 3, GL_FLOAT, GL_FALSE,
                                  attribute * static_cast<GLuint>(sizeof(glm::vec3)));
        glVertexArrayAttribBinding(added.vertex_array, attribute, 0);
    }
    glVertexArrayElementBuffer(added.vertex_array, index_buffer_);
    batches_.push_back(added);
}

void Renderer::begin(Target target, const rhview::View& view) {
    target_ = target;
    eye_ = view.eye();
    const bool picture = target == Target::Picture;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[picture ? 0 : 1]);
    glViewport(0, 0, picture ? kWidth : kShadowSize, picture ? kHeight : kShadowSize);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glDepthFunc(GL_GEQUAL);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    const float sky[4] = {0.7f, 0.8f, 0.9f, 1.0f}, farthest = 0.0f;
    if (picture) glClearBufferfv(GL_COLOR, 0, sky);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    const glm::mat4 clip(view.clip_from_camera * view.camera_from_world);
    for (const GLuint program : {program_, box_program_})
        glProgramUniformMatrix4fv(program, 0, 1, GL_FALSE, glm::value_ptr(clip));
}

void Renderer::draw(const rhview::DrawRange& range) {
    const Batch& batch = batches_[rhview::index_of(range.batch)];
    glUseProgram(program_);
    glBindVertexArray(batch.vertex_array);
    glUniform3fv(1, 1, glm::value_ptr(batch.colour));
    glUniform1i(2, batch.painted ? 1 : 0);
    const auto offset = static_cast<std::uintptr_t>(range.first_index) * sizeof(std::uint32_t);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.index_count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(offset));
    ++draw_calls_;
}

void Renderer::ask(std::uint64_t ticket, std::span<const rhview::Aabb> boxes) {
    if (spare_.empty()) {
        spare_.resize(64);
        glCreateQueries(GL_ANY_SAMPLES_PASSED_CONSERVATIVE, 64, spare_.data());
    }
    asked_.push_back({ticket, spare_.back()});
    spare_.pop_back();
    glUseProgram(box_program_);
    glBindVertexArray(box_array_);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glDepthMask(GL_FALSE);
    glDisable(GL_CULL_FACE);
    glBeginQuery(GL_ANY_SAMPLES_PASSED_CONSERVATIVE, asked_.back().query);
    for (const rhview::Aabb& box : boxes) {
        const rhview::Aabb wide = widened(box, glm::vec3(eye_));
        glUniform3fv(1, 1, glm::value_ptr(wide.min));
        glUniform3fv(2, 1, glm::value_ptr(wide.max));
        glDrawArrays(GL_TRIANGLES, 0, 36);
    }
    glEndQuery(GL_ANY_SAMPLES_PASSED_CONSERVATIVE);
    glEnable(GL_CULL_FACE);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

unsigned Renderer::query_of(std::uint64_t ticket) const {
    // This frame's tickets are the last.
    return std::find_if(asked_.rbegin(), asked_.rend(),
                        [&](const Question& question) { return question.ticket == ticket; })
        ->query;
}

void Renderer::draw_if_seen(std::uint64_t ticket, const rhview::DrawRange& range) {
    glBeginConditionalRender(query_of(ticket), GL_QUERY_WAIT);  // the GPU waits, the CPU does not
    draw(range);
    glEndConditionalRender();
}

std::span<const rhview::QueryAnswer> Renderer::answers() {
    answers_.clear();
    std::erase_if(asked_, [&](const Question& question) {
        GLuint available = 0, seen = 0;
        glGetQueryObjectuiv(question.query, GL_QUERY_RESULT_AVAILABLE, &available);
        if (available == 0) return false;
        glGetQueryObjectuiv(question.query, GL_QUERY_RESULT, &seen);
        answers_.push_back({question.ticket, seen != 0});
        spare_.push_back(question.query);
        return true;
    });
    return answers_;
}

std::vector<float> Renderer::read_depths() const {
    const bool picture = target_ == Target::Picture;
    const int width = picture ? kWidth : kShadowSize, height = picture ? kHeight : kShadowSize;
    std::vector<float> depths(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    return depths;
}

}  // namespace engine
