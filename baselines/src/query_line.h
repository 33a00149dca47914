// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <vector>

namespace rhview {

/// Queries that wait for their answers, oldest first. Keeps its memory.
template <class Waiting>
class QueryLine {
  public:
    [[nodiscard]] bool empty() const { return next_ == waiting_.size(); }
    [[nodiscard]] const Waiting& front() const { return waiting_[next_]; }
    void push(const Waiting& waiting) { waiting_.push_back(waiting); }
    Waiting pop() {
        const Waiting first = waiting_[next_++];
        // Now and then what has gone makes room, so that a line that never empties does not grow.
        if (2 * next_ > waiting_.size() + 64 || empty()) {
            waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(next_));
            next_ = 0;
        }
        return first;
    }

  private:
    std::vector<Waiting> waiting_;
    std::size_t next_ = 0;
};

}  // namespace rhview
