// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "device_objects.h"

#include <epoxy/gl.h>

namespace rhview {
namespace {

/// One that was deleted counts as gone: Mesa keeps the program that was drawn with last.
bool is_program(GLuint name) {
    if (glIsProgram(name) == GL_FALSE) return false;
    GLint deleted = GL_FALSE;
    glGetProgramiv(name, GL_DELETE_STATUS, &deleted);
    return deleted == GL_FALSE;
}

}  // namespace

DeviceObjects count_device_objects(std::uint32_t names) {
    DeviceObjects found;
    for (GLuint name = 1; name < names; ++name) {
        found.buffers += glIsBuffer(name) != 0;
        found.vertex_arrays += glIsVertexArray(name) != 0;
        found.programs += is_program(name);
        found.framebuffers += glIsFramebuffer(name) != 0;
        found.renderbuffers += glIsRenderbuffer(name) != 0;
        found.queries += glIsQuery(name) != 0;
        found.textures += glIsTexture(name) != 0;
    }
    return found;
}

}  // namespace rhview
