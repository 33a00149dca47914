// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <algorithm>

#include "constants.h"
#include "frame_pictures.h"
#include "instances.h"
#include "method.h"
#include "output_file.h"
#include "picture_size.h"
#include "progress.h"
#include "rhview/gl/context.h"
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
    if (options.mode != "exact")
        return Error{fmt::format("--mode {}: unknown; the only mode is exact", options.mode)};
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
                record.running_predicted_ms = 1e-6 * running->predict_ns(record.work);
                running->observe({record.work, 1e6 * record.frame_ms});
            }
            report.plan_hash = plan_hash(plan_, report.plan_hash);
            const bool checked = options_.check && frame % options_.check_every == 0;
            const bool pictured = options_.images && frame % options_.images_every == 0;
            if (checked || pictured)
                if (Status status = compare_with_everything(frame, checked, pictured, record); !status)
                    return status;
            report.frames.push_back(record);
        }
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
        const FrameInput input{culling_view_of(frame), scene_.origin, object_boxes_};
        gl::DrawOptions draw;
        draw.submission = options_.submission == "multi" ? gl::Submission::MultiDraw : gl::Submission::Plain;
        target_->begin(clip_depth_, kSky);
        gl::finish();
        FrameRecord record;
        record.frame = frame;
        const gl::WallTimer timer;
        method_.planner->plan(input, plan_);
        record.cull_ms = timer.elapsed_ms();
        if (gpu_timer_) gpu_timer_->begin();
        work_counter_->begin();
        const gl::FrameCounters counters = executor_->draw(plan_, *buffers_, view, draw);
        work_counter_->end();
        if (gpu_timer_) gpu_timer_->end();
        gl::finish();
        record.frame_ms = timer.elapsed_ms();
        if (gpu_timer_) record.gpu_ms = gpu_timer_->read_ms();
        record.work = gl::work_of(counters);
        work_counter_->read(record.work);
        record.nodes_visited = plan_.nodes_visited;
        for (const ObjectId id : plan_.objects)
            ++(index_of(id) < scene_.dynamic_objects.size() ? record.visible_objects
                                                            : record.visible_instances);
        if (constants_) record.predicted_ms = 1e-6 * constants_->profile.predict_ns(record.work);
        return record;
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
        gl::Picture above = above_->draw(everything_, plan_, to_show, *method_.planner, *buffers_, bounds_,
                                         culling_view, *executor_);
        culled->label(fmt::format("{}, frame {}: {} draw calls, {:.2f} M indices", options_.method, frame,
                                  record.work.draw_calls, record.work.indices * 1e-6));
        reference.label("everything drawn");
        difference.label(fmt::format("missing pixels (red): {}", missing));
        above.label(options_.method == "rhview"
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
    FramePlan plan_;
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
    MethodOptions method_options{options.leaf, options.replica_budget, {}};
    if (constants) method_options.costs = draw_costs(constants->profile, options.submission == "multi");
    Result<PreparedMethod> method = prepare_method(options.method, loaded->scene, method_options,
                                                   loaded->baked ? &loaded->baked->octree : nullptr);
    if (!method) return method.error();

    WalkReport report = describe(options, *loaded, *method, context->device(), *size);
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
    return report.missing_pixels() > 0 ? kCheckFailed : kDone;
}

}  // namespace rhview::cli
