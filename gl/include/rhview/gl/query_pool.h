// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Occlusion queries in flight: objects that are used again and again, and answers that are asked for, never
/// waited for.
#pragma once

#include <cstdint>
#include <vector>

#include "rhview/gl/handle.h"
#include "rhview/occlusion_queries/query.h"

namespace rhview::gl {

/// Of everything that was asked.
struct AnswerCounters {
    std::uint64_t asked = 0;
    std::uint64_t answered = 0;        ///< lost ones not counted
    std::uint64_t lost = 0;            ///< given up, answered as visible
    std::uint64_t blocking_reads = 0;  ///< results that were read before the device said they are there
};

/// Query objects: begun, polled, used again.
class QueryPool {
  public:
    /// Whether the result of a query is there; if so, sets `samples`. May not wait.
    using Poll = bool (*)(std::uint32_t name, std::uint64_t& samples);
    /// The `Poll` that asks OpenGL.
    static bool poll_device(std::uint32_t name, std::uint64_t& samples);

    /// A query that has no answer after that many frames is given up. Tests bring their own `poll_query`.
    explicit QueryPool(std::uint32_t lost_after_frames = 64, Poll poll_query = &poll_device);

    void begin_frame() { ++frame_; }
    /// Starts a query: GL_SAMPLES_PASSED if it counts, else GL_ANY_SAMPLES_PASSED_CONSERVATIVE, neither of
    /// which may be active. Returns its OpenGL name, valid for conditional rendering until the next frame.
    std::uint32_t begin(std::uint64_t ticket, bool counts_samples);
    /// Ends the query that was begun.
    void end();

    /// Appends the answers that have come, and those given up; asks the device for no result that it does
    /// not have. Cost: an API call per query that has its answer, and one more.
    void poll(std::vector<QueryAnswer>& answers);
    /// Appends the answers of all queries in flight: waits, and counts what it waited for. For tools; no
    /// frame needs it.
    void wait(std::vector<QueryAnswer>& answers);

    [[nodiscard]] std::size_t in_flight() const { return in_flight_.size(); }
    [[nodiscard]] std::size_t objects() const {
        return in_flight_.size() + free_[0].size() + free_[1].size();
    }
    [[nodiscard]] const AnswerCounters& counters() const { return counters_; }

  private:
    struct InFlight {
        Query query;
        std::uint64_t ticket = 0;
        std::uint64_t frame = 0;
        bool counts_samples = false;
    };

    /// Answers a query as its result or, where it is lost, as visible; then its object is free again.
    void answer(InFlight& query, std::uint64_t samples, std::vector<QueryAnswer>& answers);
    void give_up(InFlight& query, std::vector<QueryAnswer>& answers);

    std::uint32_t lost_after_frames_;
    Poll poll_;
    std::uint64_t frame_ = 0;
    std::vector<InFlight> in_flight_;  ///< oldest first
    std::vector<Query> free_[2];       ///< an object keeps the kind of its first query: any, counting
    AnswerCounters counters_;
};

}  // namespace rhview::gl
