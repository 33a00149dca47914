// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// rhview_object_regions PROFILE: from how many objects on regions pay. Half of the objects stand before a
// wall, half behind it; a device that knows the truth answers before the next frame. The same frames are
// planned one by one (a flat batch of boxes, a question for each) and by region (a refitted hierarchy), and
// what each takes is added up by the model. CSV to standard output; all but the times repeats exactly.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "rhview/pipeline/rhview_planner.h"
#include "rhview/timing_model/profile.h"

namespace rhview {
namespace {

constexpr int kFrames = 240, kWarmUp = 60;
constexpr double kWall = 40.0;

double uniform(std::mt19937& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
}

struct World {
    World(std::uint32_t objects, std::uint32_t indices_each)
        : indices(objects, indices_each), groups(objects, 0) {
        std::mt19937 random(objects);
        for (std::uint32_t i = 0; i < objects; ++i) {
            const double x = i % 2 == 0 ? uniform(random, 12, kWall - 2) : uniform(random, kWall + 2, 150);
            centres.emplace_back(x, uniform(random, -0.2, 0.2) * x, uniform(random, -0.3, 0.3) * x);
        }
        boxes.resize(objects);
        move(0);
    }

    void move(int frame) {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const double step = (static_cast<int>(i) + frame) % 120 < 60 ? 0.01 : -0.01;
            centres[i].z += step;
            boxes[i] = {glm::vec3(centres[i] - 0.5), glm::vec3(centres[i] + 0.5)};
        }
    }

    std::vector<glm::dvec3> centres;
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> indices, groups;
};

struct Cost {
    double plan_us = 0.0;  ///< median
    double queries = 0.0, query_us = 0.0;
    double drawn_us = 0.0;  ///< indices drawn, and what submitting them and the rest takes

    [[nodiscard]] double total_us() const { return plan_us + query_us + drawn_us; }
};

FrameInput look_at(const World& world) {
    FrameInput input;
    input.culling_view = {look_along({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                          perspective(1.0, 16.0 / 9.0, 0.1, 500.0, ClipDepth::ReversedZeroToOne),
                          ClipDepth::ReversedZeroToOne};
    input.object_boxes = world.boxes;
    input.object_groups = world.groups;
    return input;
}

/// One draw at once for all that share its mesh, one for each query that something hangs on.
double drawn_ns(const FramePlan& plan, const World& world, const DrawCosts& costs, double shown_index_ns) {
    double ns = plan.objects.empty() ? 0.0 : costs.draw_ns;
    for (const ObjectId object : plan.objects) ns += shown_index_ns * world.indices[index_of(object)];
    std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
    for (const ConditionalObject& object : plan.conditional_objects) {
        if (object.query != last) ns += costs.draw_ns;
        last = object.query;
        const bool shown = world.centres[index_of(object.object)].x < kWall;
        if (shown) ns += shown_index_ns * world.indices[index_of(object.object)];
    }
    return ns;
}

Cost measure(World world, const DrawCosts& costs, OcclusionOptions occlusion, bool by_region) {
    occlusion.object_indices = world.indices;
    occlusion.fewest_for_regions = by_region ? 0 : std::numeric_limits<std::size_t>::max();
    const RhOctree octree = build_octree({}, {}).value();
    RhviewPlanner planner(octree, costs, occlusion);
    FramePlan plan;
    std::vector<QueryAnswer> answers;
    std::vector<double> times;
    Cost cost;
    for (int frame = 0; frame < kFrames; ++frame) {
        world.move(frame);
        const FrameInput input = look_at(world);
        const auto start = std::chrono::steady_clock::now();
        planner.absorb(answers);
        planner.plan(input, plan);
        const double us =
            std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
        answers.clear();
        for (const PlannedQuery& query : plan.queries) {
            const auto boxes = std::span(plan.query_boxes).subspan(query.first_box, query.box_count);
            answers.push_back(
                {query.ticket, std::ranges::any_of(boxes, [](const Aabb& b) { return b.min.x < kWall; }), 0});
        }
        if (frame < kWarmUp) continue;
        const double share = 1.0 / (kFrames - kWarmUp);
        times.push_back(us);
        cost.queries += share * static_cast<double>(plan.queries.size());
        cost.query_us += share * 1e-3 * (plan.occlusion ? plan.occlusion->query_ns : 0.0);
        cost.drawn_us += share * 1e-3 * drawn_ns(plan, world, costs, occlusion.shown_index_ns);
    }
    std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
    cost.plan_us = times[times.size() / 2];
    return cost;
}

int run(const char* file) {
    const Result<TimingProfile> profile = load_profile(file);
    if (!profile || !profile->answer_costs) {
        std::fprintf(stderr, "%s\n",
                     profile ? "the profile has no answer costs" : profile.error().message.c_str());
        return 2;
    }
    const DrawCosts costs{profile->c1_ns, profile->c3_ns + profile->sub_draw_ns.value_or(0.0), 0.0};
    OcclusionOptions occlusion;
    occlusion.costs = *profile->answer_costs;
    occlusion.shown_index_ns = profile->c1_ns + profile->primitive_ns.value_or(0.0) / 3.0;
    std::puts("indices_each,objects,way,plan_us,queries,query_us,drawn_us,total_us");
    for (const std::uint32_t indices : {90u, 600u, 3'000u, 30'000u})
        for (const std::uint32_t objects : {4u, 8u, 16u, 32u, 64u, 128u, 192u, 256u, 384u, 512u, 1024u})
            for (const bool by_region : {false, true}) {
                const Cost cost = measure(World(objects, indices), costs, occlusion, by_region);
                std::printf("%u,%u,%s,%.1f,%.1f,%.1f,%.1f,%.1f\n", indices, objects,
                            by_region ? "region" : "single", cost.plan_us, cost.queries, cost.query_us,
                            cost.drawn_us, cost.total_us());
            }
    return 0;
}

}  // namespace
}  // namespace rhview

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: rhview_object_regions PROFILE\n", stderr);
        return 2;
    }
    return rhview::run(argv[1]);
}
