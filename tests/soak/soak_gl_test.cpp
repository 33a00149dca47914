// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Two views of a world whose objects come and go, in windows that change their size, for a long time: what is
// drawn misses nothing, and nothing grows. A few hundred frames; RHVIEW_SOAK_FRAMES=100000 runs as many.

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <optional>

#include "device_objects.h"
#include "faults/failing_memory.h"
#include "rhview/baselines/draw_everything.h"
#include "rhview/gl/context.h"
#include "rhview/gl/executor.h"
#include "rhview/gl/render_target.h"
#include "rhview/pipeline/plan_views.h"
#include "rhview/pipeline/rhview_planner.h"
#include "rhview/pipeline/visibility_report.h"
#include "soak_world.h"

namespace rhview {
namespace {

constexpr DrawCosts kCosts{1.0, 120.0, 0.0};
constexpr std::uint64_t kResizeEvery = 40;    ///< frames
constexpr std::uint64_t kReopenEvery = 1000;  ///< the second window is closed, and another one opened

std::uint64_t frames_wanted() {
    const char* text = std::getenv("RHVIEW_SOAK_FRAMES");
    return text != nullptr ? std::strtoull(text, nullptr, 10) : 400;
}

/// Resident memory of the process, KiB.
std::uint64_t resident_kib() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t pages = 0, resident = 0;
    file >> pages >> resident;
    return resident * 4;
}

/// What must not grow.
struct Footprint {
    std::int64_t blocks = 0;     ///< from `operator new`
    std::uint64_t heap_kib = 0;  ///< in use, of the C library's: the driver's too
    std::uint64_t resident_kib = 0;
    DeviceObjects device;
};

std::uint64_t heap_in_use_kib() {
    return mallinfo2().uordblks / 1024;
}

Footprint footprint() {
    gl::finish();  // what is under way has memory of its own
    return {blocks_in_use(), heap_in_use_kib(), resident_kib(), count_device_objects()};
}

std::ostream& operator<<(std::ostream& out, const Footprint& f) {
    return out << f.blocks << " blocks, " << f.heap_kib << " KiB of heap, " << f.resident_kib
               << " KiB resident, " << f.device.buffers << " buffers, " << f.device.vertex_arrays
               << " vertex arrays, " << f.device.programs << " programs, " << f.device.framebuffers
               << " framebuffers, " << f.device.renderbuffers << " renderbuffers, " << f.device.textures
               << " textures, " << f.device.queries << " queries";
}

OcclusionOptions occlusion_of(bool box_pass, std::span<const std::uint32_t> object_indices) {
    OcclusionOptions options;
    options.shown_index_ns = 4.0;
    options.costs = {{.query_ns = 20.0, .box_ns = 1.0, .draw_ns = 3.0},
                     {.query_ns = 10.0, .box_ns = 2.0, .draw_ns = 3.0}};
    if (!box_pass) options.costs.box_pass.frame_ns = 1e12;
    options.object_indices = object_indices;
    return options;
}

/// A window of the application: a planner, what draws its plans, and a surface.
struct Window {
    Window(int which, const RhOctree& octree, std::span<const std::uint32_t> object_indices)
        : number(which),
          planner(octree, kCosts, occlusion_of(which == 0, object_indices)),
          executor(gl::Executor::create().value()) {
        resize(0);
    }

    void resize(std::uint64_t turn) {
        const std::uint64_t step = (turn + 3 * static_cast<std::uint64_t>(number)) % 7;
        target.emplace(
            gl::RenderTarget::create(64 + 16 * static_cast<int>(step), 48 + 12 * static_cast<int>(6 - step))
                .value());
    }
    [[nodiscard]] glm::ivec2 size() const { return {target->width(), target->height()}; }

    int number;
    RhviewPlanner planner;
    gl::Executor executor;
    std::optional<gl::RenderTarget> target;
    VisibilityReport report;
    FrameInput input;
    FramePlan plan;
    std::vector<QueryAnswer> answers;
};

class Soak {
  public:
    Soak()
        : octree_(build_octree(world_.scene().triangle_batches(), options()).value()),
          buffers_(gl::SceneBuffers::upload(world_.scene(), octree_.indices()).value()),
          object_indices_(indices_of_objects(world_.scene())) {
        windows_.reserve(2);
        for (const int which : {0, 1}) windows_.emplace_back(which, octree_, object_indices_);
        for (const SceneBatch& batch : world_.scene().batches)
            counts_.push_back(static_cast<std::uint32_t>(batch.indices.size()));
    }

    void frame(std::uint64_t number, bool is_compared) {
        world_.begin_frame(number);
        if (number % kReopenEvery == kReopenEvery / 4) {
            windows_.pop_back();
            windows_.emplace_back(1, octree_, object_indices_);
        }
        for (Window& window : windows_) {
            if (number % kResizeEvery == 0) window.resize(number / kResizeEvery);
            window.input = world_.input(SoakWorld::camera(window.number, number), window.size());
            window.answers.clear();
            window.executor.poll_answers(window.answers);
            hidden +=
                static_cast<std::uint64_t>(std::ranges::count(window.answers, false, &QueryAnswer::visible));
        }
        plan();
        for (Window& window : windows_) {
            draw(window);
            if (is_compared) compare(window);
        }
        world_.end_frame(windows_[0].plan, windows_[1].plan);
    }

    [[nodiscard]] const SoakWorld& world() const { return world_; }

    std::uint64_t compared = 0, missing = 0, covered = 0, hidden = 0, conditional = 0;
    std::vector<float> plan_us;  ///< of both views, by frame

  private:
    static OctreeOptions options() {
        OctreeOptions options;
        options.max_leaf_triangles = 24;
        options.replica_budget = 0.5;
        options.costs = kCosts;
        return options;
    }

    static std::vector<std::uint32_t> indices_of_objects(const Scene& scene) {
        std::vector<std::uint32_t> indices;
        for (std::uint32_t i = 0; i < scene.object_count(); ++i)
            indices.push_back(static_cast<std::uint32_t>(
                scene.meshes[index_of(scene.object_mesh(ObjectId{i}))].indices.size()));
        return indices;
    }

    void plan() {
        const auto start = std::chrono::steady_clock::now();
        std::vector<ViewToPlan>& views = views_;
        views.clear();
        for (Window& window : windows_) {
            window.report.absorb(window.answers);
            window.planner.absorb(window.answers);
            views.push_back({&window.planner, &window.input, &window.plan});
        }
        plan_views(views);
        for (Window& window : windows_) window.report.update(window.input, window.plan);
        plan_us.push_back(
            std::chrono::duration<float, std::micro>(std::chrono::steady_clock::now() - start).count());
    }

    void draw(Window& window) {
        world_.place_planned(window.plan);
        conditional += window.plan.conditional.size() + window.plan.conditional_objects.size();
        gl::DrawOptions draw_options;
        draw_options.placements = world_.placements();
        window.target->begin(window.input.culling_view.clip_depth, glm::vec3(0.0f));
        window.executor.draw(window.plan, buffers_, window.input.culling_view, draw_options);
    }

    void compare(Window& window) {
        window.target->read_depth(depths_);
        world_.place_all();
        const View& view = window.input.culling_view;
        DrawEverything everything(counts_, world_.scene().bounds());
        everything.plan(world_.exact_input(view, window.size()), everything_);
        gl::DrawOptions draw_options;
        draw_options.placements = world_.placements();
        window.target->begin(view.clip_depth, glm::vec3(0.0f));
        window.executor.draw(everything_, buffers_, view, draw_options);
        window.target->read_depth(reference_);
        missing += gl::count_missing_pixels(depths_, reference_);
        const float farthest = view.clip_depth == ClipDepth::ReversedZeroToOne ? 0.0f : 1.0f;
        covered += reference_.size() - static_cast<std::size_t>(std::ranges::count(reference_, farthest));
        ++compared;
    }

    SoakWorld world_;
    RhOctree octree_;
    gl::SceneBuffers buffers_;
    std::vector<std::uint32_t> object_indices_;
    std::vector<Window> windows_;
    std::vector<ViewToPlan> views_;
    std::vector<std::uint32_t> counts_;
    FramePlan everything_;
    std::vector<float> depths_, reference_;
};

template <class Number>
Number median(std::span<const Number> all) {
    std::vector<Number> sorted(all.begin(), all.end());
    std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2));
    return sorted[sorted.size() / 2];
}

TEST(Soak, nothing_is_missing_and_nothing_grows) {
    Result<gl::Context> context = gl::Context::create_headless();
    ASSERT_TRUE(context.ok()) << context.error().message;
    const std::uint64_t frames = frames_wanted(), tenth = frames / 10;
    Footprint early, late;
    std::vector<std::uint64_t> heap_kib[11];  ///< by tenth
    {
        Soak soak;
        soak.plan_us.reserve(frames);
        for (std::uint64_t number = 0; number < frames; ++number) {
            if (number == 2 * tenth) early = footprint();
            // The driver's heap swings by a megabyte or two: its median tells whether it grows.
            if (number % std::max<std::uint64_t>(tenth / 20, 1) == 0)
                heap_kib[number / tenth].push_back(heap_in_use_kib());
            soak.frame(number, number % (frames > 10'000 ? 100 : 20) == 0);
        }
        late = footprint();
        early.heap_kib = median<std::uint64_t>(heap_kib[2]);
        late.heap_kib = median<std::uint64_t>(heap_kib[9]);
        const float first = median(std::span<const float>(soak.plan_us).subspan(tenth, tenth));
        const float last = median(std::span<const float>(soak.plan_us).last(tenth));
        std::cout << frames << " frames of two views, " << soak.compared << " compared, " << soak.covered
                  << " covered pixels, " << soak.missing << " missing; " << soak.world().came() << " came, "
                  << soak.world().went() << " went, " << soak.world().slept() << " slept; "
                  << soak.conditional << " conditional draws, " << soak.hidden
                  << " hidden answers; planning took " << first << " us in the second tenth, " << last
                  << " us in the last\n  after two tenths: " << early << "\n  at the end: " << late << '\n';
        EXPECT_EQ(soak.missing, 0u);
        EXPECT_GT(soak.covered, 500 * soak.compared);
        EXPECT_GT(soak.hidden, frames / 10);
        EXPECT_GT(soak.conditional, frames);
        EXPECT_GT(soak.world().went(), frames / 20);
        EXPECT_GT(soak.world().slept(), frames / 10);
        EXPECT_EQ(soak.world().movers().broken_promises(), 0u);
        if (frames >= 10'000) {
            EXPECT_LT(last, 1.5f * first);
        }
    }
    // What is kept for use again may grow with the largest frame, which comes late by chance: never by much.
    EXPECT_LE(late.blocks, early.blocks + 50);
    EXPECT_LE(late.heap_kib, early.heap_kib + 2048);
    EXPECT_LE(late.device.without_queries(), early.device.without_queries());
    EXPECT_LE(late.device.queries, early.device.queries + early.device.queries / 2 + 32);
    EXPECT_EQ(count_device_objects(), DeviceObjects());
    EXPECT_EQ(gl::take_error(), "");
}

}  // namespace
}  // namespace rhview
