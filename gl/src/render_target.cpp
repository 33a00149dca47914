// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/render_target.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <utility>

#include "renderbuffer.h"
#include "state_guard.h"

namespace rhview::gl {

namespace {

Picture read_framebuffer(GLuint name, int width, int height) {
    Picture picture(width, height);
    const auto row_bytes = static_cast<std::size_t>(width) * 3;
    std::vector<std::uint8_t> rows(row_bytes * static_cast<std::size_t>(height));
    const TargetGuard guard;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, name);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
    for (int y = 0; y < height; ++y)
        std::copy_n(rows.data() + row_bytes * static_cast<std::size_t>(height - 1 - y), row_bytes,
                    picture.row(y));
    return picture;
}

}  // namespace

Renderbuffer make_renderbuffer(unsigned format, int width, int height) {
    GLuint name = 0;
    glGenRenderbuffers(1, &name);
    glBindRenderbuffer(GL_RENDERBUFFER, name);
    glRenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    return Renderbuffer(name);
}

Framebuffer make_framebuffer(const Renderbuffer& colour, const Renderbuffer& depth) {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    Framebuffer framebuffer(name);
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour.name());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.name());
    const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    return complete ? std::move(framebuffer) : Framebuffer();
}

Result<RenderTarget> RenderTarget::create(int width, int height) {
    GLint limit = 0;
    GLint viewport[2] = {};
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    limit = std::min({limit, viewport[0], viewport[1]});
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1 || width > limit || height > limit)
        return Error{"a picture of " + size + " is not possible here; each side must be from 1 to " +
                     std::to_string(limit)};
    const TargetGuard guard;
    RenderTarget target;
    target.width_ = width;
    target.height_ = height;
    target.colour_ = make_renderbuffer(GL_RGBA8, width, height);
    target.depth_ = make_renderbuffer(GL_DEPTH_COMPONENT32F, width, height);
    target.framebuffer_ = make_framebuffer(target.colour_, target.depth_);
    if (target.framebuffer_.name() == 0)
        return Error{"the driver can't make a picture of " + size +
                     " with 32-bit depth; choose a smaller one"};
    return target;
}

void RenderTarget::begin(ClipDepth clip_depth, const glm::vec3& background) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, width_, height_);
    const GLfloat colour[4] = {background.r, background.g, background.b, 1.0f};
    const GLfloat farthest = clip_depth == ClipDepth::ReversedZeroToOne ? 0.0f : 1.0f;
    glDepthMask(GL_TRUE);
    glClearBufferfv(GL_COLOR, 0, colour);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void RenderTarget::read_depth(std::vector<float>& depths) {
    depths.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    const TargetGuard guard;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width_, height_, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
}

Picture RenderTarget::read_colour() {
    return read_framebuffer(framebuffer_.name(), width_, height_);
}

void RenderTarget::show(int x, int y, int width, int height) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    const bool scaled = width != width_ || height != height_;
    glBlitFramebuffer(0, 0, width_, height_, x, y, x + width, y + height, GL_COLOR_BUFFER_BIT,
                      scaled ? GL_LINEAR : GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

Picture read_window(int width, int height) {
    return read_framebuffer(0, width, height);
}

std::size_t count_missing_pixels(std::span<const float> culled, std::span<const float> reference) {
    RHVIEW_ASSERT(culled.size() == reference.size());
    std::size_t missing = 0;
    for (std::size_t i = 0; i < culled.size(); ++i)
        missing += std::bit_cast<std::uint32_t>(culled[i]) != std::bit_cast<std::uint32_t>(reference[i]);
    return missing;
}

}  // namespace rhview::gl
