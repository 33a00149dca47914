// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/query_pool.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace rhview::gl {
namespace {

/// Answers come in the order of asking. One that is this late may be lost: look past it.
constexpr std::uint64_t kLateFrames = 4;

GLenum target_of(bool counts_samples) {
    return counts_samples ? GL_SAMPLES_PASSED : GL_ANY_SAMPLES_PASSED_CONSERVATIVE;
}

std::uint64_t read_result(std::uint32_t name) {
    GLuint64 samples = 1;  // stays where a lost context says "available" and writes nothing
    glGetQueryObjectui64v(name, GL_QUERY_RESULT, &samples);
    return samples;
}

}  // namespace

bool QueryPool::poll_device(std::uint32_t name, std::uint64_t& samples) {
    GLuint available = GL_FALSE;
    glGetQueryObjectuiv(name, GL_QUERY_RESULT_AVAILABLE, &available);
    if (available == GL_FALSE) return false;
    samples = read_result(name);
    return true;
}

QueryPool::QueryPool(std::uint32_t lost_after_frames, Poll poll_query)
    : lost_after_frames_(lost_after_frames), poll_(poll_query) {}

std::uint32_t QueryPool::begin(std::uint64_t ticket, bool counts_samples) {
    std::vector<Query>& free = free_[counts_samples ? 1 : 0];
    if (free.empty()) {
        GLuint name = 0;
        glGenQueries(1, &name);
        free.emplace_back(name);
    }
    in_flight_.push_back({std::move(free.back()), ticket, frame_, counts_samples});
    free.pop_back();
    ++counters_.asked;
    const std::uint32_t name = in_flight_.back().query.name();
    glBeginQuery(target_of(counts_samples), name);
    return name;
}

void QueryPool::end() {
    glEndQuery(target_of(in_flight_.back().counts_samples));
}

void QueryPool::answer(InFlight& query, std::uint64_t samples, std::vector<QueryAnswer>& answers) {
    answers.push_back({query.ticket, samples != 0, query.counts_samples ? samples : 0});
    ++counters_.answered;
    free_[query.counts_samples ? 1 : 0].push_back(std::move(query.query));
}

void QueryPool::give_up(InFlight& query, std::vector<QueryAnswer>& answers) {
    answers.push_back({query.ticket, true, 0});
    ++counters_.lost;
    query.query = Query();  // A new object takes its place: this one may never become usable again.
}

void QueryPool::poll(std::vector<QueryAnswer>& answers) {
    std::size_t kept = 0, next = 0;
    for (; next < in_flight_.size(); ++next) {
        InFlight& query = in_flight_[next];
        const std::uint64_t age = frame_ - query.frame;
        std::uint64_t samples = 0;
        if (poll_(query.query.name(), samples)) {
            answer(query, samples, answers);
        } else if (age > lost_after_frames_) {
            give_up(query, answers);
        } else {
            if (age <= kLateFrames) break;
            std::swap(in_flight_[kept++], query);
        }
    }
    std::rotate(in_flight_.begin() + static_cast<std::ptrdiff_t>(kept),
                in_flight_.begin() + static_cast<std::ptrdiff_t>(next), in_flight_.end());
    in_flight_.resize(in_flight_.size() - (next - kept));
}

void QueryPool::wait(std::vector<QueryAnswer>& answers) {
    for (InFlight& query : in_flight_) {
        std::uint64_t samples = 0;
        if (!poll_(query.query.name(), samples)) {
            ++counters_.blocking_reads;
            samples = read_result(query.query.name());
        }
        answer(query, samples, answers);
    }
    in_flight_.clear();
}

}  // namespace rhview::gl
