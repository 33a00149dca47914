// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ctime>
#include <memory>

#include "output_file.h"
#include "picture_size.h"
#include "profile_store.h"
#include "progress.h"
#include "rhview/gl/answer_costs.h"
#include "rhview/gl/calibration.h"
#include "rhview/scenes/static_instances.h"
#include "scene_source.h"
#include "verbs.h"

namespace rhview::cli {
namespace {

/// Voxels, pipes and tori: few and many triangles a pixel, flat and round, near and far from sharing their
/// vertices.
constexpr std::array<const char*, 3> kSubjects{"town:size=400,materials=24", "plant:objects=30000",
                                               "city:blocks=10"};

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    return fmt::format("{:04}-{:02}-{:02}", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday);
}

std::string short_name(Term term) {
    switch (term) {
        case Term::Constant:
            return "c0, a frame";
        case Term::Indices:
            return "c1, an index";
        case Term::DrawCalls:
            return "c3, a draw call";
        case Term::SubDraws:
            return "a range of a call";
        case Term::Fragments:
            return "a fragment shaded";
        case Term::Queries:
            return "a query of these frames";
        case Term::MaterialChanges:
            return "a material change";
        case Term::Primitives:
            return "a triangle in view";
        case Term::PassedSamples:
            return "a sample drawn";
    }
    return "";
}

std::string model_name(const Candidate& candidate) {
    std::string name;
    for (const Term term : candidate.terms)
        name += fmt::format("{}{}", name.empty() ? "" : " + ", name_of(term));
    return name + (candidate.combination == Combination::Sum ? "" : ", max(CPU, GPU)");
}

void print_fit(const Fit& fit) {
    for (const Coefficient& c : fit.coefficients)
        fmt::print("  {:<20}{:>12.4g} ns  ± {:<10.3g} 95 %: {:.4g} to {:.4g}{}\n", short_name(c.term),
                   c.value_ns, c.standard_error_ns, c.low_ns, c.high_ns,
                   c.at_bound ? "  (at the bound: not told from 0)" : "");
}

std::string ratio_text(const Fit& fit) {
    const double c1 = fit.find(Term::Indices)->value_ns;
    double draw = fit.find(Term::DrawCalls)->value_ns;
    if (const Coefficient* sub_draw = fit.find(Term::SubDraws)) draw += sub_draw->value_ns;
    return c1 > 0.0 ? fmt::format("a draw call costs as much as {:.0f} indices", draw / c1)
                    : fmt::format("an index costs nothing that was seen, a draw call {:.4g} ns", draw);
}

void print_answer_costs(const TimingProfile& profile) {
    if (!profile.answer_costs) return;
    const auto print = [](const char* way, const AnswerCosts& c) {
        fmt::print("  {:<20}{:.4g} ns, {:.4g} a box, {:.3g} a pixel, {:.4g} a draw; {:.4g} a frame\n", way,
                   c.query_ns, c.box_ns, c.pixel_ns, c.draw_ns, c.frame_ns);
    };
    fmt::print("\n  to ask whether something is hidden, and hang draws on the answer:\n");
    print("an occlusion query", profile.answer_costs->hardware);
    print("in a box pass", profile.answer_costs->box_pass);
}

void print_calibration(const gl::Calibration& calibration, const gl::DeviceInfo& device,
                       const std::vector<std::string>& subjects) {
    const Fit& fit = calibration.selection.fit;
    const Fit& plain = calibration.selection.plain;
    fmt::print("{}, {}\n", device.renderer, device.version);
    fmt::print("timed by the wall clock: {}\n", calibration.profile.timer_why);
    fmt::print("{} frames of {} in {:.1f} s\n\n", calibration.timings.size(), fmt::join(subjects, ", "),
               calibration.seconds);
    print_fit(fit);
    fmt::print("\n  {}\n", ratio_text(fit));
    fmt::print("  R² {:.4f}; hold-out error {:.1f} % ± {:.1f} %; {} of {} samples are outliers\n",
               fit.r_squared, 100.0 * fit.hold_out_error, 100.0 * fit.hold_out_standard_error, fit.outliers,
               fit.samples);
    fmt::print(
        "\n  the paper's form, T = c1·V + c3·N alone: c1 {:.4g} ns, c3 {:.4g} ns, hold-out error {:.1f} %\n",
        plain.find(Term::Indices)->value_ns, plain.find(Term::DrawCalls)->value_ns,
        100.0 * plain.hold_out_error);
    if (calibration.submission)
        fmt::print(
            "  of a draw call's price the CPU pays {:.4g} ns while it is submitted, of an index's {:.3g} "
            "ns\n",
            calibration.submission->find(Term::DrawCalls)->value_ns,
            calibration.submission->find(Term::Indices)->value_ns);
    print_answer_costs(calibration.profile);
    fmt::print("\n  models tried (hold-out error):\n");
    for (const Candidate& candidate : calibration.selection.candidates) {
        const std::string error = candidate.hold_out_error
                                      ? fmt::format("{:5.1f} %", 100.0 * *candidate.hold_out_error)
                                      : "   -   ";
        fmt::print("  {} {} {}: {}\n", candidate.kept ? "*" : " ", error, model_name(candidate),
                   candidate.note);
    }
}

std::string to_csv(const gl::Calibration& calibration) {
    std::string csv =
        "indices,draw_calls,sub_draws,material_changes,queries,primitives,fragments,passed_samples,"
        "frame_ns,submit_ns,gpu_ns,predicted_ns,rounds\n";
    for (const gl::FrameTiming& t : calibration.timings)
        csv += fmt::format("{},{},{},{},{},{},{},{},{:.0f},{:.0f},{},{:.0f},{}\n", t.work.indices,
                           t.work.draw_calls, t.work.sub_draws, t.work.material_changes, t.work.queries,
                           t.work.primitives, t.work.fragments, t.work.passed_samples, t.frame_ns,
                           t.submit_ns, t.gpu_ns ? fmt::format("{:.0f}", *t.gpu_ns) : "",
                           calibration.profile.predict_ns(t.work), t.round_ns.size());
    return csv;
}

Result<std::filesystem::path> output_path(const CalibrateOptions& options) {
    if (options.output) return *options.output;
    const std::optional<std::filesystem::path> saved = saved_profile_path(options.scene);
    if (!saved) return Error{"neither XDG_CACHE_HOME nor HOME is set; name a file with -o"};
    std::error_code problem;
    std::filesystem::create_directories(saved->parent_path(), problem);
    if (problem)
        return Error{fmt::format("{}: can't be made ({}); name a file with -o", saved->parent_path().string(),
                                 problem.message())};
    return *saved;
}

/// The scenes with what the device needs of them; they stay where they are.
struct Subjects {
    std::vector<std::string> names;
    std::vector<std::unique_ptr<LoadedScene>> scenes;
    std::vector<gl::SceneBuffers> buffers;

    Status load(const std::string& scene) {
        if (scene.empty())
            names.assign(kSubjects.begin(), kSubjects.end());
        else
            names.push_back(scene);
        for (const std::string& name : names) {
            Result<LoadedScene> loaded = load_scene(name);
            if (!loaded) return loaded.error();
            if (!loaded->baked)
                if (Status status = settle_instances(loaded->scene, {}); !status) return status;
            scenes.push_back(std::make_unique<LoadedScene>(std::move(loaded).value()));
            Result<gl::SceneBuffers> uploaded = gl::SceneBuffers::upload(scenes.back()->scene);
            if (!uploaded) return uploaded.error();
            buffers.push_back(std::move(uploaded).value());
        }
        return success();
    }

    [[nodiscard]] std::vector<gl::CalibrationSubject> list() const {
        std::vector<gl::CalibrationSubject> result;
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            const CameraPath& path = scenes[i]->path;
            result.push_back({&scenes[i]->scene, &buffers[i], {}, path.fov_y_deg, path.near_m, path.far_m});
        }
        return result;
    }
};

}  // namespace

Result<int> run_calibrate(const CalibrateOptions& options) {
    const Result<PictureSize> size = parse_size(options.size);
    if (!size) return size.error();
    const Result<std::filesystem::path> path = output_path(options);
    if (!path) return path.error();
    Result<OutputFile> output = OutputFile::open(*path);
    if (!output) return output.error();
    std::optional<OutputFile> csv;
    if (options.csv) {
        Result<OutputFile> file = OutputFile::open(*options.csv);
        if (!file) return file.error();
        csv.emplace(std::move(file).value());
    }

    Progress progress;
    Result<gl::Context> context = gl::Context::create_headless();
    if (!context) return context.error();
    Result<gl::RenderTarget> target = gl::RenderTarget::create(size->width, size->height);
    if (!target) return Error{"--size: " + target.error().message};
    Result<gl::Executor> executor = gl::Executor::create();
    if (!executor) return executor.error();
    progress.say("loading");
    Subjects subjects;
    if (Status status = subjects.load(options.scene); !status) return status.error();
    gl::CalibrationOptions calibration_options;
    calibration_options.clip_depth =
        context->device().clip_control ? ClipDepth::ReversedZeroToOne : ClipDepth::NegativeOneToOne;
    calibration_options.progress = [&](int done, int total) { progress.show("timing frames", done, total); };
    const std::vector<gl::CalibrationSubject> list = subjects.list();
    Result<gl::Calibration> calibration =
        gl::calibrate(list, context->device(), *executor, *target, calibration_options);
    if (!calibration) return calibration.error();
    progress.say("timing occlusion queries");
    const Result<gl::MeasuredAnswerCosts> answers = gl::measure_answer_costs(*target);
    if (!answers) return answers.error();
    calibration->profile.answer_costs = answers->costs;
    progress.clear();

    calibration->profile.date = today();
    calibration->profile.note =
        fmt::format("rhview calibrate with {} at {}", fmt::join(subjects.names, ", "), options.size);
    if (csv)
        if (Status status = csv->commit(to_csv(*calibration)); !status) return status.error();
    if (Status status = output->commit(profile_text(calibration->profile)); !status) return status.error();
    print_calibration(*calibration, context->device(), subjects.names);
    fmt::print("\n  saved as {}\n", path->string());
    return kDone;
}

}  // namespace rhview::cli
