// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/work_counter.h"

#include <epoxy/gl.h>

namespace rhview::gl {
namespace {

Query make_query() {
    GLuint name = 0;
    glGenQueries(1, &name);
    return Query(name);
}

double result_of(const Query& query) {
    GLuint64 count = 0;
    glGetQueryObjectui64v(query.name(), GL_QUERY_RESULT, &count);
    return static_cast<double>(count);
}

}  // namespace

Work work_of(const FrameCounters& counters) {
    Work work;
    work.indices = static_cast<double>(counters.indices);
    work.draw_calls = static_cast<double>(counters.draw_calls);
    work.sub_draws = static_cast<double>(counters.sub_draws);
    work.material_changes = static_cast<double>(counters.material_changes);
    return work;
}

WorkCounter::WorkCounter()
    : available_(epoxy_gl_version() >= 46 || epoxy_has_gl_extension("GL_ARB_pipeline_statistics_query")) {
    if (!available_) return;
    primitives_ = make_query();
    fragments_ = make_query();
    samples_ = make_query();
}

void WorkCounter::begin() {
    if (!available_) return;
    glBeginQuery(GL_CLIPPING_OUTPUT_PRIMITIVES_ARB, primitives_.name());
    glBeginQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB, fragments_.name());
    glBeginQuery(GL_SAMPLES_PASSED, samples_.name());
}

void WorkCounter::end() {
    if (!available_) return;
    glEndQuery(GL_CLIPPING_OUTPUT_PRIMITIVES_ARB);
    glEndQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB);
    glEndQuery(GL_SAMPLES_PASSED);
}

void WorkCounter::read(Work& work) {
    if (!available_) return;
    work.primitives = result_of(primitives_);
    work.fragments = result_of(fragments_);
    work.passed_samples = result_of(samples_);
}

}  // namespace rhview::gl
