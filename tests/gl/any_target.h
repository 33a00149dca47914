// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <vector>

#include "rhview/gl/render_target.h"

namespace rhview::gl {

/// A target of any depth format and number of samples, and its depths: sample after sample.
class AnyTarget {
  public:
    AnyTarget(GLenum depth_format, int samples) : samples_(samples) {
        glGenTextures(1, &depth_);
        glBindTexture(target(), depth_);
        if (samples_ > 1)
            glTexStorage2DMultisample(target(), samples_, depth_format, kWidth, kHeight, GL_TRUE);
        else
            glTexStorage2D(target(), 1, depth_format, kWidth, kHeight);
        glGenFramebuffers(1, &framebuffer_);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glFramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth_, 0);
        EXPECT_EQ(glCheckFramebufferStatus(GL_FRAMEBUFFER), static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
    }
    ~AnyTarget() {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteTextures(1, &depth_);
        glDeleteProgram(program_);
        glDeleteVertexArrays(1, &vertex_array_);
    }
    AnyTarget(const AnyTarget&) = delete;
    AnyTarget& operator=(const AnyTarget&) = delete;

    void begin(ClipDepth depth) const {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glViewport(0, 0, kWidth, kHeight);
        const GLfloat farthest = depth == ClipDepth::ReversedZeroToOne ? 0.0f : 1.0f;
        glClearBufferfv(GL_DEPTH, 0, &farthest);
    }

    /// Copies each sample's depth into `scratch` and reads it there.
    std::vector<float> read(RenderTarget& scratch) {
        std::vector<float> all, one;
        if (program_ == 0) make_program();
        glBindTexture(target(), depth_);
        for (int sample = 0; sample < samples_; ++sample) {
            scratch.begin(ClipDepth::NegativeOneToOne, glm::vec3(0));
            glUseProgram(program_);
            glBindVertexArray(vertex_array_);
            glUniform1i(glGetUniformLocation(program_, "number"), sample);
            glEnable(GL_DEPTH_TEST);
            glDepthFunc(GL_ALWAYS);
            glDrawArrays(GL_TRIANGLES, 0, 3);
            scratch.read_depth(one);
            all.insert(all.end(), one.begin(), one.end());
        }
        glUseProgram(0);
        glBindVertexArray(0);
        glDisable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        return all;
    }

  private:
    static constexpr int kWidth = 160, kHeight = 120;

    [[nodiscard]] GLenum target() const { return samples_ > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D; }

    void make_program() {
        const char* const vertex =
            "#version 430 core\nvoid main() {"
            "gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1);}";
        const char* const multi =
            "#version 430 core\nuniform sampler2DMS image; uniform int number;"
            "void main() { gl_FragDepth = texelFetch(image, ivec2(gl_FragCoord.xy), number).r; }";
        const char* const single =
            "#version 430 core\nuniform sampler2D image; uniform int number;"
            "void main() { gl_FragDepth = texelFetch(image, ivec2(gl_FragCoord.xy), number).r; }";
        program_ = glCreateProgram();
        for (const auto& [stage, source] :
             {std::pair{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, samples_ > 1 ? multi : single}}) {
            const GLuint shader = glCreateShader(static_cast<GLenum>(stage));
            glShaderSource(shader, 1, &source, nullptr);
            glCompileShader(shader);
            glAttachShader(program_, shader);
            glDeleteShader(shader);
        }
        glLinkProgram(program_);
        glGenVertexArrays(1, &vertex_array_);
    }

    int samples_;
    GLuint framebuffer_ = 0, depth_ = 0, program_ = 0, vertex_array_ = 0;
};

}  // namespace rhview::gl
