// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Frustum culling of the objects of `plant`, at the sizes of the source's models (P-38, P-43, Boeing 777):
// each technique alone, and the combinations that its sources recommend. Nothing is drawn. An iteration walks
// the scene's own path once; times are of culling alone.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <string>

#include "rhview/frustum/techniques.h"
#include "rhview/scenes/named_scene.h"

namespace rhview {
namespace {

constexpr int kFrames = 240;

struct Objects {
    std::vector<Aabb> boxes;
    glm::dvec3 origin{0.0};
    std::vector<View> views;
};

/// The boxes of `count` objects, in the order in which the scene's author placed them, and the walk. Pipes
/// have three sides: only their boxes matter here.
const Objects& plant(std::int64_t count) {
    static std::map<std::int64_t, Objects> plants;
    Objects& objects = plants[count];
    if (!objects.boxes.empty()) return objects;
    const SceneAndPath scene = make_named_scene("plant:sides=3,objects=" + std::to_string(count)).value();
    objects.origin = scene.scene.origin;
    for (const SceneBatch& batch : scene.scene.batches)
        for (const SceneObject& object : batch.objects.span()) objects.boxes.push_back(object.bounds);
    for (int frame = 0; frame < kFrames; ++frame)
        objects.views.push_back(
            scene.path.view_of_frame(frame, kFrames, 16.0 / 9.0, ClipDepth::ReversedZeroToOne));
    return objects;
}

const BoxHierarchy& tree_of(std::int64_t count, const HierarchyOptions& options) {
    static std::map<std::string, BoxHierarchy> trees;
    const std::string key = std::to_string(count) + ' ' + std::to_string(static_cast<int>(options.split)) +
                            ' ' + std::to_string(options.width) + ' ' +
                            std::to_string(options.max_leaf_boxes);
    BoxHierarchy& tree = trees[key];
    if (tree.nodes().empty()) tree = BoxHierarchy(plant(count).boxes, options);
    return tree;
}

/// Walks the path; `cull(view)` says how many nodes and boxes it tested, `count_shown()`, not timed, how many
/// boxes it kept.
template <class Cull, class CountShown>
void walk(benchmark::State& state, const Objects& objects, const Cull& cull, const CountShown& count_shown) {
    using Clock = std::chrono::steady_clock;
    std::vector<double> worst(kFrames,
                              1e30);  // per frame the least of the passes: noise is not the culling's
    double shown = 0.0, nodes = 0.0, boxes = 0.0;
    for (auto _ : state) {
        double sum_s = 0.0;
        for (int frame = 0; frame < kFrames; ++frame) {
            const Clock::time_point start = Clock::now();
            const HierarchyVisits visits = cull(objects.views[frame]);
            const double frame_s = std::chrono::duration<double>(Clock::now() - start).count();
            sum_s += frame_s;
            worst[frame] = std::min(worst[frame], frame_s);
            nodes += static_cast<double>(visits.nodes);
            boxes += static_cast<double>(visits.boxes);
            shown += static_cast<double>(count_shown());
        }
        state.SetIterationTime(sum_s);
    }
    const auto count = static_cast<double>(objects.boxes.size());
    const double frames = kFrames * static_cast<double>(state.iterations());
    using benchmark::Counter;
    state.counters["us/frame"] = Counter(frames * 1e-6, Counter::kIsRate | Counter::kInvert);
    state.counters["worst_us"] = 1e6 * *std::max_element(worst.begin(), worst.end());
    state.counters["ns/object"] = Counter(frames * count * 1e-9, Counter::kIsRate | Counter::kInvert);
    state.counters["frames/s"] = Counter(frames, Counter::kIsRate);
    state.counters["visible"] = shown / frames / count;
    state.counters["nodes"] = nodes / frames;
    state.counters["boxes"] = boxes / frames;
}

std::size_t sum_of(const std::vector<OrderRange>& ranges) {
    std::size_t sum = 0;
    for (const OrderRange& range : ranges) sum += range.count;
    return sum;
}

void run_techniques(benchmark::State& state, const CullingTechniques& techniques,
                    const HierarchyOptions& options) {
    const Objects& objects = plant(state.range(0));
    TechniqueCuller culler(tree_of(state.range(0), options), techniques);
    std::vector<OrderRange> visible;
    walk(
        state, objects, [&](const View& view) { return culler.cull(view, objects.origin, visible); },
        [&] { return sum_of(visible); });
}

void run_hierarchy(benchmark::State& state, const HierarchyOptions& options) {
    const Objects& objects = plant(state.range(0));
    const BoxHierarchy& tree = tree_of(state.range(0), options);
    std::vector<OrderRange> visible;
    walk(
        state, objects,
        [&](const View& view) { return tree.cull(make_frustum(view, objects.origin), visible); },
        [&] { return sum_of(visible); });
}

/// The flat batch to bits; nothing is counted from them but in a pass of its own.
void run_batch(benchmark::State& state) {
    const Objects& objects = plant(state.range(0));
    const BoxArrays arrays(objects.boxes);
    std::vector<std::uint64_t> words(visibility_words(objects.boxes.size()));
    const auto cull = [&](const View& view) {
        cull_boxes(make_frustum(view, objects.origin), arrays.spans(), words);
        return HierarchyVisits{0, objects.boxes.size()};
    };
    walk(state, objects, cull, [&] {
        int sum = 0;
        for (const std::uint64_t word : words) sum += std::popcount(word);
        return sum;
    });
}

/// What an engine would write in an afternoon: box after box, plane after plane, p-vertex, no slack.
void run_plain_loop(benchmark::State& state) {
    const Objects& objects = plant(state.range(0));
    std::vector<std::uint8_t> shown(objects.boxes.size());
    const auto cull = [&](const View& view) {
        const Frustum frustum = make_frustum(view, objects.origin);
        const glm::vec3 eye(frustum.eye);
        std::array<glm::vec4, 6> planes;
        for (std::size_t i = 0; i < 6; ++i) {
            const FrustumPlane& plane = frustum.planes[i];
            planes[i] = glm::vec4(plane.normal, plane.distance - glm::dot(plane.normal, eye));
        }
        for (std::size_t i = 0; i < objects.boxes.size(); ++i) {
            const Aabb& box = objects.boxes[i];
            bool outside = false;
            for (const glm::vec4& p : planes) {
                const float value = p.x * (p.x >= 0 ? box.max.x : box.min.x) +
                                    p.y * (p.y >= 0 ? box.max.y : box.min.y) +
                                    p.z * (p.z >= 0 ? box.max.z : box.min.z) + p.w;
                if (value < 0) {
                    outside = true;
                    break;
                }
            }
            shown[i] = !outside;
        }
        benchmark::DoNotOptimize(shown.data());
        return HierarchyVisits{0, objects.boxes.size()};
    };
    walk(state, objects, cull, [&] { return std::count(shown.begin(), shown.end(), 1); });
}

void add(benchmark::internal::Benchmark* benchmark) {
    for (const std::int64_t objects : {130'000, 280'000, 710'000}) benchmark->Arg(objects);
    benchmark->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(1);
}

void add_techniques() {
    using enum BoxTest;
    using enum Traversal;
    // The source's trees: divided at the mean, three objects to a leaf.
    const HierarchyOptions source{HierarchySplit::Mean, 2, 3};
    const std::pair<const char*, CullingTechniques> techniques[] = {
        {"flat/eight_corners", {EightCorners, Flat}},
        {"flat/radar", {Radar, Flat}},
        {"flat/p_and_n_vertex", {PAndNVertex, Flat}},
        {"flat/p_and_n_vertex+coherency", {.traversal = Flat, .plane_coherency = true}},
        {"flat/p_and_n_vertex+octant", {.traversal = Flat, .octant_test = true}},
        {"flat/vector_within", {VectorWithin, Flat}},
        {"flat/vector_across", {VectorAcross, Flat}},
        {"tree/eight_corners", {.test = EightCorners}},
        {"tree/radar", {.test = Radar}},
        {"tree/p_and_n_vertex", {}},
        {"tree/stack", {.traversal = Stack}},
        {"tree/coherency", {.plane_coherency = true}},
        {"tree/octant", {.octant_test = true}},
        {"tree/masking", {.masking = true}},
        {"tree/masking+stack", {.traversal = Stack, .masking = true}},
        {"tree/translation_coherency", {.translation_coherency = true}},
        {"tree/frustum_box", {.frustum_box_first = true}},
        {"tree/coherency+octant", {.plane_coherency = true, .octant_test = true}},
        {"tree/coherency+octant+frustum_box",
         {.plane_coherency = true, .octant_test = true, .frustum_box_first = true}},
        {"tree/masking+octant", {.octant_test = true, .masking = true}},
        {"tree/masking+coherency", {.plane_coherency = true, .masking = true}},
        {"tree/masking+coherency+octant", {.plane_coherency = true, .octant_test = true, .masking = true}},
        {"tree/vector_within+masking", {.test = VectorWithin, .masking = true}},
        {"tree/vector_across+masking", {.test = VectorAcross, .masking = true}},
        {"tree/masking+static_split", {.threads = Threads::StaticSplit, .masking = true}},
        {"tree/masking+work_stealing", {.threads = Threads::WorkStealing, .masking = true}},
    };
    for (const auto& [name, chosen] : techniques)
        add(benchmark::RegisterBenchmark(name, run_techniques, chosen, source));
}

void add_hierarchies() {
    const std::pair<const char*, HierarchySplit> splits[] = {{"mean", HierarchySplit::Mean},
                                                             {"median", HierarchySplit::Median},
                                                             {"surface_area", HierarchySplit::SurfaceArea}};
    for (const auto& [name, split] : splits)
        for (const std::uint32_t width : {2u, 4u, 8u})
            for (const std::uint32_t leaf : {3u, 16u, 32u, 64u}) {
                if (width != 2 && leaf != 32) continue;
                const std::string full = std::string("hierarchy/") + name +
                                         "/width:" + std::to_string(width) + "/leaf:" + std::to_string(leaf);
                add(benchmark::RegisterBenchmark(full.c_str(), run_hierarchy,
                                                 HierarchyOptions{split, width, leaf}));
            }
}

}  // namespace
}  // namespace rhview

int main(int argc, char** argv) {
    rhview::add(benchmark::RegisterBenchmark("flat/plain_loop", rhview::run_plain_loop));
    rhview::add(benchmark::RegisterBenchmark("flat/batch", rhview::run_batch));
    rhview::add_techniques();
    rhview::add_hierarchies();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
