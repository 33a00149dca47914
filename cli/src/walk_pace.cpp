// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "walk_pace.h"

#include <fmt/format.h>

#include <algorithm>

namespace rhview::cli {
namespace {

double seconds_of(const CameraPath& path) {
    return path.keys.back().time_s - path.keys.front().time_s;
}

}  // namespace

WalkPace::WalkPace(const CameraPath& path, const WalkOptions& options)
    : path_(path),
      frames_(options.frames),
      rate_hz_(options.rate_hz),
      excerpts_(std::clamp(options.excerpts, 1, options.frames)),
      excerpt_frames_((options.frames + excerpts_ - 1) / excerpts_) {}

/// The first begins where the path does, the last ends where it ends.
double WalkPace::start_of(int excerpt) const {
    const double length = (excerpt_frames_ - 1) / *rate_hz_;
    const double latest = std::max(seconds_of(path_) - length, 0.0);
    return path_.keys.front().time_s + (excerpts_ == 1 ? 0.0 : latest * excerpt / (excerpts_ - 1));
}

double WalkPace::time_of(int frame) const {
    if (!rate_hz_) return path_.time_of_frame(frame, frames_);
    return start_of(frame / excerpt_frames_) + frame % excerpt_frames_ / *rate_hz_;
}

View WalkPace::view_of(int frame, double aspect, ClipDepth clip_depth) const {
    return path_.view_at(time_of(frame), aspect, clip_depth);
}

double WalkPace::longest_step_s() const {
    if (rate_hz_) return 1.0 / *rate_hz_;
    double most = 0.0;
    for (int frame = 1; frame < frames_; ++frame) most = std::max(most, time_of(frame) - time_of(frame - 1));
    return most;
}

Status check_pace(const CameraPath& path, const WalkOptions& options) {
    if (!options.rate_hz) {
        if (options.excerpts == 1) return success();
        return Error{"--excerpts needs --rate: without it the frames are spread over all of the path"};
    }
    if (options.excerpts > options.frames)
        return Error{fmt::format("--excerpts: {} of {} frames in all; ask for at least as many --frames",
                                 options.excerpts, options.frames)};
    const double wanted = options.frames / *options.rate_hz;
    if (wanted <= seconds_of(path)) return success();
    return Error{
        fmt::format("--rate: {} frames at {} a second take {:.1f} s, the path has {:.1f}; ask for "
                    "fewer --frames",
                    options.frames, *options.rate_hz, wanted, seconds_of(path))};
}

}  // namespace rhview::cli
