// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "constants.h"
#include "frame_pictures.h"
#include "instances.h"
#include "method.h"
#include "output_file.h"
#include "picture_size.h"
#include "progress.h"
#include "rhview/gl/answer_costs.h"
#include "rhview/gl/context.h"
#include "rhview/gl/item_buffer.h"
#include "rhview/gl/timer.h"
#include "rhview/gl/work_counter.h"
#include "rhview/rhoctree/draw_list.h"
#include "rhview/timing_model/running_update.h"
#include "scene_source.h"
#include "statistics.h"
#include "verbs.h"
#include "walk_report.h"

namespace rhview::cli {
namespace {

constexpr glm::vec3 kSky(0.74f, 0.82f, 0.90f);

Status check_options(const WalkOptions& options) {
    const std::vector<std::string> methods = method_names();
    if (std::ranges::find(methods, options.method) == methods.end())
        return Error{fmt::format("--method {}: unknown; the methods are {}", options.method,
                                 fmt::join(methods, ", "))};
    if (options.mode != "exact" && options.mode != "latent")
        return Error{fmt::format("--mode {}: unknown; write exact or latent", options.mode)};
    const std::array ways{"auto", "hardware", "boxes", "off"};
    if (std::ranges::find(ways, options.occlusion) == ways.end())
        return Error{
            fmt::format("--occlusion {}: unknown; write {}", options.occlusion, fmt::join(ways, ", "))};
    if (options.visible_set && (options.method == "none" || options.method == "frustum"))
        return Error{fmt::format("--visible-set: {} has no octree; choose another --method", options.method)};
    if (options.mode == "latent" && (options.method != "rhview" || options.occlusion == "off"))
        return Error{"--mode latent: needs --method rhview, and no --occlusion off"};
    if (options.occlusion == "boxes" && options.method == "rhview-seed")
        return Error{"--occlusion boxes: rhview-seed asks by hardware queries; leave it out"};
    if (options.occlusion != "auto" && options.occlusion != "off" && options.method != "rhview" &&
        options.method != "rhview-seed")
        return Error{fmt::format("--occlusion {}: {} asks nothing; choose --method rhview, or leave it out",
                                 options.occlusion, options.method)};
    if (options.submission != "plain" && options.submission != "multi")
        return Error{fmt::format("--submission {}: unknown; write plain or multi", options.submission)};
    return check_instances(options.instances);
}

/// Where the results go; opened before the work, so that an unwritable place is told at once.
struct Outputs {
    std::optional<OutputFile> json;
    std::optional<OutputFile> csv;

    Status open(const WalkOptions& options) {
        const auto open_one = [](const auto& file, std::optional<OutputFile>& output) -> Status {
            if (!file) return success();
            Result<OutputFile> opened = OutputFile::open(*file);
            if (!opened) return opened.error();
            output.emplace(std::move(opened).value());
            return success();
        };
        if (options.json && options.csv && resolved(*options.json) == resolved(*options.csv))
            return Error{options.csv->string() + ": --json and --csv name the same file; name two"};
        if (Status status = open_one(options.json, json); !status) return status;
        if (Status status = open_one(options.csv, csv); !status) return status;
        return options.images ? prepare_folder(*options.images) : success();
    }

    Status commit(const WalkReport& report) {
        if (json)
            if (Status status = json->commit(to_json(report)); !status) return status;
        return csv ? csv->commit(to_csv(report)) : success();
    }
};

/// How `rhview` asks what is hidden; absent, with the reason where it was wanted, if it does not.
Result<std::optional<OcclusionOptions>> choose_occlusion(const WalkOptions& options,
                                                         const WantedConstants& wanted,
                                                         const std::optional<UserConstants>& constants,
                                                         PictureSize size, std::string& why_not) {
    std::optional<OcclusionOptions> occlusion;
    if (options.occlusion == "off") return occlusion;
    if (!constants) {
        why_not = "what drawing costs is not known";
        return occlusion;
    }
    std::optional<QueryCosts> costs = query_costs(wanted, *constants);
    if (!costs && wanted.are_complete()) {
        why_not = "what a query costs is not set (--set query=… or box=…, in ns)";
        if (options.occlusion == "auto" && options.mode == "exact") return occlusion;
        return Error{fmt::format("--occlusion {} --mode {}: {}", options.occlusion, options.mode, why_not)};
    }
    if (!costs) {
        Result<gl::RenderTarget> target = gl::RenderTarget::create(size.width, size.height);
        if (!target) return Error{"--size: " + target.error().message};
        const Result<gl::MeasuredAnswerCosts> measured =
            gl::measure_answer_costs(*target, {.longest_s = kQuickAnswersS});
        if (!measured) return measured.error();
        costs = measured->costs;
    }
    const double never = std::numeric_limits<double>::infinity();
    if (options.occlusion == "hardware") costs->box_pass = {.query_ns = never};
    if (options.occlusion == "boxes") costs->hardware = {.query_ns = never};
    if (!(std::min(costs->hardware.query_ns, costs->box_pass.query_ns) < never))
        return Error{fmt::format("--occlusion {}: --set gives it no price; set {}", options.occlusion,
                                 options.occlusion == "boxes" ? "box" : "query")};
    occlusion.emplace();
    occlusion->costs = *costs;
    occlusion->settings.mode = options.mode == "latent" ? OcclusionMode::Latent : OcclusionMode::Exact;
    occlusion->shown_index_ns =
        constants->profile.c1_ns + constants->profile.primitive_ns.value_or(0.0) / 3.0;
    return occlusion;
}

Work without_queries(Work work) {
    work.queries = 0.0;
    return work;
}

/// Everything a walk needs on the device, and the walk itself.
class Walk {
  public:
    Walk(const WalkOptions& options, const std::optional<UserConstants>& constants,
         const SceneAndPath& loaded, PreparedMethod& method, const gl::DeviceInfo& device)
        : options_(options),
          constants_(constants),
          scene_(loaded.scene),
          path_(loaded.path),
          method_(method),
          reference_(make_reference(loaded.scene)),
          bounds_(loaded.scene.bounds()),
          clip_depth_(device.clip_control ? ClipDepth::ReversedZeroToOne : ClipDepth::NegativeOneToOne) {
        object_boxes_ = scene_.object_boxes();
    }

    Status run(PictureSize size, WalkReport& report) {
        if (Status status = set_up(size, report); !status) return status;
        Progress progress;
        for (int i = 0; i < options_.warmup; ++i) {
            progress.show("warm-up", i, options_.warmup);
            draw_frame(0);
        }
        std::optional<RunningUpdate> running;
        if (constants_) running.emplace(constants_->profile);
        report.plan_hash = plan_hash({});
        for (int frame = 0; frame < options_.frames; ++frame) {
            progress.show("walking", frame, options_.frames);
            FrameRecord record = draw_frame(frame);
            if (running) {
                // Queries are priced apart, by what they asked about.
                const double query_ms = record.occlusion ? record.occlusion->query_ms : 0.0;
                const Work draws = without_queries(record.work);
                record.running_predicted_ms = 1e-6 * running->predict_ns(draws) + query_ms;
                if (record.frame_ms > query_ms) running->observe({draws, 1e6 * (record.frame_ms - query_ms)});
            }
            report.plan_hash = plan_hash(plan_, report.plan_hash);
            if (items_) record.visible_set_indices = visible_set_indices(frame);
            const bool checked = options_.check && frame % options_.check_every == 0;
            const bool pictured = options_.images && frame % options_.images_every == 0;
            if (checked || pictured)
                if (Status status = compare_with_everything(frame, checked, pictured, record); !status)
                    return status;
            report.frames.push_back(record);
        }
        report.blocking_reads = executor_->answer_counters().blocking_reads;
        report.lost_queries = executor_->answer_counters().lost;
        const std::string error = gl::take_error();
        return error.empty() ? success() : Status(Error{"OpenGL reported: " + error});
    }

  private:
    Status set_up(PictureSize size, WalkReport& report) {
        Result<gl::RenderTarget> target = gl::RenderTarget::create(size.width, size.height);
        if (!target) return Error{"--size: " + target.error().message};
        target_.emplace(std::move(target).value());
        Result<gl::Executor> executor = gl::Executor::create();
        if (!executor) return executor.error();
        executor_.emplace(std::move(executor).value());
        Result<gl::SceneBuffers> buffers = gl::SceneBuffers::upload(scene_, method_.static_indices());
        if (!buffers) return buffers.error();
        buffers_.emplace(std::move(buffers).value());
        const Result<gl::TimerCheck> timer = gl::check_gpu_timer();
        if (!timer) return timer.error();
        if (timer->gpu_timer_is_whole()) gpu_timer_.emplace();
        work_counter_.emplace();
        report.device.timer = gpu_timer_ ? "gpu" : "wall";
        if (options_.visible_set) {
            Result<gl::ItemBuffer> items = gl::ItemBuffer::create(size.width, size.height);
            if (!items) return Error{"--size: " + items.error().message};
            items_.emplace(std::move(items).value());
            list_leaves();
        }
        if (options_.images) {
            Result<ViewFromAbove> above = ViewFromAbove::create(size.width, size.height);
            if (!above) return above.error();
            above_.emplace(std::move(above).value());
        }
        return success();
    }

    [[nodiscard]] View culling_view_of(int frame) const {
        return view_of(std::min(frame, options_.freeze_culling.value_or(frame)));
    }

    [[nodiscard]] View view_of(int frame) const {
        const double aspect = static_cast<double>(target_->width()) / target_->height();
        return path_.view_of_frame(frame, options_.frames, aspect, clip_depth_);
    }

    /// One drawing of the frame; the first of several counts, all of them are timed.
    FrameRecord draw_once(int frame) {
        const View view = view_of(frame);
        const FrameInput input{
            culling_view_of(frame), scene_.origin, object_boxes_, {target_->width(), target_->height()}};
        gl::DrawOptions draw;
        draw.submission = options_.submission == "multi" ? gl::Submission::MultiDraw : gl::Submission::Plain;
        draw.counter = &*work_counter_;
        target_->begin(clip_depth_, kSky);
        gl::finish();
        FrameRecord record;
        record.frame = frame;
        const gl::WallTimer timer;
        method_.planner->absorb(answers_);
        method_.planner->plan(input, plan_);
        record.cull_ms = timer.elapsed_ms();
        if (gpu_timer_) gpu_timer_->begin();
        work_counter_->begin();
        const gl::FrameCounters counters = executor_->draw(plan_, *buffers_, view, draw);
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
        if (plan_.occlusion) count_occlusion(counters, record);
        if (constants_) {
            record.predicted_ms = 1e-6 * constants_->profile.predict_ns(without_queries(record.work));
            if (record.occlusion) *record.predicted_ms += record.occlusion->query_ms;
        }
        return record;
    }

    void count_object(ObjectId id, FrameRecord& record) const {
        ++(index_of(id) < scene_.dynamic_objects.size() ? record.visible_objects : record.visible_instances);
    }

    /// What hung on queries enters the work as far as the device drew it.
    void count_occlusion(const gl::FrameCounters& counters, FrameRecord& record) const {
        const gl::ExecutedDraws executed = gl::count_executed(plan_, *buffers_, answers_);
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
        FrameRecord record = draw_once(frame);
        std::vector<double> frame_ms{record.frame_ms}, cull_ms{record.cull_ms},
            gpu_ms{record.gpu_ms.value_or(0.0)};
        for (int i = 1; i < options_.repeats; ++i) {
            const FrameRecord again = draw_once(frame);
            frame_ms.push_back(again.frame_ms);
            cull_ms.push_back(again.cull_ms);
            gpu_ms.push_back(again.gpu_ms.value_or(0.0));
        }
        record.frame_ms = summarise(frame_ms).median;
        record.cull_ms = summarise(cull_ms).median;
        if (record.gpu_ms) record.gpu_ms = summarise(gpu_ms).median;
        return record;
    }

    /// The octree's leaves as items, in their batches' order.
    void list_leaves() {
        for (std::uint32_t i = 0; i < method_.octree->nodes().size(); ++i)
            if (method_.octree->is_leaf(NodeId{i}))
                for (const DrawRange& range : method_.octree->ranges(NodeId{i}))
                    leaves_.push_back({range, i});
        std::ranges::stable_sort(leaves_, {}, [](const gl::ItemRange& leaf) { return leaf.range.batch; });
    }

    [[nodiscard]] std::uint64_t visible_set_indices(int frame) {
        std::uint64_t indices = 0;
        for (const std::uint32_t leaf : items_->visible_items(leaves_, *buffers_, view_of(frame)))
            indices += 3 * std::uint64_t{method_.octree->node(NodeId{leaf}).triangle_count};
        return indices;
    }

    /// The frame just drawn against drawing everything; the oracle of `--check` and of the pictures.
    Status compare_with_everything(int frame, bool checked, bool pictured, FrameRecord& record) {
        const View view = view_of(frame);
        target_->read_depth(culled_depths_);
        std::optional<gl::Picture> culled;
        if (pictured) culled.emplace(target_->read_colour());
        reference_->plan({.culling_view = view, .scene_origin = scene_.origin, .object_boxes = object_boxes_},
                         everything_);
        target_->begin(clip_depth_, kSky);
        executor_->draw(everything_, *buffers_, view);
        target_->read_depth(reference_depths_);
        const std::size_t missing = gl::count_missing_pixels(culled_depths_, reference_depths_);
        if (checked) record.missing_pixels = missing;
        if (!pictured) return success();

        gl::Picture reference = target_->read_colour();
        gl::Picture difference = gl::difference_picture(reference, culled_depths_, reference_depths_);
        const View culling_view = culling_view_of(frame);
        std::vector<DrawRange> to_show;
        if (options_.method == "rhview")
            append_ranges_to_show(*method_.octree, make_frustum(culling_view, scene_.origin),
                                  make_viewpoint(culling_view, scene_.origin), to_show);
        gl::Picture above = above_->draw(everything_, plan_, answers_, to_show, *method_.planner, *buffers_,
                                         bounds_, culling_view, *executor_);
        culled->label(fmt::format("{}, frame {}: {} draw calls, {:.2f} M indices", options_.method, frame,
                                  record.work.draw_calls, record.work.indices * 1e-6));
        reference.label("everything drawn");
        difference.label(fmt::format("missing pixels (red): {}", missing));
        above.label(!plan_.queries.empty()
                        ? "from above: a colour per call, gaps violet; asked about: blue hidden, green seen"
                    : options_.method == "rhview"
                        ? "from above: a colour per call (replicas blue, green), gaps violet, rest grey"
                        : "from above: a colour per call, rest grey, nodes blue, frustum red");
        return gl::sheet(*culled, reference, difference, above)
            .save_png(*options_.images / fmt::format("frame_{:04}.png", frame));
    }

    const WalkOptions& options_;
    const std::optional<UserConstants>& constants_;
    const Scene& scene_;
    const CameraPath& path_;
    PreparedMethod& method_;
    std::unique_ptr<FramePlanner> reference_;
    Aabb bounds_;
    ClipDepth clip_depth_;
    std::vector<Aabb> object_boxes_;
    std::optional<gl::RenderTarget> target_;
    std::optional<gl::Executor> executor_;
    std::optional<gl::SceneBuffers> buffers_;
    std::optional<gl::GpuTimer> gpu_timer_;
    std::optional<gl::WorkCounter> work_counter_;
    std::optional<ViewFromAbove> above_;
    std::optional<gl::ItemBuffer> items_;
    std::vector<gl::ItemRange> leaves_;
    FramePlan plan_;
    std::vector<QueryAnswer> answers_;  ///< to the queries of the frame before
    FramePlan everything_;
    std::vector<float> culled_depths_;
    std::vector<float> reference_depths_;
};

WalkReport describe(const WalkOptions& options, const LoadedScene& loaded, const PreparedMethod& method,
                    const gl::DeviceInfo& device, PictureSize size) {
    const Scene& scene = loaded.scene;
    WalkReport report;
    report.scene = {scene.name,
                    scene.static_triangles(),
                    scene.dynamic_objects.size(),
                    scene.dynamic_triangles(),
                    scene.materials.size(),
                    scene.batches.size(),
                    scene.static_instances.size(),
                    scene.instance_triangles()};
    report.device = {device.renderer, device.version, "wall"};
    report.build.ms = method.build_ms;
    if (method.octree != nullptr) {
        report.build.nodes = method.octree->nodes().size();
        report.build.leaves = method.octree->leaf_count();
        report.build.replicas = method.octree->replicas().size();
        report.build.replica_bytes = method.octree->replica_bytes();
    }
    report.build.instancing = scene.instancing;
    report.build.index_bytes = scene.index_bytes();
    report.build.vertex_bytes = scene.vertex_bytes();
    report.method = options.method;
    report.mode = options.mode;
    report.submission = options.submission;
    report.occlusion = options.occlusion;
    report.leaf = method.max_leaf_triangles;
    if (loaded.baked) report.build.load_ms = loaded.baked->load_ms;
    report.width = size.width;
    report.height = size.height;
    return report;
}

Result<LoadedScene> load(const WalkOptions& options) {
    Result<LoadedScene> loaded = load_scene(options.scene, options.path);
    if (loaded && loaded->baked && options.leaf)
        return Error{fmt::format(
            "--leaf {}: {} brings its octree, with leaves of at most {} triangles; bake it again with "
            "another --leaf",
            *options.leaf, options.scene, loaded->baked->octree.options.max_leaf_triangles)};
    return loaded;
}

}  // namespace

Result<int> run_walk(const WalkOptions& options) {
    if (Status status = check_options(options); !status) return status.error();
    const Result<PictureSize> size = parse_size(options.size);
    if (!size) return size.error();
    const Result<WantedConstants> wanted = parse_constants(options.profile, options.set);
    if (!wanted) return wanted.error();
    Outputs outputs;
    if (Status status = outputs.open(options); !status) return status.error();

    Progress progress;
    Result<gl::Context> context = gl::Context::create_headless();
    if (!context) return context.error();
    progress.say("loading " + options.scene);
    Result<LoadedScene> loaded = load(options);
    if (!loaded) return loaded.error();
    progress.say("choosing timing constants");
    const Result<ChosenConstants> chosen =
        choose_constants(*wanted, options.scene, *loaded, context->device(), size->width, size->height);
    if (!chosen) return chosen.error();
    if (!chosen->warning.empty()) {
        progress.clear();
        fmt::print(stderr, "rhview: warning: {}\n", chosen->warning);
    }
    const std::optional<UserConstants>& constants = chosen->constants;
    progress.say("building");
    const gl::WallTimer settle_timer;
    if (Status status = settle_instances(*loaded, options.scene, options.instances, constants); !status)
        return status.error();
    const double settle_ms = settle_timer.elapsed_ms();
    MethodOptions method_options{options.leaf, options.replica_budget, {}, {}};
    if (constants) method_options.costs = draw_costs(constants->profile, options.submission == "multi");
    std::string why_no_occlusion;
    std::vector<std::uint32_t> object_indices;
    if (options.method == "rhview" || options.method == "rhview-seed") {
        const auto count = [&](const auto& placed) {
            const SceneMesh& mesh = loaded->scene.meshes[index_of(placed.mesh)];
            object_indices.push_back(static_cast<std::uint32_t>(mesh.indices.size()));
        };
        std::ranges::for_each(loaded->scene.dynamic_objects, count);
        std::ranges::for_each(loaded->scene.static_instances, count);
        Result<std::optional<OcclusionOptions>> occlusion =
            choose_occlusion(options, *wanted, constants, *size, why_no_occlusion);
        if (!occlusion) return occlusion.error();
        method_options.occlusion = *occlusion;
        if (method_options.occlusion) method_options.occlusion->object_indices = object_indices;
    }
    Result<PreparedMethod> method = prepare_method(options.method, loaded->scene, method_options,
                                                   loaded->baked ? &loaded->baked->octree : nullptr);
    if (!method) return method.error();

    WalkReport report = describe(options, *loaded, *method, context->device(), *size);
    report.why_no_occlusion = why_no_occlusion;
    if (method_options.occlusion) report.query_costs = method_options.occlusion->costs;
    if (!loaded->baked) report.build.settle_ms = settle_ms;
    if (constants)
        report.profile = {constants->profile, constants->source, constants->told};
    else
        report.why_no_profile = chosen->why_not;
    {
        Walk walk(options, constants, *loaded, *method, context->device());
        if (Status status = walk.run(*size, report); !status) return status.error();
    }
    if (Status status = outputs.commit(report); !status) return status.error();
    progress.clear();
    fmt::print("{}", to_table(report));
    return report.missing_pixels() > 0 && options.mode == "exact" ? kCheckFailed : kDone;
}

}  // namespace rhview::cli
