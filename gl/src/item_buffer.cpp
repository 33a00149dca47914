// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/item_buffer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "program.h"
#include "renderbuffer.h"
#include "rhview/base/rounding.h"
#include "state_guard.h"

namespace rhview::gl {
namespace {

// The executor's transform, without shading.
constexpr const char* kVertexShader = R"(#version 430 core
layout(location = 0) in vec3 position;
uniform mat4 clip_from_relative;
uniform vec3 eye_high;
uniform vec3 eye_low;
void main() {
    precise vec3 from_eye = (position - eye_high) - eye_low;
    gl_Position = clip_from_relative * vec4(from_eye, 1.0);
}
)";

constexpr const char* kFragmentShader = R"(#version 430 core
uniform uint item;
layout(location = 0) out uint pixel;
void main() { pixel = item; }
)";

}  // namespace

Result<ItemBuffer> ItemBuffer::create(int width, int height) {
    Result<Program> program = link_program(kVertexShader, kFragmentShader);
    if (!program) return program.error();
    ItemBuffer result;
    result.program_ = std::move(program).value();
    const auto location = [&](const char* name) {
        return glGetUniformLocation(result.program_.name(), name);
    };
    result.uniforms_ = {location("clip_from_relative"), location("eye_high"), location("eye_low"),
                        location("item")};
    const TargetGuard guard;
    result.width_ = width;
    result.height_ = height;
    result.items_ = make_renderbuffer(GL_R32UI, width, height);
    result.depth_ = make_renderbuffer(GL_DEPTH_COMPONENT32F, width, height);
    result.framebuffer_ = make_framebuffer(result.items_, result.depth_);
    if (result.framebuffer_.name() == 0)
        return Error{"the driver can't make an item buffer of " + std::to_string(width) + "x" +
                     std::to_string(height) + "; choose a smaller one"};
    return result;
}

void ItemBuffer::begin(const View& view) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, width_, height_);
    glUseProgram(program_.name());
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glCullFace(GL_BACK);
    const bool reversed = view.clip_depth == ClipDepth::ReversedZeroToOne;
    glDepthFunc(reversed ? GL_GREATER : GL_LESS);
    if (has_clip_control())
        glClipControl(GL_LOWER_LEFT, view.clip_depth == ClipDepth::NegativeOneToOne ? GL_NEGATIVE_ONE_TO_ONE
                                                                                    : GL_ZERO_TO_ONE);
    const GLuint nothing[4] = {kNoItem, 0, 0, 0};
    const GLfloat farthest = reversed ? 0.0f : 1.0f;
    glClearBufferuiv(GL_COLOR, 0, nothing);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void ItemBuffer::set_transform(const View& view, const glm::dvec3& origin,
                               const glm::dmat4& scene_from_mesh) const {
    const glm::dmat3 linear(scene_from_mesh);
    const SplitPosition eye =
        split_position(glm::inverse(linear) * (view.eye() - origin - glm::dvec3(scene_from_mesh[3])));
    const glm::mat4 clip(view.clip_from_eye_relative() * glm::dmat4(linear));
    glUniformMatrix4fv(uniforms_.clip_from_relative, 1, GL_FALSE, glm::value_ptr(clip));
    glUniform3fv(uniforms_.eye_high, 1, glm::value_ptr(eye.high));
    glUniform3fv(uniforms_.eye_low, 1, glm::value_ptr(eye.low));
    glFrontFace(glm::determinant(linear) < 0.0 ? GL_CW : GL_CCW);
}

void ItemBuffer::draw(const DrawState& state, std::uint32_t first_index, std::uint32_t index_count,
                      std::uint32_t item) const {
    glBindVertexArray(state.vertex_array);
    state.two_sided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
    glUniform1ui(uniforms_.item, item);
    const auto offset = static_cast<std::uintptr_t>(first_index) * sizeof(std::uint32_t);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(index_count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(offset));
}

std::span<const std::uint32_t> ItemBuffer::item_pixels(std::span<const ItemRange> ranges,
                                                       std::uint32_t first_object, const SceneBuffers& scene,
                                                       const View& view,
                                                       std::span<const glm::dmat4> placements,
                                                       std::span<const std::uint8_t> levels) {
    const StateGuard state_guard(has_clip_control());
    const TargetGuard target_guard;
    begin(view);
    set_transform(view, scene.origin(), glm::dmat4(1.0));
    for (const ItemRange& part : ranges)
        draw(scene.batches()[index_of(part.range.batch)], part.range.first_index, part.range.index_count,
             part.item);
    std::uint32_t item = first_object;
    for (std::size_t i = 0; i < scene.object_meshes().size(); ++i) {
        const std::uint32_t mesh = scene.object_meshes()[i];
        set_transform(view, scene.origin(), i < placements.size() ? placements[i] : scene.placements()[i]);
        const LevelRange range = scene.level_range(mesh, i < levels.size() ? levels[i] : 0u);
        draw(scene.meshes()[mesh].state, range.first_index, range.index_count, item);
        if (first_object != kNoItem) ++item;
    }
    pixels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
    glReadPixels(0, 0, width_, height_, GL_RED_INTEGER, GL_UNSIGNED_INT, pixels_.data());
    return pixels_;
}

std::vector<std::uint32_t> ItemBuffer::visible_items(std::span<const ItemRange> ranges,
                                                     const SceneBuffers& scene, const View& view,
                                                     std::span<const glm::dmat4> placements,
                                                     std::span<const std::uint8_t> levels) {
    item_pixels(ranges, kNoItem, scene, view, placements, levels);
    std::ranges::sort(pixels_);
    std::vector<std::uint32_t> seen;
    for (const std::uint32_t item : pixels_)
        if (item != kNoItem && (seen.empty() || seen.back() != item)) seen.push_back(item);
    return seen;
}

}  // namespace rhview::gl
