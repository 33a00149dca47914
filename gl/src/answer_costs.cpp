// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/answer_costs.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include "rhview/gl/context.h"
#include "rhview/gl/executor.h"
#include "rhview/gl/timer.h"
#include "rhview/scenes/scene_builder.h"
#include "state_guard.h"

namespace rhview::gl {
namespace {

constexpr double kFovY = 1.0;
constexpr double kDistance = 20.0;  ///< of the boxes, metres

/// One point of the design, for each way.
struct Design {
    int queries, boxes_per_query;
    double side;  ///< of a box, of the picture's height
    int draws_per_query;
};
constexpr double kSmall = 0.004, kMiddle = 0.03, kLarge = 0.1;
constexpr Design kDesign[] = {
    {1, 1, kSmall, 0},   {30, 1, kSmall, 0},   {300, 1, kSmall, 0},  {20, 10, kSmall, 0},
    {60, 30, kSmall, 0}, {100, 1, kMiddle, 0}, {40, 10, kMiddle, 0}, {60, 1, kLarge, 0},
    {10, 10, kLarge, 0}, {150, 1, kSmall, 1},  {40, 1, kSmall, 10},  {20, 10, kMiddle, 4},
};

struct Frame {
    AskedFrame asked;
    FramePlan plan;
    std::vector<double> times_ns;
};

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

View view_of(const RenderTarget& target) {
    const double aspect = static_cast<double>(target.width()) / target.height();
    return {look_along({0, 0, 0}, {0, 0, -1}, {0, 1, 0}),
            perspective(kFovY, aspect, 0.1, 1000.0, ClipDepth::NegativeOneToOne),
            ClipDepth::NegativeOneToOne};
}

/// Squares at random places: every fourth query's in the right quarter of the picture, which is free, the
/// others' in the left half, where all is hidden.
class Designer {
  public:
    Designer(const RenderTarget& target, std::uint32_t seed)
        : height_(target.height()),
          half_height_m_(kDistance * std::tan(0.5 * kFovY)),
          half_width_m_(half_height_m_ * target.width() / target.height()),
          random_(seed) {}

    Frame frame(const Design& design, QueryWay way) {
        Frame frame;
        frame.asked.way = way;
        for (int q = 0; q < design.queries; ++q) {
            const bool seen = q % 4 == 3;
            const auto first = static_cast<std::uint32_t>(frame.plan.query_boxes.size());
            frame.plan.queries.push_back({static_cast<std::uint64_t>(q), first,
                                          static_cast<std::uint32_t>(design.boxes_per_query), way, false});
            for (int b = 0; b < design.boxes_per_query; ++b)
                frame.plan.query_boxes.push_back(square(design.side, seen));
            for (int d = 0; d < design.draws_per_query && !seen; ++d)
                frame.plan.conditional.push_back({{BatchId{0}, 0, 3}, static_cast<std::uint32_t>(q)});
        }
        const double side_px = std::max(1.0, design.side * height_);
        frame.asked.queries = design.queries;
        frame.asked.boxes = static_cast<double>(frame.plan.query_boxes.size());
        frame.asked.pixels = frame.asked.boxes * side_px * side_px;
        frame.asked.draws = static_cast<double>(frame.plan.conditional.size());
        return frame;
    }

  private:
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
    }

    Aabb square(double side, bool seen) {
        const double side_m = 2.0 * side * half_height_m_;
        const double left = seen ? 0.5 * half_width_m_ : -half_width_m_;
        const double right = seen ? half_width_m_ : 0.0;
        const glm::vec3 corner(uniform(left, right - side_m),
                               uniform(-half_height_m_, half_height_m_ - side_m), -kDistance);
        return {corner, corner + glm::vec3(static_cast<float>(side_m), static_cast<float>(side_m), 0.0f)};
    }

    double height_, half_height_m_, half_width_m_;
    std::mt19937 random_;
};

/// Nearest depth in the left half: whatever is asked about there is hidden.
void hide_left_half(const RenderTarget& target) {
    const GLboolean scissor_test = glIsEnabled(GL_SCISSOR_TEST);
    GLint box[4] = {};
    glGetIntegerv(GL_SCISSOR_BOX, box);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, target.width() / 2, target.height());
    const GLfloat nearest = 0.0f;
    glClearBufferfv(GL_DEPTH, 0, &nearest);
    glScissor(box[0], box[1], box[2], box[3]);
    if (scissor_test == GL_FALSE) glDisable(GL_SCISSOR_TEST);
}

Result<SceneBuffers> one_triangle() {
    const std::array<glm::vec3, 3> positions{glm::vec3(-1, -1, -5), {1, -1, -5}, {0, 1, -5}};
    const std::array<std::uint32_t, 3> indices{0, 1, 2};
    SceneBuilder builder;
    builder.add_static(builder.add_material({}), {positions, {}, {}, indices});
    const Result<Scene> scene = builder.finish("one triangle");
    if (!scene) return scene.error();
    return SceneBuffers::upload(*scene);
}

/// Times all frames in shuffled rounds.
void time_frames(std::vector<Frame>& frames, const SceneBuffers& scene, Executor& executor,
                 RenderTarget& target, const AnswerCostOptions& options) {
    const View view = view_of(target);
    std::vector<QueryAnswer> answers;
    const WallTimer clock;
    std::mt19937 random(options.seed);
    std::vector<std::size_t> order(frames.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (int round = -1; round < options.rounds; ++round) {
        for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
        for (const std::size_t i : order) {
            if (round > 0 && clock.elapsed_ms() > 1e3 * options.longest_s) return;
            target.begin(view.clip_depth, glm::vec3(0.0f));
            hide_left_half(target);
            finish();
            const WallTimer timer;
            executor.draw(frames[i].plan, scene, view);
            finish();
            // The round before the first warms up.
            if (round >= 0) frames[i].times_ns.push_back(1e6 * timer.elapsed_ms());
            answers.clear();
            executor.poll_answers(answers);
        }
    }
}

}  // namespace

AnswerCosts fit_answer_costs(const std::vector<AskedFrame>& frames) {
    constexpr std::size_t kTerms = 5;
    constexpr int kSweeps = 20'000;
    const auto row = [](const AskedFrame& f) {
        return std::array<double, kTerms>{1.0, f.queries, f.boxes, f.pixels, f.draws};
    };
    // Normal equations of relative residuals, columns scaled; then the least non-negative solution by
    // coordinate descent, which converges for any convex quadratic.
    std::array<std::array<double, kTerms>, kTerms> matrix{};
    std::array<double, kTerms> right{}, solution{};
    for (const AskedFrame& frame : frames) {
        constexpr double kNoiseNs = 10'000.0;  ///< of a frame's time: shorter ones are not trusted more
        const double weight = 1.0 / std::max(frame.ns, kNoiseNs);
        const std::array<double, kTerms> a = row(frame);
        for (std::size_t i = 0; i < kTerms; ++i) {
            right[i] += weight * weight * a[i] * frame.ns;
            for (std::size_t j = 0; j < kTerms; ++j) matrix[i][j] += weight * weight * a[i] * a[j];
        }
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (std::size_t i = 0; i < kTerms; ++i) {
            if (matrix[i][i] <= 0.0) continue;
            double rest = right[i];
            for (std::size_t j = 0; j < kTerms; ++j)
                if (j != i) rest -= matrix[i][j] * solution[j];
            solution[i] = std::max(0.0, rest / matrix[i][i]);
        }
    return {solution[0], solution[1], solution[2], solution[3], solution[4]};
}

Result<MeasuredAnswerCosts> measure_answer_costs(RenderTarget& target, const AnswerCostOptions& options) {
    RHVIEW_ASSERT(options.rounds > 0);
    take_error();
    const TargetGuard guard;
    Result<Executor> executor = Executor::create();
    if (!executor) return executor.error();
    const Result<SceneBuffers> scene = one_triangle();
    if (!scene) return scene.error();
    Designer designer(target, options.seed);
    std::vector<Frame> frames(1);  // The first asks nothing.
    for (const QueryWay way : {QueryWay::HardwareQuery, QueryWay::BoxPass})
        if (way == QueryWay::HardwareQuery || executor->has_box_pass())
            for (const Design& design : kDesign) frames.push_back(designer.frame(design, way));
    time_frames(frames, *scene, *executor, target, options);
    if (const std::string error = take_error(); !error.empty())
        return Error{"the driver reported an error while queries were timed (" + error +
                     "); what they cost is not known"};

    MeasuredAnswerCosts measured;
    std::vector<AskedFrame> of_way[2];
    const double idle_ns = median(frames[0].times_ns);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        frames[i].asked.ns = std::max(0.0, median(frames[i].times_ns) - idle_ns);
        measured.frames.push_back(frames[i].asked);
        of_way[static_cast<std::size_t>(frames[i].asked.way)].push_back(frames[i].asked);
    }
    measured.costs.hardware = fit_answer_costs(of_way[0]);
    measured.costs.box_pass.frame_ns = kImpossibleNs;
    if (executor->has_box_pass()) measured.costs.box_pass = fit_answer_costs(of_way[1]);
    return measured;
}

}  // namespace rhview::gl
