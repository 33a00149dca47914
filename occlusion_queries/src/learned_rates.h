// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstdint>

namespace rhview {

/// A probability learned from yes and no: the mean of a Beta distribution whose evidence fades. Answers are
/// collected and taken in together, so that their order doesn't matter.
class LearnedProbability {
  public:
    /// The prior weighs as much as `prior_answers`.
    LearnedProbability(double prior, double prior_answers, double memory)
        : prior_(prior), prior_answers_(prior_answers), memory_(memory) {}

    void add(bool yes) { ++(yes ? new_yes_ : new_no_); }
    void add(double yes, double no) {
        new_yes_ += yes;
        new_no_ += no;
    }
    void take_in() {
        const double count = new_yes_ + new_no_;
        if (count == 0.0) return;
        const double kept = memory_ / (memory_ + count);
        yes_ = kept * yes_ + new_yes_ * std::min(1.0, memory_ / count);
        no_ = kept * no_ + new_no_ * std::min(1.0, memory_ / count);
        new_yes_ = new_no_ = 0.0;
    }
    [[nodiscard]] double mean() const {
        return std::clamp((prior_ * prior_answers_ + yes_) / (prior_answers_ + yes_ + no_), kLeast,
                          1.0 - kLeast);
    }

  private:
    /// Away from 0 and 1: a learned certainty would never be questioned again.
    static constexpr double kLeast = 1e-3;

    double prior_;
    double prior_answers_;
    double memory_;
    double yes_ = 0.0, no_ = 0.0;
    double new_yes_ = 0.0, new_no_ = 0.0;
};

/// How long items stay as they are, in frames: events over exposure, one prior event, fading.
class LearnedDuration {
  public:
    LearnedDuration(double prior_frames, double memory) : prior_frames_(prior_frames), memory_(memory) {}

    /// It was looked at after `frames` and had turned, or not.
    void add(bool turned, double frames) {
        new_turned_ += turned ? 1.0 : 0.0;
        new_frames_ += frames;
    }
    void take_in() {
        if (new_frames_ <= 0.0) return;
        const double kept = memory_ / (memory_ + new_frames_);
        const double weight = std::min(1.0, memory_ / new_frames_);
        turned_ = kept * turned_ + weight * new_turned_;
        frames_ = kept * frames_ + weight * new_frames_;
        new_turned_ = new_frames_ = 0.0;
    }
    [[nodiscard]] double mean_frames() const { return (prior_frames_ + frames_) / (1.0 + turned_); }

  private:
    double prior_frames_;
    double memory_;
    double turned_ = 0.0, frames_ = 0.0;
    double new_turned_ = 0.0, new_frames_ = 0.0;
};

}  // namespace rhview
