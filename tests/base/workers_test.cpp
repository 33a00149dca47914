// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/workers.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "job_system.h"

namespace rhview {
namespace {

using namespace std::chrono_literals;

/// A parallel loop, as builds have them: which threads took part.
std::set<std::thread::id> threads_of_a_loop() {
    std::mutex mutex;
    std::set<std::thread::id> threads;
    tbb::parallel_for(0, 64, [&](int) {
        std::this_thread::sleep_for(1ms);
        const std::lock_guard lock(mutex);
        threads.insert(std::this_thread::get_id());
    });
    return threads;
}

bool holds(const std::set<std::thread::id>& all, const std::set<std::thread::id>& some) {
    return std::ranges::includes(all, some);
}

TEST(Workers, a_build_is_the_calling_threads_alone_by_default) {
    EXPECT_EQ(run_on({}, threads_of_a_loop), std::set{std::this_thread::get_id()});
    EXPECT_EQ(run_on({.thread_count = 0}, threads_of_a_loop), std::set{std::this_thread::get_id()});
}

TEST(Workers, loops_of_a_build_stay_on_the_threads_of_the_job_system_and_use_several) {
    JobSystem jobs;
    const auto threads = run_on({.thread_count = 4, .run = JobSystem::run, .user = &jobs}, threads_of_a_loop);
    EXPECT_EQ(jobs.calls, 1u);
    EXPECT_EQ(jobs.given.size(), 4u);
    EXPECT_TRUE(holds(jobs.given, threads));
    EXPECT_GE(threads.size(), 2u);
    EXPECT_FALSE(threads.contains(std::this_thread::get_id()));
}

TEST(Workers, a_job_system_may_call_the_shares_in_turn) {
    JobSystem jobs{.in_turn = true};
    EXPECT_EQ(run_on({.thread_count = 4, .run = JobSystem::run, .user = &jobs}, threads_of_a_loop),
              std::set{std::this_thread::get_id()});
    EXPECT_EQ(jobs.calls, 1u);
}

TEST(Workers, helpers_go_home_though_the_build_has_no_loop) {
    JobSystem jobs;
    int calls = 0;
    for (int i = 0; i < 50; ++i)
        EXPECT_EQ(run_on({.thread_count = 3, .run = JobSystem::run, .user = &jobs}, [&] { return ++calls; }),
                  i + 1);
}

TEST(Workers, what_a_build_throws_arrives_where_it_was_called) {
    JobSystem jobs;
    for (const Workers& workers : {Workers{}, Workers{.thread_count = 2},
                                   Workers{.thread_count = 3, .run = JobSystem::run, .user = &jobs}})
        EXPECT_THROW(run_on(workers, []() -> int { throw std::runtime_error("no memory"); }),
                     std::runtime_error);
}

TEST(Workers, each_share_is_called_once_on_any_threads) {
    JobSystem jobs, in_turn{.in_turn = true};
    for (const Workers& workers : {Workers{}, Workers{.thread_count = 2},
                                   Workers{.thread_count = 2, .run = JobSystem::run, .user = &jobs},
                                   Workers{.thread_count = 2, .run = JobSystem::run, .user = &in_turn}}) {
        std::vector<std::atomic<int>> calls(9);
        for_each_share(
            workers, 9,
            [](void* job, std::uint32_t i) { ++(*static_cast<std::vector<std::atomic<int>>*>(job))[i]; },
            &calls);
        for (const std::atomic<int>& count : calls) EXPECT_EQ(count, 1);
    }
}

}  // namespace
}  // namespace rhview
