// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Flat batches of boxes: the library's loops per instruction set against plain ones, and against reading the
// same arrays. The boxes are spread around the eye; a fifth of them is visible.

#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <cmath>
#include <cstring>
#include <random>

#include "rhview/frustum/box_batch.h"

namespace rhview {
namespace {

constexpr std::size_t kInCache = 8192, kInMemory = 4'000'000;

View view_along(double x, double z) {
    View view;
    view.clip_depth = ClipDepth::ReversedZeroToOne;
    view.camera_from_world = look_along({0, 2, 0}, {x, -0.1, z}, {0, 1, 0});
    view.clip_from_camera = perspective(1.05, 16.0 / 9.0, 0.1, 800.0, view.clip_depth);
    return view;
}

/// A camera that turns: the view of a pass is not that of the one before, so no loop can learn its branches
/// by heart.
class TurningView {
  public:
    TurningView() {
        for (int i = 0; i < kViews; ++i)
            frusta_.push_back(make_frustum(view_along(std::cos(0.1 * i), std::sin(0.1 * i))));
    }
    const Frustum& next() { return frusta_[at_++ % kViews]; }

  private:
    static constexpr int kViews = 63;
    std::vector<Frustum> frusta_;
    std::size_t at_ = 0;
};

std::vector<Aabb> make_boxes(std::size_t count) {
    std::mt19937 engine(1);
    const auto uniform = [&](double reach) {
        return static_cast<float>(reach * (static_cast<double>(engine()) / 2147483648.0 - 1.0));
    };
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 centre(uniform(400), uniform(60), uniform(400));
        const glm::vec3 half(1.0f + uniform(0.9), 1.0f + uniform(0.9), 1.0f + uniform(0.9));
        boxes.push_back({centre - half, centre + half});
    }
    return boxes;
}

struct Boxes {
    explicit Boxes(std::size_t count) : aabbs(make_boxes(count)), arrays(aabbs) {
        for (int i = 0; i < 6; ++i) centre_extent[i].resize(count);
        for (std::size_t i = 0; i < count; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                centre_extent[axis][i] = aabbs[i].centre()[axis];
                centre_extent[axis + 3][i] = 0.5f * aabbs[i].extent()[axis];
            }
    }
    std::vector<Aabb> aabbs;
    BoxArrays arrays;
    std::vector<float> centre_extent[6];
};

const Boxes& boxes_of(benchmark::State& state) {
    static const Boxes in_cache(kInCache), million(1'000'000), in_memory(kInMemory);
    const auto count = static_cast<std::size_t>(state.range(0));
    return count == kInCache ? in_cache : count == kInMemory ? in_memory : million;
}

void count_boxes(benchmark::State& state, double views = 1.0) {
    const double boxes =
        static_cast<double>(state.range(0)) * views * static_cast<double>(state.iterations());
    state.counters["ns/box"] =
        benchmark::Counter(boxes * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// What an engine would write: planes in `float`, world space, no slack.
struct PlainPlane {
    float x, y, z, distance;
};
std::array<PlainPlane, 6> plain_planes(const Frustum& frustum) {
    std::array<PlainPlane, 6> planes;
    for (std::size_t i = 0; i < 6; ++i) {
        const FrustumPlane& plane = frustum.planes[i];
        planes[i] = {plane.normal.x, plane.normal.y, plane.normal.z,
                     plane.distance - glm::dot(plane.normal, glm::vec3(frustum.eye))};
    }
    return planes;
}

/// p-vertex, planes one after another until one rejects the box.
void scalar_loop(benchmark::State& state) {
    const Boxes& boxes = boxes_of(state);
    TurningView view;
    std::vector<std::uint8_t> visible(boxes.aabbs.size());
    for (auto _ : state) {
        const std::array<PlainPlane, 6> planes = plain_planes(view.next());
        for (std::size_t i = 0; i < boxes.aabbs.size(); ++i) {
            const Aabb& box = boxes.aabbs[i];
            bool outside = false;
            for (const PlainPlane& p : planes) {
                const float value = p.x * (p.x >= 0 ? box.max.x : box.min.x) +
                                    p.y * (p.y >= 0 ? box.max.y : box.min.y) +
                                    p.z * (p.z >= 0 ? box.max.z : box.min.z) + p.distance;
                if (value < 0) {
                    outside = true;
                    break;
                }
            }
            visible[i] = !outside;
        }
        benchmark::DoNotOptimize(visible.data());
        benchmark::ClobberMemory();
    }
    count_boxes(state);
}
BENCHMARK(scalar_loop)->Arg(kInCache)->Arg(1'000'000)->Arg(kInMemory);

/// The same with centre and half size in six arrays and no way out of the loop: compilers vectorise this.
inline __attribute__((always_inline)) void straight_loop(
    const float* __restrict cx, const float* __restrict cy, const float* __restrict cz,
    const float* __restrict ex, const float* __restrict ey, const float* __restrict ez,
    const std::array<PlainPlane, 6>& planes, std::size_t count, std::uint8_t* __restrict visible) {
    const std::array<PlainPlane, 6> p = planes;
    for (std::size_t i = 0; i < count; ++i) {
        bool inside = true;
        for (std::size_t k = 0; k < 6; ++k) {
            const float value = p[k].x * cx[i] + p[k].y * cy[i] + p[k].z * cz[i] + p[k].distance +
                                std::abs(p[k].x) * ex[i] + std::abs(p[k].y) * ey[i] +
                                std::abs(p[k].z) * ez[i];
            inside &= value >= 0;
        }
        visible[i] = inside;
    }
}

#define RHVIEW_STRAIGHT_LOOP(name, attributes)                                                              \
    attributes void name(const std::vector<float>* b, const std::array<PlainPlane, 6>& planes,              \
                         std::uint8_t* visible) {                                                           \
        straight_loop(b[0].data(), b[1].data(), b[2].data(), b[3].data(), b[4].data(), b[5].data(), planes, \
                      b[0].size(), visible);                                                                \
    }
RHVIEW_STRAIGHT_LOOP(straight_loop_baseline, )
#ifdef __x86_64__
RHVIEW_STRAIGHT_LOOP(straight_loop_sse4, __attribute__((target("sse4.2"))))
RHVIEW_STRAIGHT_LOOP(straight_loop_avx2, __attribute__((target("avx2,fma"))))
RHVIEW_STRAIGHT_LOOP(
    straight_loop_avx512,
    __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,fma,prefer-vector-width=512"))))
#endif

using StraightLoop = void (*)(const std::vector<float>*, const std::array<PlainPlane, 6>&, std::uint8_t*);
template <StraightLoop loop>
void compiler_vectorised(benchmark::State& state) {
    const Boxes& boxes = boxes_of(state);
    TurningView view;
    std::vector<std::uint8_t> visible(boxes.aabbs.size());
    for (auto _ : state) {
        loop(boxes.centre_extent, plain_planes(view.next()), visible.data());
        benchmark::DoNotOptimize(visible.data());
        benchmark::ClobberMemory();
    }
    count_boxes(state);
}
#define RHVIEW_COMPILER_VECTORISED(loop) \
    BENCHMARK_TEMPLATE(compiler_vectorised, loop)->Arg(kInCache)->Arg(1'000'000)->Arg(kInMemory)
RHVIEW_COMPILER_VECTORISED(straight_loop_baseline);
#ifdef __x86_64__
RHVIEW_COMPILER_VECTORISED(straight_loop_sse4);
RHVIEW_COMPILER_VECTORISED(straight_loop_avx2);
RHVIEW_COMPILER_VECTORISED(straight_loop_avx512);
#endif

/// Nothing but reading the six arrays, front to back, all at once.
#ifdef __x86_64__
__attribute__((target("avx512f,prefer-vector-width=512")))
#endif
std::uint32_t
read_arrays(const std::uint32_t* a, const std::uint32_t* b, const std::uint32_t* c, const std::uint32_t* d,
            const std::uint32_t* e, const std::uint32_t* f, std::size_t count) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += (a[i] + b[i]) + (c[i] + d[i]) + (e[i] + f[i]);
    return sum;
}

void plain_read(benchmark::State& state) {
    const Boxes& boxes = boxes_of(state);
    std::vector<std::uint32_t> copies[6];
    const BoxSpans spans = boxes.arrays.spans();
    const float* arrays[6] = {spans.min_x, spans.min_y, spans.min_z, spans.max_x, spans.max_y, spans.max_z};
    for (int i = 0; i < 6; ++i) {
        copies[i].resize(spans.count);
        std::memcpy(copies[i].data(), arrays[i], spans.count * sizeof(float));
    }
    for (auto _ : state)
        benchmark::DoNotOptimize(read_arrays(copies[0].data(), copies[1].data(), copies[2].data(),
                                             copies[3].data(), copies[4].data(), copies[5].data(),
                                             spans.count));
    count_boxes(state);
    state.SetBytesProcessed(static_cast<std::int64_t>(spans.count) * 24 *
                            static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(plain_read)->Arg(kInCache)->Arg(1'000'000)->Arg(kInMemory);

/// Takes an instruction set if the machine has it; 0: the best.
bool choose(benchmark::State& state, std::int64_t set) {
    hwy::SetSupportedTargetsForTest(0);
    if (set != 0 && (hwy::SupportedTargets() & set) == 0) {
        state.SkipWithError("this machine does not have it");
        return false;
    }
    hwy::SetSupportedTargetsForTest(set);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return true;
}

void batch(benchmark::State& state, std::int64_t set) {
    if (!choose(state, set)) return;
    const Boxes& boxes = boxes_of(state);
    TurningView view;
    std::vector<std::uint64_t> visible(visibility_words(boxes.aabbs.size()));
    for (auto _ : state) {
        cull_boxes(view.next(), boxes.arrays.spans(), visible);
        benchmark::DoNotOptimize(visible.data());
        benchmark::ClobberMemory();
    }
    count_boxes(state);
    choose(state, 0);
}
#ifdef __x86_64__
BENCHMARK_CAPTURE(batch, avx512, HWY_AVX3)->Arg(kInCache)->Arg(1'000'000)->Arg(kInMemory);
BENCHMARK_CAPTURE(batch, avx2, HWY_AVX2)->Arg(kInCache)->Arg(1'000'000)->Arg(kInMemory);
BENCHMARK_CAPTURE(batch, sse4, HWY_SSE4)->Arg(kInCache)->Arg(1'000'000)->Arg(kInMemory);
#else
BENCHMARK_CAPTURE(batch, best, 0)->Arg(kInCache)->Arg(1'000'000)->Arg(kInMemory);
#endif

void batch_one_after_another(benchmark::State& state) {
    const Boxes& boxes = boxes_of(state);
    TurningView view;
    std::vector<std::uint64_t> visible(visibility_words(boxes.aabbs.size()));
    for (auto _ : state) {
        cull_boxes(view.next(), boxes.aabbs, visible);
        benchmark::DoNotOptimize(visible.data());
        benchmark::ClobberMemory();
    }
    count_boxes(state);
}
BENCHMARK(batch_one_after_another)->Arg(kInCache)->Arg(1'000'000)->Arg(kInMemory);

/// The exact scalar loop with the library's slack.
void batch_scalar(benchmark::State& state) {
    const Boxes& boxes = boxes_of(state);
    TurningView view;
    std::vector<std::uint64_t> visible(visibility_words(boxes.aabbs.size()));
    for (auto _ : state) {
        cull_boxes_scalar(view.next(), boxes.arrays.spans(), visible);
        benchmark::DoNotOptimize(visible.data());
        benchmark::ClobberMemory();
    }
    count_boxes(state);
}
BENCHMARK(batch_scalar)->Arg(kInCache)->Arg(1'000'000)->Arg(kInMemory);

/// Four cascades or cube faces at once; ns per box and view.
void batch_of_four_views(benchmark::State& state) {
    const Boxes& boxes = boxes_of(state);
    const std::array<Frustum, 4> views{make_frustum(view_along(1, 0)), make_frustum(view_along(-1, 0)),
                                       make_frustum(view_along(0.1, 1)), make_frustum(view_along(0.1, -1))};
    std::vector<std::uint64_t> visible(views.size() * visibility_words(boxes.aabbs.size()));
    for (auto _ : state) {
        cull_boxes(views, boxes.arrays.spans(), visible);
        benchmark::DoNotOptimize(visible.data());
        benchmark::ClobberMemory();
    }
    count_boxes(state, 4.0);
}
BENCHMARK(batch_of_four_views)->Arg(kInCache)->Arg(1'000'000)->Arg(kInMemory);

}  // namespace
}  // namespace rhview

BENCHMARK_MAIN();
