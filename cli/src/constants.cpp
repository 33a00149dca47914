// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "profile_store.h"
#include "rhview/gl/answer_costs.h"
#include "rhview/gl/calibration.h"
#include "rhview/scenes/static_instances.h"

namespace rhview::cli {
namespace {

constexpr std::array<std::string_view, 5> kNames{"c0", "c1", "c3", "query", "box"};

Result<std::pair<std::string, double>> parse_assignment(std::string_view assignment) {
    const std::size_t equals = assignment.find('=');
    const std::string name(assignment.substr(0, equals));
    const std::string_view text = equals == std::string_view::npos ? "" : assignment.substr(equals + 1);
    double value = 0.0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || !std::isfinite(value) ||
        value < 0.0)
        return Error{fmt::format(
            "--set {}: write name=value with a value of 0 or more nanoseconds, as in c1=0.25", assignment)};
    if (std::ranges::find(kNames, name) == kNames.end())
        return Error{fmt::format("--set {}: unknown constant; the constants are c0, c1, c3, query and box",
                                 assignment)};
    return std::pair(name, value);
}

void apply(const std::vector<std::pair<std::string, double>>& set, TimingProfile& profile) {
    for (const auto& [name, value] : set) {
        if (name == "c0") profile.c0_ns = value;
        if (name == "c1") profile.c1_ns = value;
        if (name == "c3") profile.c3_ns = value;
        if (name == "query") profile.query_ns = value;
    }
}

gl::CalibrationOptions quick_options(ClipDepth clip_depth) {
    gl::CalibrationOptions options;
    options.frames = 48;
    options.rounds = 2;
    options.longest_s = 0.6;
    options.largest_frame_ms = 10.0;
    options.clip_depth = clip_depth;
    return options;
}

Result<ChosenConstants> calibrate_quickly(const SceneAndPath& loaded, const gl::DeviceInfo& device, int width,
                                          int height) {
    Result<gl::RenderTarget> target = gl::RenderTarget::create(width, height);
    if (!target) return Error{"--size: " + target.error().message};
    Result<gl::Executor> executor = gl::Executor::create();
    if (!executor) return executor.error();
    // Instances are not settled before prices are known: flattened by the default ones meanwhile.
    std::optional<Scene> flattened;
    if (!loaded.scene.static_instances.empty()) {
        flattened.emplace(loaded.scene);
        if (Status status = settle_instances(*flattened, {}); !status) return status.error();
    }
    const Scene& scene = flattened ? *flattened : loaded.scene;
    Result<gl::SceneBuffers> buffers = gl::SceneBuffers::upload(scene);
    if (!buffers) return buffers.error();
    const gl::CalibrationSubject subject{
        &scene, &*buffers, {}, loaded.path.fov_y_deg, loaded.path.near_m, loaded.path.far_m};
    const ClipDepth clip_depth =
        device.clip_control ? ClipDepth::ReversedZeroToOne : ClipDepth::NegativeOneToOne;
    Result<gl::Calibration> calibration =
        gl::calibrate(std::span(&subject, 1), device, *executor, *target, quick_options(clip_depth));
    ChosenConstants chosen;
    if (!calibration) {
        chosen.why_not = calibration.error().message;
        return chosen;
    }
    const Result<gl::MeasuredAnswerCosts> answers =
        gl::measure_answer_costs(*target, {.longest_s = kQuickAnswersS});
    if (!answers) return answers.error();
    calibration->profile.answer_costs = answers->costs;
    chosen.constants = {calibration->profile, "quick",
                        fmt::format("calibrated quickly with this scene in {:.1f} s (rhview calibrate "
                                    "measures better, and once)",
                                    calibration->seconds)};
    return chosen;
}

}  // namespace

bool WantedConstants::are_complete() const {
    const auto has = [&](std::string_view name) {
        return std::ranges::any_of(set, [&](const auto& assignment) { return assignment.first == name; });
    };
    return has("c1") && has("c3");
}

Result<WantedConstants> parse_constants(const std::optional<std::filesystem::path>& file,
                                        const std::string& set) {
    WantedConstants wanted;
    if (file) {
        Result<TimingProfile> profile = load_profile(*file);
        if (!profile) return profile.error();
        wanted.profile = std::move(profile).value();
        wanted.file = *file;
    }
    for (std::size_t begin = 0; begin < set.size();) {
        const std::size_t end = std::min(set.find(',', begin), set.size());
        Result<std::pair<std::string, double>> assignment =
            parse_assignment(std::string_view(set).substr(begin, end - begin));
        if (!assignment) return assignment.error();
        if (std::ranges::any_of(wanted.set, [&](const auto& a) { return a.first == assignment->first; }))
            return Error{fmt::format("--set {}: {} is there twice", set, assignment->first)};
        wanted.set.push_back(std::move(assignment).value());
        begin = end + 1;
    }
    return wanted;
}

Result<ChosenConstants> choose_constants(const WantedConstants& wanted, const std::string& scene_spec,
                                         const SceneAndPath& loaded, const gl::DeviceInfo& device, int width,
                                         int height) {
    ChosenConstants chosen;
    if (wanted.profile) {
        chosen.constants = {*wanted.profile, "file", wanted.file.string()};
        if (!is_of_device(*wanted.profile, device))
            chosen.warning =
                fmt::format("{}: measured on another device ({}), this is {}: used because you named it",
                            wanted.file.string(), wanted.profile->renderer, device.renderer);
    } else if (wanted.are_complete()) {
        chosen.constants.emplace();
    } else if (std::optional<SavedProfile> saved = find_saved_profile(scene_spec, device, chosen.warning)) {
        chosen.warning.clear();
        chosen.constants = {std::move(saved->profile), "file", saved->file.string()};
    } else {
        const std::string warning = chosen.warning;
        Result<ChosenConstants> quick = calibrate_quickly(loaded, device, width, height);
        if (!quick) return quick.error();
        chosen = std::move(quick).value();
        chosen.warning = warning;
    }
    if (!wanted.set.empty() && chosen.constants) {
        apply(wanted.set, chosen.constants->profile);
        chosen.constants->source = "set";
        chosen.constants->told += chosen.constants->told.empty() ? "as set" : ", changed by --set";
    }
    return chosen;
}

std::optional<QueryCosts> query_costs(const WantedConstants& wanted, const UserConstants& constants) {
    std::optional<QueryCosts> costs = constants.profile.answer_costs;
    const double never = std::numeric_limits<double>::infinity();
    for (const auto& [name, value] : wanted.set) {
        if (name != "query" && name != "box") continue;
        if (!costs) costs = QueryCosts{{.query_ns = never}, {.query_ns = never}};
        const double draw_ns = constants.profile.c3_ns + constants.profile.sub_draw_ns.value_or(0.0);
        AnswerCosts& way = name == "query" ? costs->hardware : costs->box_pass;
        way = {.query_ns = value, .draw_ns = draw_ns};
    }
    return costs;
}

DrawCosts draw_costs(const TimingProfile& profile, bool multi_draw) {
    if (multi_draw) return {profile.c1_ns, profile.sub_draw_ns.value_or(profile.c3_ns), profile.c3_ns};
    return {profile.c1_ns, profile.c3_ns + profile.sub_draw_ns.value_or(0.0), 0.0};
}

}  // namespace rhview::cli
