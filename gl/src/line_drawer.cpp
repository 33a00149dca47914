// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/line_drawer.h"

#include <epoxy/gl.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "program.h"
#include "state_guard.h"

namespace rhview::gl {
namespace {

constexpr const char* kVertexShader = R"(#version 430 core
layout(location = 0) in vec4 clip;
void main() { gl_Position = clip; }
)";

constexpr const char* kFragmentShader = R"(#version 430 core
uniform vec3 colour;
layout(location = 0) out vec4 pixel;
void main() { pixel = vec4(colour, 1.0); }
)";

/// Edges of a cube whose corner i has x, y, z from bits 0, 1, 2 of i.
constexpr int kEdges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                               {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

}  // namespace

void Lines::add_box(const Aabb& box, const glm::dvec3& origin) {
    const auto corner = [&](int i) {
        return origin + glm::dvec3((i & 1 ? box.max : box.min).x, (i & 2 ? box.max : box.min).y,
                                   (i & 4 ? box.max : box.min).z);
    };
    for (const auto& edge : kEdges) {
        points.push_back(corner(edge[0]));
        points.push_back(corner(edge[1]));
    }
}

void Lines::add_frustum(const View& view, double reach) {
    const glm::dmat4 relative_from_clip = glm::inverse(view.clip_from_eye_relative());
    const glm::dvec3 eye = view.eye();
    const double near = view.clip_depth == ClipDepth::NegativeOneToOne    ? -1.0
                        : view.clip_depth == ClipDepth::ReversedZeroToOne ? 1.0
                                                                          : 0.0;
    glm::dvec3 tips[4];
    for (int i = 0; i < 4; ++i) {
        // The near corner's direction serves any far plane, one at infinity too.
        const glm::dvec4 corner =
            relative_from_clip * glm::dvec4(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, near, 1.0);
        tips[i] = eye + reach * glm::normalize(glm::dvec3(corner) / corner.w);
        points.push_back(eye);
        points.push_back(tips[i]);
    }
    for (const auto& edge : {std::pair{0, 1}, {1, 3}, {3, 2}, {2, 0}}) {
        points.push_back(tips[edge.first]);
        points.push_back(tips[edge.second]);
    }
}

Result<LineDrawer> LineDrawer::create() {
    Result<Program> program = link_program(kVertexShader, kFragmentShader);
    if (!program) return program.error();
    const StateGuard guard(has_clip_control());
    LineDrawer drawer;
    drawer.program_ = std::move(program).value();
    drawer.colour_ = glGetUniformLocation(drawer.program_.name(), "colour");
    GLuint name = 0;
    glGenBuffers(1, &name);
    drawer.buffer_ = Buffer(name);
    glGenVertexArrays(1, &name);
    drawer.vertex_array_ = VertexArray(name);
    glBindVertexArray(name);
    glBindBuffer(GL_ARRAY_BUFFER, drawer.buffer_.name());
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
    return drawer;
}

void LineDrawer::draw(const Lines& lines, const View& view, const glm::vec3& colour) {
    const StateGuard guard(has_clip_control());
    const glm::dmat4 clip = view.clip_from_eye_relative();
    const glm::dvec3 eye = view.eye();
    std::vector<glm::vec4> vertices;
    vertices.reserve(lines.points.size());
    for (const glm::dvec3& point : lines.points) {
        glm::dvec4 position = clip * glm::dvec4(point - eye, 1.0);
        position.z = 0.0;  // always between near and far
        vertices.emplace_back(position);
    }
    glDisable(GL_DEPTH_TEST);
    glUseProgram(program_.name());
    glUniform3f(colour_, colour.r, colour.g, colour.b);
    glBindVertexArray(vertex_array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(glm::vec4)),
                 vertices.data(), GL_STREAM_DRAW);
    glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(vertices.size()));
}

}  // namespace rhview::gl
