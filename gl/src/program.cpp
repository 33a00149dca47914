// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "program.h"

#include <epoxy/gl.h>

#include <initializer_list>
#include <string>

namespace rhview::gl {
namespace {

GLuint compile(GLenum stage, const char* source, std::string& log) {
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE) return shader;
    log.resize(4096);
    GLsizei length = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    glDeleteShader(shader);
    return 0;
}

/// Takes the shaders.
Result<Program> link(std::initializer_list<GLuint> shaders) {
    Program program(glCreateProgram());
    for (const GLuint shader : shaders) glAttachShader(program.name(), shader);
    glLinkProgram(program.name());
    for (const GLuint shader : shaders) glDeleteShader(shader);
    GLint ok = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
    if (ok != GL_TRUE) return Error{"the driver did not link the shaders"};
    return program;
}

}  // namespace

void delete_handle(HandleKind kind, std::uint32_t name) {
    switch (kind) {
        case HandleKind::Buffer:
            return glDeleteBuffers(1, &name);
        case HandleKind::VertexArray:
            return glDeleteVertexArrays(1, &name);
        case HandleKind::Program:
            return glDeleteProgram(name);
        case HandleKind::Framebuffer:
            return glDeleteFramebuffers(1, &name);
        case HandleKind::Renderbuffer:
            return glDeleteRenderbuffers(1, &name);
        case HandleKind::Query:
            return glDeleteQueries(1, &name);
    }
}

void delete_fence(void* sync) {
    glDeleteSync(static_cast<GLsync>(sync));
}

Result<Program> link_program(const char* vertex_source, const char* fragment_source) {
    std::string log;
    const GLuint vertex = compile(GL_VERTEX_SHADER, vertex_source, log);
    if (vertex == 0) return Error{"the driver refused a vertex shader: " + log};
    const GLuint fragment = compile(GL_FRAGMENT_SHADER, fragment_source, log);
    if (fragment == 0) {
        glDeleteShader(vertex);
        return Error{"the driver refused a fragment shader: " + log};
    }
    return link({vertex, fragment});
}

Result<Program> link_compute_program(const char* source) {
    std::string log;
    const GLuint shader = compile(GL_COMPUTE_SHADER, source, log);
    if (shader == 0) return Error{"the driver refused a compute shader: " + log};
    return link({shader});
}

}  // namespace rhview::gl
