// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Which threads a build, or the planning of several views, may use.
///
/// Builds (`build_octree`, `build_lod_chains`, reading a baked file) take oneTBB's threads, as many as the
/// caller's arena has. Called through `run_on` they take those that they are given and no other: the
/// calling thread alone unless said otherwise. What comes out is the same with any threads.
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

namespace rhview {

/// The default is the calling thread alone.
struct Workers {
    /// One share of a job; any thread may call it.
    using Share = void (*)(void* job, std::uint32_t index);
    /// A job system: calls `share(job, i)` once for each i below `count`, on as many threads at a time as it
    /// likes, in any order, and returns when all have returned. May call them all in turn on one thread.
    using Run = void (*)(void* user, std::uint32_t count, Share share, void* job);

    std::uint32_t thread_count = 1;  ///< that work at a time, the calling one among them; 0 counts as 1
    Run run = nullptr;               ///< null: threads beyond the first are oneTBB's own
    void* user = nullptr;            ///< of `run`
};

/// Calls `task(context)` once and returns when it has, on threads of `workers`: on any of the job system's,
/// or the calling one. Parallel loops of oneTBB inside it stay on those threads. Where `run` is given no
/// thread is started. What `task` throws is thrown here. Cost: allocates; some ten µs per thread.
void run_task_on(const Workers& workers, void (*task)(void* context), void* context);

/// Calls `share(job, i)` once for each i below `count`, on those threads, and returns when all have. They
/// throw nothing. On the calling thread alone, or by a job system, it allocates nothing.
void for_each_share(const Workers& workers, std::uint32_t count, Workers::Share share, void* job);

/// What `build()` returns, computed on `workers`: `run_on(workers, [&] { return build_octree(batches); })`.
template <class Build>
auto run_on(const Workers& workers, Build&& build) {
    struct Job {
        std::remove_reference_t<Build>& build;
        std::optional<std::invoke_result_t<Build&>> result{};
    } job{build};
    run_task_on(
        workers,
        [](void* context) {
            static_cast<Job*>(context)->result.emplace(static_cast<Job*>(context)->build());
        },
        &job);
    return std::move(*job.result);
}

}  // namespace rhview
