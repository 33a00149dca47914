// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "view_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "occlusion_choice.h"
#include "output_file.h"

namespace rhview::cli {
namespace {

constexpr glm::vec3 kPaper(0.96f, 0.96f, 0.94f);
constexpr double kRadiansPerPixel = 0.004;

/// What a method has no choice of goes back to its default: switching never fails for that.
WalkOptions for_method(WalkOptions options, const std::string& method) {
    options.method = method;
    if (method != "rhview") options.mode = "exact";
    if (method != "rhview" && (method != "rhview-seed" || options.occlusion == "boxes"))
        options.occlusion = "auto";
    if (method != "chc" && method != "chc++") options.hierarchy = "auto";
    if (method != "chc++" && method != "nested-grid") options.tune.clear();
    return options;
}

bool is_finite(const AnswerCosts& costs) {
    return std::isfinite(costs.query_ns) && std::isfinite(costs.frame_ns) && std::isfinite(costs.draw_ns);
}

DrawCosts prices_of(const WalkOptions& options, const WalkGround& ground) {
    return ground.chosen.constants
               ? draw_costs(ground.chosen.constants->profile, options.submission == "multi")
               : DrawCosts{};
}

}  // namespace

std::filesystem::path new_file(const std::filesystem::path& folder, const std::string& stem,
                               const std::string& ending) {
    std::error_code ignored;
    for (int number = 1;; ++number) {
        std::filesystem::path file = folder / fmt::format("{}_{:04}.{}", stem, number, ending);
        if (!std::filesystem::exists(file, ignored)) return file;
    }
}

ViewSession::ViewSession(std::unique_ptr<Stage> stage, PlanPicture picture, gl::RenderTarget outside,
                         std::filesystem::path folder)
    : stage_(std::move(stage)),
      camera_(stage_->ground.loaded.path),
      picture_(std::move(picture)),
      outside_(std::move(outside)),
      folder_(std::move(folder)) {}

Result<std::unique_ptr<ViewSession>> ViewSession::create(const ViewOptions& options) {
    Result<std::unique_ptr<Stage>> stage = make_stage(options.walk);
    if (!stage) return stage.error();
    Result<PlanPicture> picture = PlanPicture::create();
    if (!picture) return picture.error();
    const PictureSize size = (*stage)->ground.size;
    Result<gl::RenderTarget> outside = gl::RenderTarget::create(size.width, size.height);
    if (!outside) return outside.error();
    return std::unique_ptr<ViewSession>(new ViewSession(std::move(stage).value(), std::move(picture).value(),
                                                        std::move(outside).value(), options.folder));
}

Result<std::unique_ptr<ViewSession::Stage>> ViewSession::make_stage(const WalkOptions& options) {
    Result<WalkWishes> wishes = parse_wishes(options);
    if (!wishes) return wishes.error();
    Result<gl::Context> context = gl::Context::adopt_current();
    if (!context) return context.error();
    Progress progress;
    Result<WalkGround> ground =
        prepare_ground(options, std::move(wishes).value(), std::move(context).value(), progress);
    if (!ground) return ground.error();
    progress.say("building");
    std::unique_ptr<Stage> stage(new Stage{options, std::move(ground).value(), {}, {}});
    if (Status status = build(*stage); !status) return status.error();
    return stage;
}

Status ViewSession::build(Stage& stage) {
    Result<WalkSession> session = WalkSession::create(stage.options, stage.ground);
    if (!session) return session.error();
    stage.session.emplace(std::move(session).value());
    stage.built_for = prices_of(stage.options, stage.ground);
    // What asking costs was measured on the way: once is enough.
    const std::optional<QueryCosts>& measured = stage.session->report().query_costs;
    std::optional<UserConstants>& constants = stage.ground.chosen.constants;
    if (constants && measured && stage.ground.wanted.set.empty() && is_finite(measured->hardware) &&
        is_finite(measured->box_pass))
        constants->profile.answer_costs = measured;
    return success();
}

bool ViewSession::is_stale() const {
    const DrawCosts prices = prices_of(stage_->options, stage_->ground);
    return stage_->options.method == "rhview" && !stage_->ground.loaded.baked &&
           (prices.index_ns != stage_->built_for.index_ns || prices.draw_ns != stage_->built_for.draw_ns);
}

std::optional<std::size_t> ViewSession::recorded_frames() const {
    return recording_ ? std::optional(recording_->path.keys.size()) : std::nullopt;
}

std::optional<std::pair<int, int>> ViewSession::replayed_frames() const {
    return replay_ ? std::optional(std::pair(replay_->next, replay_->frames)) : std::nullopt;
}

void ViewSession::say(const std::string& sentence) {
    message_ = sentence;
    fmt::print("{}\n", sentence);
    std::fflush(stdout);
}

double ViewSession::aspect() const {
    return static_cast<double>(outside_.width()) / outside_.height();
}

View ViewSession::view() const {
    return camera_.view(aspect(), stage_->session->clip_depth());
}

Status ViewSession::run(const ViewCommand& command) {
    WalkOptions wanted = stage_->options;
    switch (command.verb) {
        case ViewVerb::Method:
            return change(for_method(wanted, command.text));
        case ViewVerb::Mode:
            wanted.mode = command.text;
            return change(wanted);
        case ViewVerb::Occlusion:
            wanted.occlusion = command.text;
            return change(wanted);
        case ViewVerb::Submission:
            wanted.submission = command.text;
            return change(wanted);
        case ViewVerb::IndexPrice:
            return set_price("c1", command.x);
        case ViewVerb::DrawPrice:
            return set_price("c3", command.x);
        case ViewVerb::LodError:
            wanted.lod_error_px = command.x;
            return change(wanted);
        case ViewVerb::Budget:
            wanted.budget_ms = command.x > 0.0 ? std::optional(command.x) : std::nullopt;
            return change(wanted);
        case ViewVerb::Rebuild:
            return build(*stage_);
        case ViewVerb::Freeze:
            if (recording_ || replay_)
                return Error{"the camera can't be frozen while it is recorded; stop first"};
            freeze(command.on.value_or(!frozen_));
            return success();
        case ViewVerb::Outside:
            look_from_outside();
            return success();
        case ViewVerb::Back:
            go_back();
            return success();
        case ViewVerb::Colours:
            colours_ = command.on.value_or(!colours_);
            return success();
        case ViewVerb::Turn:
            turn(command.x, command.y);
            return success();
        case ViewVerb::Record:
            return recording_ ? stop() : record(command.text);
        case ViewVerb::Stop:
            return stop();
        case ViewVerb::Replay:
            return replay_ ? stop() : replay(command.text);
        case ViewVerb::Open:
            return open(command.text);
        case ViewVerb::Tell:
            tell();
            return success();
        case ViewVerb::Frames:
        case ViewVerb::Hold:
        case ViewVerb::Key:
        case ViewVerb::Panels:
        case ViewVerb::Screenshot:
        case ViewVerb::Quit:
            break;
    }
    return success();
}

Status ViewSession::change(const WalkOptions& wanted) {
    if (recording_ || replay_) return Error{"the method can't change while a path is recorded; stop first"};
    if (const Result<WalkWishes> wishes = parse_wishes(wanted); !wishes) return wishes.error();
    const WalkOptions before = std::exchange(stage_->options, wanted);
    const Status status = wanted.method != before.method ? build(*stage_) : stage_->session->restart();
    if (status) return success();
    stage_->options = before;
    if (const Status again = stage_->session->restart(); !again) return again;
    // cppcheck-suppress identicalConditionAfterEarlyExit ; a Status is false where it is an error
    return status;
}

Status ViewSession::set_price(const char* name, double value_ns) {
    if (recording_ || replay_) return Error{"prices can't change while a path is recorded; stop first"};
    auto& set = stage_->ground.wanted.set;
    const auto found = std::ranges::find(set, name, &std::pair<std::string, double>::first);
    if (found != set.end())
        found->second = value_ns;
    else
        set.emplace_back(name, value_ns);
    std::optional<UserConstants>& constants = stage_->ground.chosen.constants;
    if (!constants) constants.emplace();
    (std::string_view(name) == "c1" ? constants->profile.c1_ns : constants->profile.c3_ns) = value_ns;
    constants->source = "set";
    return stage_->session->restart();
}

Status ViewSession::open(const std::string& scene) {
    WalkOptions wanted = stage_->options;
    wanted.scene = scene;
    wanted.path.reset();
    wanted.leaf.reset();
    Result<std::unique_ptr<Stage>> stage = make_stage(wanted);
    if (!stage) return stage.error();
    if (recording_ || replay_)
        if (Status status = stop(); !status) return status;
    stage_ = std::move(stage).value();
    camera_ = FlyCamera(stage_->ground.loaded.path);
    frozen_.reset();
    history_.clear();
    time_s_ = 0.0;
    say(fmt::format("opened {}", scene));
    return success();
}

void ViewSession::freeze(bool on) {
    if (on == frozen_.has_value()) return;
    if (on)
        frozen_ = {camera_.key(0.0), view()};
    else
        frozen_.reset();
}

/// Back and up from the frozen camera, far enough to see a good part of what it sees.
void ViewSession::look_from_outside() {
    if (!frozen_) freeze(true);
    const CameraKey& key = frozen_->key;
    const double size = static_cast<double>(glm::length(stage_->ground.loaded.scene.bounds().extent()));
    const double distance = 0.25 * std::min(size, stage_->ground.loaded.path.far_m);
    const glm::dvec3 ahead = glm::normalize(key.target - key.eye);
    const glm::dvec3& up = camera_.up();
    const glm::dvec3 level = glm::normalize(ahead - up * glm::dot(ahead, up));
    camera_.look_at(key.eye - 0.5 * distance * level + 0.8 * distance * up, key.eye + 0.6 * distance * level);
}

void ViewSession::go_back() {
    if (frozen_) camera_.look_at(frozen_->key.eye, frozen_->key.target);
}

void ViewSession::turn(double right_px, double down_px) {
    camera_.turn(kRadiansPerPixel * right_px, -kRadiansPerPixel * down_px);
}

FrameCameras ViewSession::next_cameras(std::uint32_t held, double step_s) {
    if (replay_) {
        const ClipDepth clip_depth = stage_->session->clip_depth();
        const View view = replay_->path.view_of_frame(replay_->next, replay_->frames, aspect(), clip_depth);
        const glm::dmat4& camera = view.camera_from_world;
        camera_.look_at(view.eye(), view.eye() - glm::dvec3(camera[0][2], camera[1][2], camera[2][2]));
        return {view, view, replay_->path.time_of_frame(replay_->next, replay_->frames)};
    }
    const bool first = recording_ && recording_->path.keys.empty();
    if (!first) camera_.move(held, recording_ ? kStep_s : step_s);
    if (!recording_) time_s_ += step_s;
    if (recording_) {
        time_s_ = kStep_s * static_cast<double>(recording_->path.keys.size());
        recording_->path.keys.push_back(camera_.key(time_s_));
    }
    const View render = view();
    return {frozen_ ? frozen_->view : render, frozen_ ? frozen_->view : render, time_s_};
}

Status ViewSession::draw(std::uint32_t held, double step_s) {
    const FrameCameras cameras = next_cameras(held, step_s);
    WalkSession& session = *stage_->session;
    remember(session.draw(cameras));
    if (recording_) recording_->hash = session.hash_of_plan(recording_->hash);
    if (replay_) replay_->hash = session.hash_of_plan(replay_->hash);
    if (frozen_ || colours_) {
        PlanMarks shown = marks;
        shown.frustum = marks.frustum && frozen_.has_value();
        const PicturedPlan pictured = session.pictured(cameras.culling, cameras.time_s);
        outside_.begin(session.clip_depth(), kPaper);
        session.picture(picture_, pictured, frozen_ ? view() : cameras.render, shown);
    }
    if (replay_ && ++replay_->next == replay_->frames) return stop();
    return success();
}

void ViewSession::show() {
    gl::RenderTarget& own = stage_->session->target();
    const int width = outside_.width(), height = outside_.height();
    if (!frozen_ && !colours_) return own.show(0, 0, width, height);
    outside_.show(0, 0, width, height);
    if (frozen_) own.show(width - width / 4 - 8, 8, width / 4, height / 4);
}

Status ViewSession::resize(PictureSize size) {
    if (recording_ || replay_)
        if (Status status = stop(); !status) return status;
    Result<gl::RenderTarget> outside = gl::RenderTarget::create(size.width, size.height);
    if (!outside) return outside.error();
    if (Status status = stage_->session->resize(size); !status) return status;
    outside_ = std::move(outside).value();
    stage_->ground.size = size;
    stage_->options.size = fmt::format("{}x{}", size.width, size.height);
    return stage_->session->restart();
}

void ViewSession::remember(const FrameRecord& record) {
    if (history_.size() == kRemembered) history_.erase(history_.begin());
    history_.push_back(record);
}

void ViewSession::tell() {
    if (history_.empty()) return say("no frame yet");
    const FrameRecord& last = history_.back();
    say(fmt::format("{}, {}, {}: {:.0f} draw calls, {:.0f} indices, {:.0f} queries, {} nodes{}",
                    options().scene, options().method, options().mode, last.work.draw_calls,
                    last.work.indices, last.work.queries, last.nodes_visited, frozen_ ? ", frozen" : ""));
}

}  // namespace rhview::cli
