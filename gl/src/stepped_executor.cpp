// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/stepped_executor.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <tuple>

#include "box_drawer.h"
#include "object_drawer.h"
#include "raster_precision.h"
#include "rhview/base/assert.h"
#include "state_guard.h"

namespace rhview::gl {
namespace {

constexpr GLenum kTarget = GL_ANY_SAMPLES_PASSED_CONSERVATIVE;

/// Adds the time that it lives.
class Stopwatch {
  public:
    explicit Stopwatch(double& ms) : ms_(ms), start_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() {
        ms_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

  private:
    double& ms_;
    std::chrono::steady_clock::time_point start_;
};

/// Of all objects: any of them may be asked about.
double largest_growth(const SceneBuffers& scene, std::span<const glm::dmat4> placements) {
    double growth = 1.0;
    for (std::size_t i = 0; i < scene.placements().size(); ++i)
        growth =
            std::max(growth, rounding_growth(i < placements.size() ? placements[i] : scene.placements()[i]));
    return growth;
}

}  // namespace

struct SteppedExecutor::State {
    enum class Drawing { Nothing, Static, Objects, Boxes };
    static constexpr std::uint32_t kNoBatch = 0xffffffffu;

    State(Executor& used, BoxDrawer box_drawer) : executor(used), drawer(std::move(box_drawer)) {}

    /// Takes an object that no query uses, and begins.
    QueryHandle begin_query() {
        if (free.empty()) {
            GLuint name = 0;
            glGenQueries(1, &name);
            free.push_back(static_cast<std::uint32_t>(queries.size()));
            queries.emplace_back(name);
        }
        const std::uint32_t slot = free.back();
        free.pop_back();
        glBeginQuery(kTarget, queries[slot].name());
        ++counters.queries;
        ++answers.asked;
        return QueryHandle{slot};
    }

    /// Whether state of another kind of draw was set.
    bool change_to(Drawing next) {
        if (drawing == next) return false;
        if (drawing == Drawing::Boxes) {
            glDepthMask(GL_TRUE);
            query_guard->put_back_raster_state();
        }
        drawing = next;
        batch = kNoBatch;
        return true;
    }

    void use_boxes() {
        if (change_to(Drawing::Boxes)) drawer.begin(*widener, BoxDrawer::Effect::None);
    }

    void draw_ranges(std::span<const DrawRange> ranges) {
        if (ranges.empty()) return;
        if (change_to(Drawing::Static)) executor.begin_static(view, scene->origin(), options);
        for (std::size_t first = 0; first < ranges.size();) {
            std::size_t end = first + 1;
            while (end < ranges.size() && ranges[end].batch == ranges[first].batch) ++end;
            const std::span<const DrawRange> run = ranges.subspan(first, end - first);
            if (const auto next = static_cast<std::uint32_t>(run.front().batch); next != batch) {
                Executor::set_state(scene->batches()[next]);
                ++counters.material_changes;
                batch = next;
            }
            counters.draw_calls += executor.draw_ranges(run, options.submission);
            counters.sub_draws += run.size();
            for (const DrawRange& range : run) counters.indices += range.index_count;
            first = end;
        }
    }

    /// What shares mesh and level stands together, and so shares a call.
    void choose_levels() {
        placed.object_levels.clear();
        if (options.object_levels.empty()) return;
        const auto level_of = [&](ObjectId id) { return options.object_levels[index_of(id)]; };
        std::ranges::sort(placed.objects, {}, [&](ObjectId id) {
            return std::tuple(scene->object_meshes()[index_of(id)], level_of(id), id);
        });
        for (const ObjectId id : placed.objects) placed.object_levels.push_back(level_of(id));
    }

    void draw_objects(std::span<const ObjectId> ids) {
        if (ids.empty()) return;
        ObjectDrawer& objects = *executor.objects_;
        placed.objects.assign(ids.begin(), ids.end());
        choose_levels();
        objects.place(placed, *scene, view, options.placements);
        if (change_to(Drawing::Objects)) objects.begin(options.colour);
        for (const ObjectRun& run : objects.at_once()) {
            objects.set_state(run);
            ObjectDrawer::draw(run);
            ++counters.material_changes;
            ++counters.draw_calls;
            ++counters.sub_draws;
            ++counters.object_draws;
            counters.instances += run.instances;
            counters.indices += run.indices();
        }
    }

    Executor& executor;
    BoxDrawer drawer;
    int subpixels = 8;
    std::vector<Query> queries;
    std::vector<std::uint32_t> free;  ///< into `queries`
    AnswerCounters answers;

    // Of the frame:
    const SceneBuffers* scene = nullptr;
    View view;
    DrawOptions options;
    std::optional<StateGuard> guard;
    std::optional<QueryStateGuard> query_guard;
    std::optional<BoxWidener> widener;
    Drawing drawing = Drawing::Nothing;
    std::uint32_t batch = kNoBatch;  ///< whose state is set
    FramePlan placed;                ///< the objects of one call
    FrameCounters counters;
    double device_ms = 0.0;
    std::vector<BoxInstance> boxes;
};

SteppedExecutor::SteppedExecutor(std::unique_ptr<State> state) : state_(std::move(state)) {}
SteppedExecutor::SteppedExecutor(SteppedExecutor&&) noexcept = default;
SteppedExecutor& SteppedExecutor::operator=(SteppedExecutor&&) noexcept = default;
SteppedExecutor::~SteppedExecutor() = default;

Result<SteppedExecutor> SteppedExecutor::create(Executor& executor) {
    const StateGuard guard(executor.clip_control_);
    Result<BoxDrawer> drawer = BoxDrawer::create(false);
    if (!drawer) return drawer.error();
    auto state = std::make_unique<State>(executor, std::move(drawer).value());
    state->subpixels = subpixel_bits();
    return SteppedExecutor(std::move(state));
}

void SteppedExecutor::begin(const SceneBuffers& scene, const View& view, const DrawOptions& options) {
    State& s = *state_;
    RHVIEW_ASSERT(!s.guard);
    s.device_ms = 0.0;
    const Stopwatch watch(s.device_ms);
    s.scene = &scene;
    s.view = view;
    s.options = options;
    s.counters = {};
    s.guard.emplace(s.executor.clip_control_);
    s.query_guard.emplace();
    s.widener.emplace(view, scene.origin(), bound_raster_precision(s.subpixels),
                      largest_growth(scene, options.placements));
    s.executor.begin(view);
    s.drawing = State::Drawing::Nothing;
}

FrameCounters SteppedExecutor::end() {
    State& s = *state_;
    const Stopwatch watch(s.device_ms);
    s.query_guard.reset();
    s.guard.reset();
    return s.counters;
}

void SteppedExecutor::draw(std::span<const DrawRange> ranges, std::span<const ObjectId> objects) {
    const Stopwatch watch(state_->device_ms);
    state_->draw_ranges(ranges);
    state_->draw_objects(objects);
}

QueryHandle SteppedExecutor::draw_and_ask(std::span<const DrawRange> ranges,
                                          std::span<const ObjectId> objects) {
    const Stopwatch watch(state_->device_ms);
    const QueryHandle handle = state_->begin_query();
    state_->draw_ranges(ranges);
    state_->draw_objects(objects);
    glEndQuery(kTarget);
    return handle;
}

void SteppedExecutor::ask(std::span<const BoxQuery> queries, std::span<const Aabb> boxes,
                          std::vector<QueryHandle>& handles) {
    State& s = *state_;
    const Stopwatch watch(s.device_ms);
    if (queries.empty()) return;
    s.boxes.clear();
    for (const Aabb& box : boxes) s.boxes.push_back(s.widener->widen(box, 0));
    const std::uint32_t first = s.drawer.append(s.boxes);
    s.use_boxes();
    for (const BoxQuery& query : queries) {
        RHVIEW_ASSERT(query.box_count > 0 && query.first_box + query.box_count <= boxes.size());
        handles.push_back(s.begin_query());
        BoxDrawer::draw(first + query.first_box, query.box_count);
        glEndQuery(kTarget);
        ++s.counters.query_draw_calls;
        s.counters.query_boxes += query.box_count;
    }
}

bool SteppedExecutor::has_answer(QueryHandle query) {
    const Stopwatch watch(state_->device_ms);
    GLuint available = GL_FALSE;
    glGetQueryObjectuiv(state_->queries[index_of(query)].name(), GL_QUERY_RESULT_AVAILABLE, &available);
    return available != GL_FALSE;
}

bool SteppedExecutor::take_answer(QueryHandle query) {
    if (!has_answer(query)) ++state_->answers.blocking_reads;
    const Stopwatch watch(state_->device_ms);
    GLuint seen = GL_TRUE;
    glGetQueryObjectuiv(state_->queries[index_of(query)].name(), GL_QUERY_RESULT, &seen);
    ++state_->answers.answered;
    state_->free.push_back(static_cast<std::uint32_t>(query));
    return seen != GL_FALSE;
}

const AnswerCounters& SteppedExecutor::answer_counters() const {
    return state_->answers;
}

double SteppedExecutor::device_ms() const {
    return state_->device_ms;
}

}  // namespace rhview::gl
