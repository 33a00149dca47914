// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/work_counter.h"

#include <epoxy/gl.h>

#include "rhview/base/assert.h"

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
    for (Part& part : parts_) part = {make_query(), make_query(), make_query()};
}

void WorkCounter::begin_part() {
    const Part& part = parts_[used_++];
    glBeginQuery(GL_CLIPPING_OUTPUT_PRIMITIVES_ARB, part.primitives.name());
    glBeginQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB, part.fragments.name());
    glBeginQuery(GL_SAMPLES_PASSED, part.samples.name());
}

void WorkCounter::end_part() {
    glEndQuery(GL_CLIPPING_OUTPUT_PRIMITIVES_ARB);
    glEndQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB);
    glEndQuery(GL_SAMPLES_PASSED);
}

void WorkCounter::begin() {
    used_ = 0;
    if (available_) begin_part();
}

void WorkCounter::pause() {
    if (available_) end_part();
}

void WorkCounter::resume() {
    RHVIEW_ASSERT(!available_ || used_ < parts_.size());
    if (available_) begin_part();
}

void WorkCounter::end() {
    if (available_) end_part();
}

void WorkCounter::read(Work& work) {
    if (!available_) return;
    work.primitives = work.fragments = work.passed_samples = 0.0;
    for (std::size_t i = 0; i < used_; ++i) {
        work.primitives += result_of(parts_[i].primitives);
        work.fragments += result_of(parts_[i].fragments);
        work.passed_samples += result_of(parts_[i].samples);
    }
}

}  // namespace rhview::gl
