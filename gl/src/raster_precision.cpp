// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "raster_precision.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

namespace rhview::gl {
namespace {

/// Step of the bound framebuffer's depth; 0 if it is a floating-point one, or there is none.
double depth_step() {
    GLint framebuffer = 0, type = GL_NONE, bits = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    const GLenum attachment = framebuffer == 0 ? GL_DEPTH : GL_DEPTH_ATTACHMENT;
    const auto read = [&](GLenum name, GLint& value) {
        glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, name, &value);
    };
    read(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, type);
    if (type == GL_NONE) return 0.0;
    read(GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, type);
    if (type == GL_FLOAT) return 0.0;
    read(GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE, bits);
    return std::exp2(-bits);
}

}  // namespace

int subpixel_bits() {
    GLint bits = 0;
    glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
    return std::max(bits, 1);
}

RasterPrecision bound_raster_precision(int subpixel_bits) {
    GLint viewport[4] = {};
    glGetIntegerv(GL_VIEWPORT, viewport);
    return {std::max(viewport[2], 1), std::max(viewport[3], 1), subpixel_bits, depth_step()};
}

}  // namespace rhview::gl
