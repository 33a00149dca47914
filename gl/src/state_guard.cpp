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

StateGuard::StateGuard()
    : clip_control_(epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control")) {
    glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array_);
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
    glCullFace(static_cast<GLenum>(cull_face_mode_));
    glFrontFace(static_cast<GLenum>(front_face_));
    glDepthFunc(static_cast<GLenum>(depth_function_));
    glDepthMask(depth_mask_);
    set_enabled(GL_CULL_FACE, cull_face_);
    set_enabled(GL_DEPTH_TEST, depth_test_);
    if (clip_control_) glClipControl(static_cast<GLenum>(clip_origin_), static_cast<GLenum>(clip_depth_));
    for (GLuint i = 0; i < 2; ++i) glVertexAttrib4fv(i + 1, attributes_[i]);
}

}  // namespace rhview::gl
