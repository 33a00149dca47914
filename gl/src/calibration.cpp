// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace rhview::gl {
namespace {

constexpr double kProbeIndices = 2e5;
constexpr int kProbeFrames = 7;

DesignOptions design_options(const CalibrationSubject& subject, const CalibrationOptions& options,
                             const RenderTarget& target) {
    DesignOptions design;
    design.seed = options.seed;
    design.fov_y_deg = subject.fov_y_deg;
    design.near_m = subject.near_m;
    design.far_m = subject.far_m;
    design.aspect = static_cast<double>(target.width()) / target.height();
    design.clip_depth = options.clip_depth;
    return design;
}

/// Nanoseconds per index of frames of one size, few calls: the median, to know how large frames may be.
Result<double> probe(const CalibrationSubject& subject, Executor& executor, RenderTarget& target,
                     DesignOptions design) {
    design.frames = kProbeFrames;
    design.most_indices = kProbeIndices;
    design.most_whole_view_indices = -1.0;
    design.most_draw_calls = 1.0;
    design.multi_draw = design.queries = false;
    std::vector<ExperimentFrame> frames = design_experiment(*subject.scene, subject.static_indices, design);
    ExperimentOptions once;
    once.rounds = 1;
    const Result<std::vector<FrameTiming>> timings =
        run_experiment(frames, *subject.buffers, executor, target, once);
    if (!timings) return timings.error();
    std::vector<double> prices;
    for (const FrameTiming& timing : *timings)
        if (timing.work.indices > 0.1 * kProbeIndices)
            prices.push_back(timing.frame_ns / timing.work.indices);
    if (prices.empty()) {
        const FrameTiming& largest =
            *std::ranges::max_element(*timings, {}, [](const FrameTiming& t) { return t.work.indices; });
        prices.push_back(largest.frame_ns / std::max(1.0, largest.work.indices));
    }
    std::ranges::sort(prices);
    return prices[prices.size() / 2];
}

Status measure(const CalibrationSubject& subject, Executor& executor, RenderTarget& target,
               const CalibrationOptions& options, std::size_t subject_count, std::size_t number,
               Calibration& calibration) {
    DesignOptions design = design_options(subject, options, target);
    const Result<double> ns_per_index = probe(subject, executor, target, design);
    if (!ns_per_index) return ns_per_index.error();
    calibration.ns_per_index_probed = std::max(calibration.ns_per_index_probed, *ns_per_index);
    design.frames = std::max(1, options.frames / static_cast<int>(subject_count));
    design.seed = options.seed + static_cast<std::uint32_t>(number);
    design.most_indices = 1e6 * options.largest_frame_ms / *ns_per_index;
    design.most_whole_view_indices =
        0.5e9 * options.longest_s / (static_cast<double>(subject_count) * *ns_per_index);
    ExperimentOptions experiment;
    experiment.rounds = options.rounds;
    experiment.longest_s = options.longest_s / static_cast<double>(subject_count);
    experiment.shuffle = design.seed;
    experiment.use_gpu_timer = calibration.timer.gpu_timer_is_whole();
    if (options.progress)
        experiment.progress = [&](int done, int total) {
            options.progress(static_cast<int>(number) * total + done,
                             static_cast<int>(subject_count) * total);
        };
    const Result<std::vector<FrameTiming>> timings =
        run_experiment(design_experiment(*subject.scene, subject.static_indices, design), *subject.buffers,
                       executor, target, experiment);
    if (!timings) return timings.error();
    calibration.timings.insert(calibration.timings.end(), timings->begin(), timings->end());
    return success();
}

std::string why_the_wall_clock(const TimerCheck& check) {
    const double percent = 100.0 * check.gpu_share;
    if (check.gpu_timer_is_whole())
        return fmt::format(
            "a frame is done when all of it is; the GPU timer agrees (it reports {:.0f} % of the wall clock) "
            "and is recorded beside",
            percent);
    return fmt::format("the GPU timer reports {:.1f} % of what the wall clock sees of vertex work: not used",
                       percent);
}

/// Frames of one design point of several subjects must not share a fold: a stride that mixes them.
std::vector<Sample> mixed(const std::vector<Sample>& samples) {
    std::vector<Sample> result;
    constexpr std::size_t kStride = 7;
    for (std::size_t start = 0; start < kStride; ++start)
        for (std::size_t i = start; i < samples.size(); i += kStride) result.push_back(samples[i]);
    return result;
}

/// The kept model fitted to each whole round on its own.
std::vector<Fit> fits_of_rounds(const Calibration& calibration) {
    std::vector<Term> terms;
    for (const Coefficient& c : calibration.selection.fit.coefficients) terms.push_back(c.term);
    FitOptions options;
    options.combination = calibration.selection.fit.combination;
    std::size_t rounds = SIZE_MAX;
    for (const FrameTiming& timing : calibration.timings) rounds = std::min(rounds, timing.round_ns.size());
    std::vector<Fit> fits;
    for (std::size_t round = 0; round < rounds; ++round) {
        std::vector<Sample> samples;
        for (const FrameTiming& timing : calibration.timings)
            samples.push_back({timing.work, timing.round_ns[round]});
        Result<Fit> fit = fit_terms(samples, terms, options);
        if (fit) fits.push_back(std::move(fit).value());
    }
    return fits;
}

}  // namespace

Result<Calibration> calibrate(std::span<const CalibrationSubject> subjects, const DeviceInfo& device,
                              Executor& executor, RenderTarget& target, const CalibrationOptions& options) {
    RHVIEW_ASSERT(!subjects.empty());
    const WallTimer clock;
    Calibration calibration;
    const Result<TimerCheck> timer = check_gpu_timer();
    if (!timer) return timer.error();
    calibration.timer = *timer;
    for (std::size_t i = 0; i < subjects.size(); ++i)
        if (Status status = measure(subjects[i], executor, target, options, subjects.size(), i, calibration);
            !status)
            return status.error();

    Result<Selection> selection = select_model(mixed(samples_of(calibration.timings)));
    if (!selection) return Error{"the timing model could not be fitted: " + selection.error().message};
    calibration.selection = std::move(selection).value();
    add_scatter(calibration.selection.fit, fits_of_rounds(calibration));
    constexpr std::array kCore{Term::Constant, Term::Indices, Term::DrawCalls};
    Result<Fit> submission = fit_terms(samples_of(calibration.timings, TimedPart::Submission), kCore);
    if (submission) calibration.submission = std::move(submission).value();

    calibration.profile = make_profile(calibration.selection.fit);
    calibration.profile.renderer = device.renderer;
    calibration.profile.version = device.version;
    calibration.profile.timer_name = "wall";
    calibration.profile.timer_why = why_the_wall_clock(calibration.timer);
    calibration.seconds = 1e-3 * clock.elapsed_ms();
    return calibration;
}

}  // namespace rhview::gl
