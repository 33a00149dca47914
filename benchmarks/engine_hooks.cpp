// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// rhview_engine_hooks: what an engine's own threads and memory cost, through the C API. A town of houses is
// built, and four views of it are planned, on the calling thread, on oneTBB's threads and on a job system;
// with malloc and with an allocator that counts. Kinds take turns; medians. CSV to standard output, nothing
// drawn.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <mutex>
#include <thread>
#include <vector>

#include "rhview/rhview.h"
#include "rhview/scenes/named_scene.h"

namespace rhview {
namespace {

constexpr int kRepeats = 7, kFrames = 400;
constexpr std::uint32_t kThreads = 2, kViews = 4;

template <class Struct>
Struct sized() {
    Struct made{};
    made.size = sizeof(Struct);
    return made;
}

void must(rhview_status status) {
    if (status == RHVIEW_OK) return;
    std::fprintf(stderr, "rhview_engine_hooks: %s\n", rhview_last_error());
    std::exit(1);
}

/// A job system as engines have it: threads that wait for shares, and a caller who works along.
class Pool {
  public:
    explicit Pool(std::uint32_t threads) {
        for (std::uint32_t i = 1; i < threads; ++i) threads_.emplace_back([this] { serve(); });
    }
    ~Pool() {
        {
            const std::lock_guard lock(mutex_);
            ends_ = true;
        }
        wake_.notify_all();
        for (std::thread& thread : threads_) thread.join();
    }

    static void run(void* user, std::uint32_t count, void (*share)(void*, std::uint32_t), void* job) {
        static_cast<Pool*>(user)->run_all({count, share, job});
    }

  private:
    struct Job {
        std::uint32_t count = 0;
        void (*share)(void*, std::uint32_t) = nullptr;
        void* job = nullptr;
        std::uint32_t next = 0, running = 0;
    };

    void run_all(Job job) {
        std::unique_lock lock(mutex_);
        job_ = &job;
        wake_.notify_all();
        work(lock, job);
        done_.wait(lock, [&] { return job.running == 0; });
        job_ = nullptr;
    }

    void serve() {
        std::unique_lock lock(mutex_);
        for (;;) {
            wake_.wait(lock, [this] { return ends_ || (job_ != nullptr && job_->next < job_->count); });
            if (ends_) return;
            work(lock, *job_);
            done_.notify_all();
        }
    }

    static void work(std::unique_lock<std::mutex>& lock, Job& job) {
        while (job.next < job.count) {
            const std::uint32_t index = job.next++;
            ++job.running;
            lock.unlock();
            job.share(job.job, index);
            lock.lock();
            --job.running;
        }
    }

    std::mutex mutex_;
    std::condition_variable wake_, done_;
    std::vector<std::thread> threads_;
    Job* job_ = nullptr;
    bool ends_ = false;
};

/// Counts what is taken, and hands out malloc's.
struct CountingMemory {
    std::atomic<std::uint64_t> calls{0};

    static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
        static_cast<CountingMemory*>(user)->calls.fetch_add(1, std::memory_order_relaxed);
        const std::size_t whole = (bytes + alignment - 1) / alignment * alignment;
        return alignment <= alignof(std::max_align_t) ? std::malloc(bytes)
                                                      : std::aligned_alloc(alignment, whole);
    }
    static void release(void*, void* memory) { std::free(memory); }
};

double ms_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

rhview_camera camera_of(const View& view) {
    auto camera = sized<rhview_camera>();
    std::copy_n(&view.camera_from_world[0][0], 16, camera.camera_from_world);
    std::copy_n(&view.clip_from_camera[0][0], 16, camera.clip_from_camera);
    camera.clip_depth = RHVIEW_DEPTH_NEGATIVE_ONE_TO_ONE;
    camera.viewport_width = 1280;
    camera.viewport_height = 720;
    return camera;
}

struct Kind {
    const char* threads;
    const char* memory;
    rhview_workers workers;
    bool counts_memory;
};

struct Figures {
    std::vector<double> build_ms, plan_us;
    std::uint64_t build_allocations = 0, frame_allocations = 0;
};

/// Owns what the C API hands out.
struct Town {
    rhview_scene* scene = nullptr;
    rhview_view* views[kViews] = {};

    Town() = default;
    Town(const Town&) = delete;
    Town& operator=(const Town&) = delete;
    ~Town() {
        for (rhview_view* view : views) rhview_view_destroy(view);
        rhview_scene_destroy(scene);
    }

    void add(const std::vector<TriangleBatch>& batches, const glm::dvec3& origin) {
        auto options = sized<rhview_scene_options>();
        std::copy_n(&origin.x, 3, options.origin);
        must(rhview_scene_create(&options, &scene));
        for (const TriangleBatch& triangles : batches) {
            auto batch = sized<rhview_batch>();
            batch.positions = &triangles.positions.data()->x;
            batch.vertex_count = triangles.positions.size();
            batch.indices = triangles.indices.data();
            batch.index_count = triangles.indices.size();
            batch.is_two_sided = triangles.two_sided ? 1u : 0u;
            must(rhview_scene_add_batch(scene, &batch, nullptr));
        }
    }

    void build(const rhview_workers& workers) {
        auto options = sized<rhview_build_options>();
        options.workers = &workers;
        must(rhview_scene_build(scene, &options));
        for (rhview_view*& view : views) must(rhview_view_create(scene, nullptr, &view));
    }
};

/// All views plan a frame; each is at another quarter of the way.
void plan_frame(const Town& town, const CameraPath& path, const rhview_workers& workers, int frame) {
    for (std::uint32_t i = 0; i < kViews; ++i) {
        const int at = (frame + static_cast<int>(i) * kFrames / static_cast<int>(kViews)) % kFrames;
        const rhview_camera camera =
            camera_of(path.view_of_frame(at, kFrames, 1280.0 / 720.0, ClipDepth::NegativeOneToOne));
        must(rhview_view_set_camera(town.views[i], &camera));
    }
    must(rhview_plan_views(town.views, kViews, &workers));
}

void run_once(const Kind& kind, const SceneAndPath& world, const std::vector<TriangleBatch>& batches,
              Figures& figures) {
    CountingMemory memory;
    auto allocator = sized<rhview_allocator>();
    allocator.user = &memory;
    allocator.allocate = CountingMemory::allocate;
    allocator.release = CountingMemory::release;
    must(rhview_set_allocator(kind.counts_memory ? &allocator : nullptr));
    {
        Town town;
        town.add(batches, world.scene.origin);
        const std::uint64_t before = memory.calls;
        auto begin = std::chrono::steady_clock::now();
        town.build(kind.workers);
        figures.build_ms.push_back(ms_since(begin));
        figures.build_allocations = memory.calls - before;
        for (int i = 0; i < kFrames; ++i) plan_frame(town, world.path, kind.workers, i);  // grows what grows
        const std::uint64_t warm = memory.calls;
        begin = std::chrono::steady_clock::now();
        for (int i = 0; i < kFrames; ++i) plan_frame(town, world.path, kind.workers, i);
        figures.plan_us.push_back(1000.0 * ms_since(begin) / kFrames);
        figures.frame_allocations = memory.calls - warm;
    }
    must(rhview_set_allocator(nullptr));
}

rhview_workers workers_of(std::uint32_t threads, Pool* pool) {
    auto workers = sized<rhview_workers>();
    workers.thread_count = threads;
    if (pool != nullptr) {
        workers.run = Pool::run;
        workers.user = pool;
    }
    return workers;
}

void print(const Kind& kind, const Figures& figures, const Figures& first) {
    std::printf("%s,%s,%.1f,%.3f,%.1f,%.3f,", kind.threads, kind.memory, median(figures.build_ms),
                median(figures.build_ms) / median(first.build_ms), median(figures.plan_us),
                median(figures.plan_us) / median(first.plan_us));
    if (kind.counts_memory) {
        std::printf("%llu,%llu\n", static_cast<unsigned long long>(figures.build_allocations),
                    static_cast<unsigned long long>(figures.frame_allocations));
    } else {
        std::printf(",\n");
    }
}

int run() {
    const Result<SceneAndPath> world = make_named_scene("town");
    if (!world) {
        std::fprintf(stderr, "rhview_engine_hooks: %s\n", world.error().message.c_str());
        return 1;
    }
    const std::vector<TriangleBatch> batches = world->scene.triangle_batches();
    Pool pool(kThreads);
    const Kind kinds[] = {
        {"calling thread", "malloc", workers_of(1, nullptr), false},
        {"calling thread", "engine's", workers_of(1, nullptr), true},
        {"oneTBB: 2", "malloc", workers_of(kThreads, nullptr), false},
        {"oneTBB: 2", "engine's", workers_of(kThreads, nullptr), true},
        {"job system: 2", "malloc", workers_of(kThreads, &pool), false},
        {"job system: 2", "engine's", workers_of(kThreads, &pool), true},
    };
    Figures figures[std::size(kinds)];
    for (int repeat = 0; repeat < kRepeats; ++repeat)
        for (std::size_t i = 0; i < std::size(kinds); ++i) run_once(kinds[i], *world, batches, figures[i]);
    std::printf(
        "threads,memory,build_ms,build_ratio,plan_4_views_us,plan_ratio,build_allocations,warm_frame_"
        "allocations\n");
    for (std::size_t i = 0; i < std::size(kinds); ++i) print(kinds[i], figures[i], figures[0]);
    return 0;
}

}  // namespace
}  // namespace rhview

int main() {
    return rhview::run();
}
