// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/workers.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <utility>
#include <vector>

namespace rhview {
namespace {

/// More threads than any machine has; oneTBB counts in int.
constexpr std::uint32_t kMostThreads = 4096;

/// Of oneTBB's own, no more than it has: it would print a warning.
int thread_count(const Workers& workers) {
    const int wanted = static_cast<int>(std::clamp(workers.thread_count, 1u, kMostThreads));
    return workers.run != nullptr ? wanted : std::min(wanted, tbb::info::default_concurrency());
}

/// One task on the threads of a job system. The first share to come runs it inside an arena whose places are
/// all kept for such threads, so that oneTBB sends none of its own; the others come into the arena and help
/// with the task's loops until it is done. Those that come later find nothing to do: the job system may call
/// the shares in turn.
class SharedTask {
  public:
    SharedTask(int threads, void (*task)(void*), void* context)
        : arena_(threads, static_cast<unsigned>(threads)), task_(task), context_(context) {}

    static void take_share(void* job, std::uint32_t) { static_cast<SharedTask*>(job)->take_share(); }

    void rethrow() const {
        if (thrown_) std::rethrow_exception(thrown_);
    }

  private:
    void take_share() {
        if (begin()) return run();
        tbb::task_group waiting;
        if (wait_in(waiting)) arena_.execute([&] { waiting.wait(); });
    }

    bool begin() {
        const std::lock_guard lock(mutex_);
        return !std::exchange(begun_, true);
    }

    void run() {
        try {
            arena_.execute([&] { task_(context_); });
        } catch (...) {
            thrown_ = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        done_ = true;
        gates_.clear();
    }

    bool wait_in(tbb::task_group& group) {
        const std::lock_guard lock(mutex_);
        if (!done_) gates_.push_back(group.defer([] {}));
        return !done_;
    }

    tbb::task_arena arena_;
    void (*task_)(void*);
    void* context_;
    std::mutex mutex_;
    bool begun_ = false, done_ = false;
    std::vector<tbb::task_handle> gates_;  ///< by helper: a task that never runs, whose end it awaits
    std::exception_ptr thrown_;
};

}  // namespace

void run_task_on(const Workers& workers, void (*task)(void* context), void* context) {
    const int threads = thread_count(workers);
    if (workers.run == nullptr || threads == 1) {
        tbb::task_arena arena(threads);
        return arena.execute([&] { task(context); });
    }
    SharedTask shared(threads, task, context);
    workers.run(workers.user, static_cast<std::uint32_t>(threads), SharedTask::take_share, &shared);
    shared.rethrow();
}

void for_each_share(const Workers& workers, std::uint32_t count, Workers::Share share, void* job) {
    const int threads = thread_count(workers);
    if (threads == 1 || count <= 1) {
        for (std::uint32_t i = 0; i < count; ++i) share(job, i);
    } else if (workers.run != nullptr) {
        workers.run(workers.user, count, share, job);
    } else {
        tbb::task_arena arena(threads);
        arena.execute([&] {
            tbb::parallel_for(
                std::uint32_t{0}, count, [&](std::uint32_t i) { share(job, i); }, tbb::simple_partitioner());
        });
    }
}

}  // namespace rhview
