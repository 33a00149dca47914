// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The part of a `ViewSession` that records and replays paths, so that `rhview walk` plans the same.

#include <fmt/format.h>

#include <cmath>

#include "output_file.h"
#include "view_session.h"

namespace rhview::cli {
namespace {

/// `fly.json` has its prices beside it, in `fly.profile.json`.
std::filesystem::path profile_beside(const std::filesystem::path& path) {
    std::filesystem::path file = path;
    return file.replace_extension(".profile.json");
}

/// As a shell takes it for one word.
std::string quoted(const std::string& word) {
    if (word.find_first_of(" '\"\\$&;()<>|*?`#~!") == std::string::npos) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string set_option(const WantedConstants& wanted) {
    std::string text;
    for (const auto& [name, value] : wanted.set)
        text += fmt::format("{}{}={}", text.empty() ? "" : ",", name, value);
    return text;
}

}  // namespace

/// From here on everything is as in a walk that begins: the octree for these prices, no frame remembered.
Status ViewSession::begin_again() {
    frozen_.reset();
    time_s_ = 0.0;
    return is_stale() ? build(*stage_) : stage_->session->restart();
}

Status ViewSession::record(const std::string& name) {
    if (replay_)
        if (Status status = stop(); !status) return status;
    const std::filesystem::path file =
        name.empty() ? new_file(folder_, "rhview_path", "json") : std::filesystem::path(name);
    // An unwritable place is told before the flight, not after it.
    if (const Result<OutputFile> writable = OutputFile::open(file); !writable) return writable.error();
    if (Status status = begin_again(); !status) return status;
    recording_ = {file, camera_.lens(), plan_hash({})};
    message_ = fmt::format("recording {}", file.string());
    return success();
}

Status ViewSession::finish_recording() {
    const Recording done = std::move(*std::exchange(recording_, {}));
    const int frames = static_cast<int>(done.path.keys.size());
    if (const Status status = validate(done.path); !status)
        return Error{fmt::format("{}: not written: {}", done.file.string(), status.error().message)};
    Result<OutputFile> output = OutputFile::open(done.file);
    if (!output) return output.error();
    if (Status status = output->commit(to_json(done.path)); !status) return status;
    last_recording_ = done.file;

    const WalkGround& ground = stage_->ground;
    std::optional<std::filesystem::path> profile;
    const bool told_by_set = !ground.wanted.profile && ground.wanted.are_complete();
    if (ground.chosen.constants && !told_by_set) {
        profile = profile_beside(done.file);
        if (Status status = save_profile(ground.chosen.constants->profile, *profile); !status) return status;
    }
    say(fmt::format("recorded {}: {} frames, plan hash {:016x}", done.file.string(), frames, done.hash));
    say("  again: " + walk_command(done.file, frames, profile));
    return success();
}

Status ViewSession::stop() {
    if (recording_) return finish_recording();
    if (!replay_) return success();
    const Replay done = std::move(*std::exchange(replay_, {}));
    if (done.next == done.frames)
        say(fmt::format("replayed {}: {} frames, plan hash {:016x}", done.name, done.frames, done.hash));
    else
        say(fmt::format("stopped {} at frame {} of {}", done.name, done.next, done.frames));
    return success();
}

Status ViewSession::replay(const std::string& name) {
    if (recording_)
        if (Status status = stop(); !status) return status;
    const std::optional<std::filesystem::path> file =
        name.empty() ? last_recording_ : std::optional<std::filesystem::path>(name);
    Replay replay;
    replay.name = file ? file->string() : "the scene's path";
    replay.path = stage_->ground.loaded.path;
    if (file) {
        Result<CameraPath> path = load_camera_path(*file);
        if (!path) return path.error();
        replay.path = std::move(path).value();
    }
    const double steps = (replay.path.keys.back().time_s - replay.path.keys.front().time_s) / kStep_s;
    replay.frames = static_cast<int>(std::min(std::round(steps), 1e6)) + 1;
    replay.hash = plan_hash({});
    if (Status status = begin_again(); !status) return status;
    message_ = "replaying " + replay.name;
    replay_ = std::move(replay);
    return success();
}

std::string ViewSession::walk_command(const std::filesystem::path& path, int frames,
                                      const std::optional<std::filesystem::path>& profile) const {
    const WalkOptions& o = stage_->options;
    std::string command = fmt::format("rhview walk {} --path {} --frames {} --warmup 0 --size {} --method {}",
                                      quoted(o.scene), quoted(path.string()), frames, o.size, o.method);
    const auto add = [&](const char* option, const std::string& value, const std::string& usual) {
        if (value != usual) command += fmt::format(" {} {}", option, quoted(value));
    };
    add("--mode", o.mode, "exact");
    add("--occlusion", o.occlusion, "auto");
    add("--hierarchy", o.hierarchy, "auto");
    add("--tune", o.tune, "");
    add("--submission", o.submission, "plain");
    if (o.leaf) command += fmt::format(" --leaf {}", *o.leaf);
    if (o.replica_budget != 1.0) command += fmt::format(" --replica-budget {}", o.replica_budget);
    add("--instances", o.instances.policy, "auto");
    if (o.instances.budget_mib) command += fmt::format(" --instance-budget {}", *o.instances.budget_mib);
    if (o.lod_error_px != 1.0) command += fmt::format(" --lod-error {}", o.lod_error_px);
    add("--lod-policy", o.lod_policy, "error");
    if (o.budget_ms) command += fmt::format(" --budget {}", *o.budget_ms);
    if (profile) command += " --profile " + quoted(profile->string());
    add("--set", set_option(stage_->ground.wanted), "");
    return command;
}

}  // namespace rhview::cli
