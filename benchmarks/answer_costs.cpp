// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// What asking costs on this machine, and what it saves: 1,000 nodes of 400 triangles behind a wall, and in
// view, drawn at once or behind queries. Medians of interleaved rounds, as CSV.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "rhview/gl/answer_costs.h"
#include "rhview/gl/context.h"
#include "rhview/gl/executor.h"
#include "rhview/gl/timer.h"
#include "rhview/scenes/scene_builder.h"

namespace {

using namespace rhview;

constexpr int kColumns = 40, kRows = 25;
constexpr std::uint32_t kWallIndices = 6;
constexpr int kRounds = 41;

/// A wavy patch of 400 triangles, 1 m wide.
struct Patch {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    Patch() {
        constexpr std::uint32_t kX = 20, kY = 10;
        for (std::uint32_t y = 0; y <= kY; ++y)
            for (std::uint32_t x = 0; x <= kX; ++x)
                positions.emplace_back(static_cast<float>(x) / kX, static_cast<float>(y) / kY,
                                       0.2f * static_cast<float>((x + y) % 2));
        for (std::uint32_t y = 0; y < kY; ++y)
            for (std::uint32_t x = 0; x < kX; ++x) {
                const std::uint32_t a = y * (kX + 1) + x, b = a + kX + 1;
                for (const std::uint32_t i : {a, a + 1, b + 1, a, b + 1, b}) indices.push_back(i);
            }
    }
};

Scene wall_and_nodes() {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    const std::vector<glm::vec3> corners{{-40, -25, -10}, {40, -25, -10}, {40, 25, -10}, {-40, 25, -10}};
    const std::vector<std::uint32_t> quad{0, 1, 2, 0, 2, 3};
    builder.add_static(material, {corners, {}, {}, quad});
    const Patch patch;
    for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < kColumns; ++x)
            builder.add_static(
                material, {patch.positions, {}, {}, patch.indices},
                glm::translate(glm::dmat4(1.0), {1.1 * (x - kColumns / 2), 1.1 * (y - kRows / 2), -30.0}));
    return builder.finish("wall and nodes").value();
}

enum class Asked { Nothing, Hardware, BoxPass };

FramePlan plan_of(const Scene& scene, bool with_wall, Asked asked, std::size_t boxes_per_query) {
    FramePlan plan;
    if (with_wall) plan.opaque.push_back({BatchId{0}, 0, kWallIndices});
    const auto& objects = scene.batches[0].objects.span();
    for (std::size_t i = 1; i < objects.size(); ++i) {
        const DrawRange range{BatchId{0}, objects[i].first_index, objects[i].index_count};
        if (asked == Asked::Nothing) {
            plan.opaque.push_back(range);
            continue;
        }
        if ((i - 1) % boxes_per_query == 0)
            plan.queries.push_back({i, static_cast<std::uint32_t>(plan.query_boxes.size()), 0,
                                    asked == Asked::BoxPass ? QueryWay::BoxPass : QueryWay::HardwareQuery,
                                    false});
        ++plan.queries.back().box_count;
        plan.query_boxes.push_back(objects[i].bounds);
        plan.conditional.push_back({range, static_cast<std::uint32_t>(plan.queries.size() - 1)});
    }
    return plan;
}

struct Method {
    const char* name;
    Asked asked;
    std::size_t boxes_per_query;
};
constexpr Method kMethods[] = {{"at once", Asked::Nothing, 1},
                               {"1000 queries", Asked::Hardware, 1},
                               {"100 multiqueries", Asked::Hardware, 10},
                               {"box pass of 1000", Asked::BoxPass, 1},
                               {"box pass of 100", Asked::BoxPass, 10}};

void print_costs(gl::RenderTarget& target) {
    const gl::WallTimer timer;
    const Result<gl::MeasuredAnswerCosts> measured = gl::measure_answer_costs(target);
    if (!measured) {
        std::fprintf(stderr, "%s\n", measured.error().message.c_str());
        std::exit(1);
    }
    std::printf("# costs measured in %.2f s\nway,frame_ns,query_ns,box_ns,pixel_ns,draw_ns\n",
                1e-3 * timer.elapsed_ms());
    for (const auto& [name, c] :
         {std::pair{"hardware", measured->costs.hardware}, {"box pass", measured->costs.box_pass}})
        std::printf("%s,%.0f,%.0f,%.0f,%.3f,%.0f\n", name, c.frame_ns, c.query_ns, c.box_ns, c.pixel_ns,
                    c.draw_ns);
    std::printf("way,queries,boxes,pixels,draws,us,us_per_box\n");
    for (const gl::AskedFrame& f : measured->frames)
        std::printf("%s,%.0f,%.0f,%.0f,%.0f,%.1f,%.2f\n",
                    f.way == QueryWay::BoxPass ? "box pass" : "hardware", f.queries, f.boxes, f.pixels,
                    f.draws, 1e-3 * f.ns, 1e-3 * f.ns / f.boxes);
}

void print_scenario(gl::Executor& executor, gl::RenderTarget& target) {
    const Scene scene = wall_and_nodes();
    const gl::SceneBuffers buffers = gl::SceneBuffers::upload(scene).value();
    const View view{look_along({0, 0, 0}, {0, 0, -1}, {0, 1, 0}),
                    perspective(1.0, 16.0 / 9.0, 0.1, 1000.0, ClipDepth::NegativeOneToOne),
                    ClipDepth::NegativeOneToOne};
    std::printf("nodes,method,median_ms,submit_ms\n");
    std::vector<QueryAnswer> answers;
    for (const bool with_wall : {true, false}) {
        std::vector<FramePlan> plans;
        for (const Method& method : kMethods)
            plans.push_back(plan_of(scene, with_wall, method.asked, method.boxes_per_query));
        std::vector<std::vector<double>> times(plans.size()), submits(plans.size());
        for (int round = -1; round < kRounds; ++round)
            for (std::size_t m = 0; m < plans.size(); ++m) {
                target.begin(view.clip_depth, glm::vec3(0.5f));
                gl::finish();
                const gl::WallTimer timer;
                executor.draw(plans[m], buffers, view);
                const double submit_ms = timer.elapsed_ms();
                gl::finish();
                if (round >= 0) times[m].push_back(timer.elapsed_ms()), submits[m].push_back(submit_ms);
                answers.clear();
                executor.poll_answers(answers);
            }
        for (std::size_t m = 0; m < plans.size(); ++m) {
            std::ranges::sort(times[m]);
            std::ranges::sort(submits[m]);
            std::printf("%s,%s,%.2f,%.2f\n", with_wall ? "hidden" : "in view", kMethods[m].name,
                        times[m][kRounds / 2], submits[m][kRounds / 2]);
        }
    }
}

}  // namespace

int main() {
    const Result<gl::Context> context = gl::Context::create_headless();
    if (!context) {
        std::fprintf(stderr, "%s\n", context.error().message.c_str());
        return 1;
    }
    std::printf("# %s\n", context->device().renderer.c_str());
    gl::RenderTarget target = gl::RenderTarget::create(1280, 720).value();
    gl::Executor executor = gl::Executor::create().value();
    print_costs(target);
    print_scenario(executor, target);
    std::printf("# blocking reads: %llu\n",
                static_cast<unsigned long long>(executor.answer_counters().blocking_reads));
    return 0;
}
