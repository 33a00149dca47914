// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "walk_session.h"

#include <fmt/format.h>

#include <algorithm>

#include "frame_comparison.h"
#include "level_chains.h"
#include "occlusion_choice.h"
#include "rhview/gl/stepped_executor.h"
#include "rhview/gl/timer.h"
#include "rhview/gl/work_counter.h"
#include "rhview/timing_model/running_update.h"
#include "statistics.h"
#include "walk_description.h"
#include "walk_levels.h"
#include "walk_objects.h"
#include "walk_pace.h"

namespace rhview::cli {
namespace {

Work without_queries(Work work) {
    work.queries = 0.0;
    return work;
}

}  // namespace

/// Everything a walk needs on the device, and the walk itself.
class WalkSession::Impl {
  public:
    Impl(const WalkOptions& options, const WalkGround& ground)
        : options_(options),
          ground_(ground),
          constants_(ground.chosen.constants),
          scene_(ground.loaded.scene),
          pace_(ground.loaded.path, options),
          objects_(scene_),
          clip_depth_(ground.context.device().clip_control ? ClipDepth::ReversedZeroToOne
                                                           : ClipDepth::NegativeOneToOne) {}

    Status set_up() {
        if (Status status = prepare(); !status) return status;
        report_.plan_hash = plan_hash({});
        if (Status status = set_up_device(); !status) return status;
        begin();
        return success();
    }

    FrameRecord draw(const FrameCameras& cameras) {
        FrameRecord record = draw_once(0, cameras);
        if (levels_) levels_->observe(record);
        learn(record);
        return record;
    }

    Status restart() {
        Result<MethodOptions> method_options = choose_method_options();
        if (!method_options) return method_options.error();
        if (method_.octree)
            method_.planner = make_octree_planner(options_.method, *method_.octree, *method_options);
        else if (Status status = build(*method_options); !status)
            return status;
        answers_.clear();
        plan_.clear();
        begin();
        return success();
    }

    Status resize(PictureSize size) {
        Result<gl::RenderTarget> target = gl::RenderTarget::create(size.width, size.height);
        if (!target) return target.error();
        target_.emplace(std::move(target).value());
        return success();
    }

    [[nodiscard]] const PreparedMethod& method() const { return method_; }
    [[nodiscard]] const FramePlan& plan() const { return plan_; }
    std::uint64_t hash_of_plan(std::uint64_t seed) {
        hashed_ = plan_;
        if (objects_.are_late())
            for (ConditionalObject& object : hashed_.conditional_objects) object.level = 0;
        return plan_hash(hashed_, seed);
    }
    [[nodiscard]] gl::RenderTarget& target() { return *target_; }
    [[nodiscard]] ClipDepth clip_depth() const { return clip_depth_; }

    PicturedPlan pictured(const View& culling, double time_s) {
        return comparison_->pictured({0, culling, culling, time_s, plan_, answers_});
    }

    void picture(PlanPicture& picture, const PicturedPlan& plan, const View& from, const PlanMarks& marks) {
        picture.draw(plan, from, marks, *executor_);
    }

    void warm_up() { draw_frame(0); }

    Status walk(int frame) {
        FrameRecord record = draw_frame(frame);
        learn(record);
        if (Status status = compare(frame, record); !status) return status;
        report_.plan_hash = hash_of_plan(report_.plan_hash);
        report_.frames.push_back(record);
        return success();
    }

    Status finish() {
        report_.reveal_frames = comparison_->reveal_frames();
        report_.blocking_reads = answer_counters().blocking_reads;
        report_.lost_queries = answer_counters().lost;
        const std::string error = gl::take_error();
        return error.empty() ? success() : Status(Error{"OpenGL reported: " + error});
    }

    [[nodiscard]] const WalkReport& report() const { return report_; }

  private:
    /// As before the first frame.
    void begin() {
        objects_.begin(options_.method == "rhview");
        levels_.reset();
        if (!ground_.chains.empty() && (options_.lod_error_px > 0.0 || options_.budget_ms))
            levels_.emplace(scene_, ground_.chains, options_, constants_ ? &constants_->profile : nullptr);
        running_.reset();
        if (constants_) running_.emplace(constants_->profile);
    }

    /// What is asked for of the frame just drawn.
    Status compare(int number, FrameRecord& record) {
        const WalkedFrame frame{
            number, culling_view_of(number), view_of(number), pace_.time_of(number), plan_, answers_};
        if (options_.visible_set) {
            comparison_->place_all(frame);
            record.visible_set_indices = comparison_->visible_set_indices(frame);
        }
        const bool checked = options_.check && number % options_.check_every == 0;
        const bool pictured = options_.images && number % options_.images_every == 0;
        const bool measured = options_.image_error_every > 0 && number % options_.image_error_every == 0;
        if (measured) comparison_->keep_picture();
        if (checked || pictured)
            if (Status status = comparison_->compare(frame, checked, pictured, record); !status)
                return status;
        if (measured) record.image_error = comparison_->image_error(frame);
        return success();
    }

    /// Constants follow the frames; the frame keeps what they foretold.
    void learn(FrameRecord& record) {
        if (running_ && record.predicted_ms) {
            // Queries are priced apart, by what they asked about.
            const double query_ms = record.occlusion ? record.occlusion->query_ms : 0.0;
            const Work draws = without_queries(record.work);
            record.running_predicted_ms = 1e-6 * running_->predict_ns(draws) + query_ms;
            if (record.frame_ms > query_ms) running_->observe({draws, 1e6 * (record.frame_ms - query_ms)});
        }
    }

    /// What the method is built and planned with, and why it asks nothing where it was to ask.
    Result<MethodOptions> choose_method_options() {
        if (options_.budget_ms && !constants_)
            return Error{fmt::format("--budget: needs timing constants, and {}", ground_.chosen.why_not)};
        Result<RivalOptions> rival = parse_rival(options_.hierarchy, options_.tune);
        if (!rival) return rival.error();
        MethodOptions method_options{
            options_.leaf, options_.replica_budget, {}, {}, std::move(rival).value(), pace_.longest_step_s()};
        if (constants_)
            method_options.costs = draw_costs(constants_->profile, options_.submission == "multi");
        why_no_occlusion_.clear();
        if (options_.method == "rhview" || options_.method == "rhview-seed") {
            list_object_indices();
            Result<std::optional<OcclusionOptions>> occlusion =
                choose_occlusion(options_, ground_.wanted, constants_, ground_.size, why_no_occlusion_);
            if (!occlusion) return occlusion.error();
            method_options.occlusion = *occlusion;
            if (method_options.occlusion) method_options.occlusion->object_indices = object_indices_;
        }
        return method_options;
    }

    Status build(const MethodOptions& method_options) {
        const std::optional<BakedParts>& baked = ground_.loaded.baked;
        Result<PreparedMethod> method =
            prepare_method(options_.method, scene_, method_options, baked ? &baked->octree : nullptr);
        if (!method) return method.error();
        method_ = std::move(method).value();
        return success();
    }

    /// The method, ready to plan, and what the report says of it.
    Status prepare() {
        const Result<MethodOptions> method_options = choose_method_options();
        if (!method_options) return method_options.error();
        if (Status status = build(*method_options); !status) return status;
        report_ = describe(options_, ground_, method_);
        report_.why_no_occlusion = why_no_occlusion_;
        if (method_options->occlusion) report_.query_costs = method_options->occlusion->costs;
        return success();
    }

    void list_object_indices() {
        object_indices_.clear();
        const auto count = [&](const auto& placed) {
            const SceneMesh& mesh = scene_.meshes[index_of(placed.mesh)];
            object_indices_.push_back(static_cast<std::uint32_t>(mesh.indices.size()));
        };
        std::ranges::for_each(scene_.dynamic_objects, count);
        std::ranges::for_each(scene_.static_instances, count);
    }

    Status set_up_device() {
        const PictureSize size = ground_.size;
        Result<gl::RenderTarget> target = gl::RenderTarget::create(size.width, size.height);
        if (!target) return Error{"--size: " + target.error().message};
        target_.emplace(std::move(target).value());
        Result<gl::Executor> executor = gl::Executor::create();
        if (!executor) return executor.error();
        executor_.emplace(std::move(executor).value());
        if (method_.rival) {
            Result<gl::SteppedExecutor> stepped = gl::SteppedExecutor::create(*executor_);
            if (!stepped) return stepped.error();
            stepped_.emplace(std::move(stepped).value());
        }
        const ChainRanges ranges(ground_.chains);
        Result<gl::SceneBuffers> buffers =
            gl::SceneBuffers::upload(scene_, method_.static_indices(), ranges.meshes());
        if (!buffers) return buffers.error();
        buffers_.emplace(std::move(buffers).value());
        const Result<gl::TimerCheck> timer = gl::check_gpu_timer();
        if (!timer) return timer.error();
        if (timer->gpu_timer_is_whole()) gpu_timer_.emplace();
        work_counter_.emplace();
        report_.device.timer = gpu_timer_ ? "gpu" : "wall";
        Result<FrameComparison> comparison = FrameComparison::create(stage());
        if (!comparison) return comparison.error();
        comparison_.emplace(std::move(comparison).value());
        return success();
    }

    [[nodiscard]] WalkStage stage() {
        return {options_, ground_, method_, target_, *executor_, *buffers_, objects_, levels_, clip_depth_};
    }

    [[nodiscard]] View culling_view_of(int frame) const {
        return view_of(std::min(frame, options_.freeze_culling.value_or(frame)));
    }

    [[nodiscard]] View view_of(int frame) const {
        const double aspect = static_cast<double>(target_->width()) / target_->height();
        return pace_.view_of(frame, aspect, clip_depth_);
    }

    [[nodiscard]] gl::AnswerCounters answer_counters() const {
        return stepped_ ? stepped_->answer_counters() : executor_->answer_counters();
    }

    /// The same of a method that draws and asks in turns. What only the device counts is not counted:
    /// OpenGL knows one occlusion query at a time.
    FrameRecord draw_in_steps(int frame, const FrameCameras& cameras, gl::DrawOptions draw) {
        objects_.place_all(cameras.time_s);
        const FrameInput input = objects_.input(cameras.culling, viewport());
        FrameRecord record;
        record.frame = frame;
        const std::uint64_t waits = stepped_->answer_counters().blocking_reads;
        const gl::WallTimer timer;
        if (levels_) draw.object_levels = levels_->choose_ahead(input);
        const double chosen_ms = timer.elapsed_ms();
        if (gpu_timer_) gpu_timer_->begin();
        stepped_->begin(*buffers_, cameras.render, draw);
        const gl::WallTimer method_timer;
        const double begun_ms = stepped_->device_ms();
        method_.rival->method->draw(input, *stepped_, drawn_);
        record.cull_ms =
            chosen_ms + std::max(method_timer.elapsed_ms() - (stepped_->device_ms() - begun_ms), 0.0);
        const gl::FrameCounters counters = stepped_->end();
        if (gpu_timer_) gpu_timer_->end();
        gl::finish();
        record.frame_ms = timer.elapsed_ms();
        if (gpu_timer_) record.gpu_ms = gpu_timer_->read_ms();
        record.work = gl::work_of(counters);
        record.work.queries = static_cast<double>(counters.queries);
        std::swap(plan_, drawn_.plan);
        answers_.swap(drawn_.answers);
        if (levels_) levels_->name_levels(plan_);
        if (levels_) record.lod_error_px = levels_->error_px(plan_, answers_);
        record.object_draws = counters.object_draws;
        record.mesh_levels = objects_.count_mesh_levels(plan_);
        record.nodes_visited = plan_.nodes_visited;
        for (const ObjectId id : plan_.objects) count_object(id, record);
        OcclusionRecord& o = record.occlusion.emplace();
        o.candidates = plan_.nodes_visited;
        o.boxes = counters.query_boxes;
        o.hidden = drawn_.hidden_queries;
        o.waits = stepped_->answer_counters().blocking_reads - waits;
        return record;
    }

    [[nodiscard]] glm::ivec2 viewport() const { return {target_->width(), target_->height()}; }

    /// One drawing of the frame; the first of several counts, all of them are timed.
    FrameRecord draw_once(int frame, const FrameCameras& cameras) {
        gl::DrawOptions draw;
        draw.placements = objects_.scene_from_mesh();
        draw.submission = options_.submission == "multi" ? gl::Submission::MultiDraw : gl::Submission::Plain;
        draw.counter = &*work_counter_;
        stage().clear();
        gl::finish();
        if (stepped_) return draw_in_steps(frame, cameras, draw);
        FrameRecord record;
        record.frame = frame;
        const gl::WallTimer timer;
        objects_.move(cameras.time_s);
        const FrameInput input = objects_.planner_input(cameras.culling, viewport());
        const double moved_ms = timer.elapsed_ms();
        method_.planner->absorb(answers_);
        if (levels_) levels_->absorb(answers_);
        method_.planner->plan(input, plan_);
        if (levels_) choose_levels(input, record);
        record.cull_ms = timer.elapsed_ms() - moved_ms;
        objects_.place_planned(plan_, cameras.time_s);
        LateStage late{*this, input, cameras.time_s};
        if (objects_.are_late()) draw.late = {prepare_late, &late, objects_.largest_growth()};
        if (gpu_timer_) gpu_timer_->begin();
        work_counter_->begin();
        const gl::FrameCounters counters = executor_->draw(plan_, *buffers_, cameras.render, draw);
        work_counter_->end();
        if (gpu_timer_) gpu_timer_->end();
        gl::finish();
        answers_.clear();
        executor_->poll_answers(answers_);
        record.frame_ms = timer.elapsed_ms();
        if (gpu_timer_) record.gpu_ms = gpu_timer_->read_ms();
        record.work = gl::work_of(counters);
        work_counter_->read(record.work);
        record.nodes_visited = plan_.nodes_visited;
        for (const ObjectId id : plan_.objects) count_object(id, record);
        record.object_draws = counters.object_draws;
        record.mesh_levels = objects_.count_mesh_levels(plan_);
        if (levels_) record.lod_error_px = levels_->error_px(plan_, answers_);
        if (plan_.occlusion) count_occlusion(counters, record);
        if (constants_) {
            record.predicted_ms = 1e-6 * constants_->profile.predict_ns(without_queries(record.work));
            if (record.occlusion) *record.predicted_ms += record.occlusion->query_ms;
        }
        return record;
    }

    void choose_levels(const FrameInput& input, FrameRecord& record) {
        levels_->choose(input, running_ ? &running_->profile() : nullptr, plan_, record);
        levels_->count_indices(input, plan_, object_indices_);
    }

    /// What late objects are prepared from.
    struct LateStage {
        Impl& walk;
        const FrameInput& input;
        double time_s;
    };
    static void prepare_late(void* context, std::span<std::uint32_t> places) {
        const LateStage& stage = *static_cast<const LateStage*>(context);
        FramePlan& plan = stage.walk.plan_;
        if (stage.walk.levels_) stage.walk.levels_->choose_late(stage.input, plan, places);
        stage.walk.objects_.place_late(plan, places, stage.time_s);
    }

    void count_object(ObjectId id, FrameRecord& record) const {
        ++(index_of(id) < scene_.dynamic_objects.size() ? record.visible_objects : record.visible_instances);
    }

    /// What hung on queries enters the work as far as the device drew it.
    void count_occlusion(const gl::FrameCounters& counters, FrameRecord& record) const {
        const gl::ExecutedDraws executed =
            gl::count_executed(plan_, *buffers_, answers_, objects_.scene_from_mesh());
        OcclusionRecord& o = record.occlusion.emplace();
        o.candidates = plan_.occlusion->candidates;
        o.boxes = counters.query_boxes;
        o.hidden = static_cast<std::uint64_t>(std::ranges::count(answers_, false, &QueryAnswer::visible));
        o.box_pass_queries = static_cast<std::uint64_t>(
            std::ranges::count(plan_.queries, QueryWay::BoxPass, &PlannedQuery::way));
        o.conditional_draws = counters.conditional_draws;
        o.conditional_ranges = counters.conditional_sub_draws;
        o.executed_ranges = executed.sub_draws + executed.unknown_sub_draws;
        const std::uint64_t indices = executed.indices + executed.unknown_indices;
        o.skipped_indices = counters.conditional_indices - indices;
        o.query_ms = 1e-6 * plan_.occlusion->query_ns;
        o.exploration_ms = 1e-6 * plan_.occlusion->exploration_ns;
        o.saved_ms = 1e-6 * plan_.occlusion->saved_ns;
        for (const ConditionalObject& conditional : plan_.conditional_objects) {
            const std::uint64_t ticket = plan_.queries[conditional.query].ticket;
            const auto answer = std::ranges::find(answers_, ticket, &QueryAnswer::ticket);
            if (answer == answers_.end() || answer->visible) count_object(conditional.object, record);
        }
        record.work.queries = static_cast<double>(counters.queries);
        record.work.draw_calls += static_cast<double>(counters.conditional_draws);
        record.work.sub_draws += static_cast<double>(counters.conditional_sub_draws);
        record.work.indices += static_cast<double>(indices);
    }

    FrameRecord draw_frame(int frame) {
        const FrameCameras cameras{culling_view_of(frame), view_of(frame), pace_.time_of(frame)};
        FrameRecord record = draw_once(frame, cameras);
        std::vector<double> frame_ms{record.frame_ms}, cull_ms{record.cull_ms},
            gpu_ms{record.gpu_ms.value_or(0.0)};
        for (int i = 1; i < options_.repeats; ++i) {
            const FrameRecord again = draw_once(frame, cameras);
            frame_ms.push_back(again.frame_ms);
            cull_ms.push_back(again.cull_ms);
            gpu_ms.push_back(again.gpu_ms.value_or(0.0));
        }
        record.frame_ms = summarise(frame_ms).median;
        record.cull_ms = summarise(cull_ms).median;
        if (record.gpu_ms) record.gpu_ms = summarise(gpu_ms).median;
        if (levels_) levels_->observe(record);
        return record;
    }

    const WalkOptions& options_;
    const WalkGround& ground_;
    const std::optional<UserConstants>& constants_;
    const Scene& scene_;
    WalkPace pace_;
    PreparedMethod method_;
    std::vector<std::uint32_t> object_indices_;  ///< what the planner refers to
    WalkReport report_;
    std::optional<RunningUpdate> running_;
    WalkObjects objects_;
    ClipDepth clip_depth_;
    std::optional<WalkLevels> levels_;
    std::optional<gl::RenderTarget> target_;
    std::optional<gl::Executor> executor_;
    std::optional<gl::SteppedExecutor> stepped_;  ///< of a method that draws and asks in turns
    DrawnFrame drawn_;                            ///< by it
    std::optional<gl::SceneBuffers> buffers_;
    std::optional<gl::GpuTimer> gpu_timer_;
    std::optional<gl::WorkCounter> work_counter_;
    std::optional<FrameComparison> comparison_;
    FramePlan plan_;
    FramePlan hashed_;                  ///< scratch
    std::vector<QueryAnswer> answers_;  ///< to the queries of the frame before
    std::string why_no_occlusion_;
};

WalkSession::WalkSession(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
WalkSession::WalkSession(WalkSession&&) noexcept = default;
WalkSession& WalkSession::operator=(WalkSession&&) noexcept = default;
WalkSession::~WalkSession() = default;

Result<WalkSession> WalkSession::create(const WalkOptions& options, const WalkGround& ground) {
    auto impl = std::make_unique<Impl>(options, ground);
    if (Status status = impl->set_up(); !status) return status.error();
    return WalkSession(std::move(impl));
}

void WalkSession::warm_up() {
    impl_->warm_up();
}

Status WalkSession::walk(int frame) {
    return impl_->walk(frame);
}

Status WalkSession::finish() {
    return impl_->finish();
}

const WalkReport& WalkSession::report() const {
    return impl_->report();
}

FrameRecord WalkSession::draw(const FrameCameras& cameras) {
    return impl_->draw(cameras);
}

Status WalkSession::restart() {
    return impl_->restart();
}

Status WalkSession::resize(PictureSize size) {
    return impl_->resize(size);
}

const PreparedMethod& WalkSession::method() const {
    return impl_->method();
}

std::uint64_t WalkSession::hash_of_plan(std::uint64_t seed) {
    return impl_->hash_of_plan(seed);
}

const FramePlan& WalkSession::plan() const {
    return impl_->plan();
}

gl::RenderTarget& WalkSession::target() {
    return impl_->target();
}

ClipDepth WalkSession::clip_depth() const {
    return impl_->clip_depth();
}

PicturedPlan WalkSession::pictured(const View& culling, double time_s) {
    return impl_->pictured(culling, time_s);
}

void WalkSession::picture(PlanPicture& picture, const PicturedPlan& plan, const View& from,
                          const PlanMarks& marks) {
    impl_->picture(picture, plan, from, marks);
}

}  // namespace rhview::cli
