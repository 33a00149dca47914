// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "rhview/occlusion_queries/query.h"
#include "uniform.h"

namespace rhview {

/// How a fake device sends its answers.
struct FakeGpuHabits {
    std::uint32_t latency = 1;         ///< frames: 1 is before the next one is planned
    std::uint32_t latency_spread = 0;  ///< up to so many more, at random
    double lost = 0.0;                 ///< part of the answers that never come
    double duplicated = 0.0;           ///< part that come twice
    bool shuffled = false;             ///< those of a frame in random order
    std::uint32_t seed = 1;
};

/// A device without graphics: whoever knows the truth tells it each query's exact answer, and it hands the
/// answers out when, and as often as, its habits say.
class FakeGpu {
  public:
    explicit FakeGpu(const FakeGpuHabits& habits = {}) : habits_(habits), random_(habits.seed) {}

    void ask(const QueryAnswer& answer) {
        ++asked_;
        if (random_(0, 1) < habits_.lost) {
            ++lost_;
            return;
        }
        send(answer);
        if (random_(0, 1) < habits_.duplicated) {
            ++duplicated_;
            send(answer);
        }
    }
    /// The next frame begins: the answers that have come.
    std::span<const QueryAnswer> next_frame() {
        ++frame_;
        due_.clear();
        std::size_t kept = 0;
        for (const OnTheWay& answer : on_the_way_) {
            if (answer.frame <= frame_) {
                due_.push_back(answer.answer);
            } else {
                on_the_way_[kept++] = answer;
            }
        }
        on_the_way_.resize(kept);
        if (habits_.shuffled) shuffle();
        return due_;
    }
    [[nodiscard]] std::uint64_t asked() const { return asked_; }
    [[nodiscard]] std::uint64_t lost() const { return lost_; }
    [[nodiscard]] std::uint64_t duplicated() const { return duplicated_; }

  private:
    struct OnTheWay {
        std::uint64_t frame = 0;
        QueryAnswer answer;
    };

    void send(const QueryAnswer& answer) {
        const auto late = static_cast<std::uint64_t>(random_(0, habits_.latency_spread + 1.0));
        on_the_way_.push_back({frame_ + std::max(habits_.latency, 1u) + late, answer});
    }
    void shuffle() {
        for (std::size_t i = due_.size(); i > 1; --i) {
            std::swap(due_[i - 1], due_[static_cast<std::size_t>(random_(0, static_cast<double>(i)))]);
        }
    }

    FakeGpuHabits habits_;
    Uniform random_;
    std::vector<OnTheWay> on_the_way_;
    std::vector<QueryAnswer> due_;
    std::uint64_t frame_ = 0;
    std::uint64_t asked_ = 0, lost_ = 0, duplicated_ = 0;
};

}  // namespace rhview
