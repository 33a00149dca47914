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

QueryStateGuard::QueryStateGuard() {
    for (GLuint i = 0; i < kColourBuffers; ++i) glGetBooleani_v(GL_COLOR_WRITEMASK, i, colour_mask_[i]);
    stencil_test_ = glIsEnabled(GL_STENCIL_TEST) == GL_TRUE;
    depth_clamp_ = glIsEnabled(GL_DEPTH_CLAMP) == GL_TRUE;
    glGetIntegerv(GL_SHADER_STORAGE_BUFFER_BINDING, &storage_buffer_);
    glGetIntegerv(GL_DRAW_INDIRECT_BUFFER_BINDING, &indirect_buffer_);
    glGetIntegerv(GL_COPY_READ_BUFFER_BINDING, &copy_read_buffer_);
    glGetIntegerv(GL_COPY_WRITE_BUFFER_BINDING, &copy_write_buffer_);
    for (GLuint i = 0; i < kStorageBuffers; ++i) {
        glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, i, &storage_[i].name);
        glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, i, &storage_[i].start);
        glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, i, &storage_[i].size);
    }
}

void QueryStateGuard::put_back_raster_state() const {
    for (GLuint i = 0; i < kColourBuffers; ++i)
        glColorMaski(i, colour_mask_[i][0], colour_mask_[i][1], colour_mask_[i][2], colour_mask_[i][3]);
    set_enabled(GL_STENCIL_TEST, stencil_test_);
    set_enabled(GL_DEPTH_CLAMP, depth_clamp_);
}

QueryStateGuard::~QueryStateGuard() {
    put_back_raster_state();
    for (GLuint i = 0; i < kStorageBuffers; ++i) {
        const Storage& storage = storage_[i];
        const auto name = static_cast<GLuint>(storage.name);
        if (storage.size > 0)
            glBindBufferRange(GL_SHADER_STORAGE_BUFFER, i, name, storage.start, storage.size);
        else
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, name);
    }
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(storage_buffer_));
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, static_cast<GLuint>(indirect_buffer_));
    glBindBuffer(GL_COPY_READ_BUFFER, static_cast<GLuint>(copy_read_buffer_));
    glBindBuffer(GL_COPY_WRITE_BUFFER, static_cast<GLuint>(copy_write_buffer_));
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
