// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "state_guard.h"

#include <epoxy/gl.h>

namespace rhview::gl {
namespace {

void set_enabled(GLenum capability, bool enabled) {
    enabled ? glEnable(capability) : glDisable(capability);
}

}  // namespace

bool has_clip_control() {
    return epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control");
}

StateGuard::StateGuard(bool clip_control) : clip_control_(clip_control) {
    glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array_);
    glGetIntegerv(GL_ARRAY_BUFFER_BINDING, &array_buffer_);
    glGetIntegerv(GL_CULL_FACE_MODE, &cull_face_mode_);
    glGetIntegerv(GL_FRONT_FACE, &front_face_);
    glGetIntegerv(GL_DEPTH_FUNC, &depth_function_);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
    cull_face_ = glIsEnabled(GL_CULL_FACE) == GL_TRUE;
    depth_test_ = glIsEnabled(GL_DEPTH_TEST) == GL_TRUE;
    if (clip_control_) {
        glGetIntegerv(GL_CLIP_ORIGIN, &clip_origin_);
        glGetIntegerv(GL_CLIP_DEPTH_MODE, &clip_depth_);
    }
    for (GLuint i = 0; i < 2; ++i) glGetVertexAttribfv(i + 1, GL_CURRENT_VERTEX_ATTRIB, attributes_[i]);
}

StateGuard::~StateGuard() {
    glUseProgram(static_cast<GLuint>(program_));
    glBindVertexArray(static_cast<GLuint>(vertex_array_));
    glBindBuffer(GL_ARRAY_BUFFER, static_cast<GLuint>(array_buffer_));
    glCullFace(static_cast<GLenum>(cull_face_mode_));
    glFrontFace(static_cast<GLenum>(front_face_));
    glDepthFunc(static_cast<GLenum>(depth_function_));
    glDepthMask(depth_mask_);
    set_enabled(GL_CULL_FACE, cull_face_);
    set_enabled(GL_DEPTH_TEST, depth_test_);
    if (clip_control_) glClipControl(static_cast<GLenum>(clip_origin_), static_cast<GLenum>(clip_depth_));
    for (GLuint i = 0; i < 2; ++i) glVertexAttrib4fv(i + 1, attributes_[i]);
}

TargetGuard::TargetGuard() {
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
    glGetIntegerv(GL_RENDERBUFFER_BINDING, &renderbuffer_);
    glGetIntegerv(GL_PACK_ALIGNMENT, &pack_alignment_);
    glGetIntegerv(GL_VIEWPORT, viewport_);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
}

TargetGuard::~TargetGuard() {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
    glBindRenderbuffer(GL_RENDERBUFFER, static_cast<GLuint>(renderbuffer_));
    glPixelStorei(GL_PACK_ALIGNMENT, pack_alignment_);
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    glDepthMask(depth_mask_);
}

}  // namespace rhview::gl
