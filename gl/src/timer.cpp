// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/timer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

#include "program.h"
#include "rhview/gl/context.h"
#include "rhview/gl/render_target.h"
#include "state_guard.h"

namespace rhview::gl {
namespace {

// Every triangle lies beyond the far plane: nothing but vertex work.
constexpr const char* kVertexShader = R"(#version 430 core
void main() {
    float x = float(gl_VertexID);
    for (int i = 0; i < 8; ++i) x = fract(x * 1.618 + 0.1);
    gl_Position = vec4(x, -x, 2.0, 1.0);
}
)";

constexpr const char* kFragmentShader = R"(#version 430 core
layout(location = 0) out vec4 pixel;
void main() { pixel = vec4(1.0); }
)";

constexpr double kWantedMs = 20.0;

struct Measurement {
    double wall_ms = 0.0;
    double gpu_ms = 0.0;
};

Measurement measure(GLsizei vertices) {
    GpuTimer timer;
    finish();
    const WallTimer wall;
    timer.begin();
    glDrawArrays(GL_TRIANGLES, 0, vertices);
    timer.end();
    finish();
    Measurement result;
    result.wall_ms = wall.elapsed_ms();
    result.gpu_ms = timer.read_ms();
    return result;
}

}  // namespace

GpuTimer::GpuTimer() {
    GLuint name = 0;
    glGenQueries(1, &name);
    query_ = Query(name);
}

void GpuTimer::begin() {
    glBeginQuery(GL_TIME_ELAPSED, query_.name());
}

void GpuTimer::end() {
    glEndQuery(GL_TIME_ELAPSED);
}

double GpuTimer::read_ms() {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_.name(), GL_QUERY_RESULT, &nanoseconds);
    return static_cast<double>(nanoseconds) * 1e-6;
}

Result<TimerCheck> check_gpu_timer() {
    Result<Program> program = link_program(kVertexShader, kFragmentShader);
    if (!program) return program.error();
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    const VertexArray vertex_array(name);
    const TargetGuard target_guard;
    Result<RenderTarget> target = RenderTarget::create(16, 16);
    if (!target) return target.error();
    target->begin(ClipDepth::NegativeOneToOne, glm::vec3(0.0f));
    const StateGuard guard(has_clip_control());
    glUseProgram(program->name());
    glBindVertexArray(name);
    GLsizei vertices = 30'000;
    measure(vertices);
    while (measure(vertices).wall_ms < kWantedMs && vertices < 900'000'000) vertices *= 3;
    std::array<double, 5> shares{};
    for (double& share : shares) {
        const Measurement m = measure(vertices);
        share = m.gpu_ms / m.wall_ms;
    }
    std::ranges::sort(shares);
    return TimerCheck{shares[shares.size() / 2]};
}

}  // namespace rhview::gl
