// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace rhview {

/// An engine's job system, as `Workers::run` sees it: a thread for each share, or all on one thread, the last
/// share first. Notes the threads that it gave.
struct JobSystem {
    bool in_turn = false;
    std::uint32_t calls = 0;
    std::set<std::thread::id> given{};

    static void run(void* user, std::uint32_t count, void (*share)(void*, std::uint32_t), void* job) {
        auto& system = *static_cast<JobSystem*>(user);
        ++system.calls;
        if (system.in_turn) return run_in_turn(system, count, share, job);
        std::mutex mutex;
        std::vector<std::thread> threads;
        for (std::uint32_t i = 0; i < count; ++i)
            threads.emplace_back([&, i] {
                {
                    const std::lock_guard lock(mutex);
                    system.given.insert(std::this_thread::get_id());
                }
                share(job, i);
            });
        for (std::thread& thread : threads) thread.join();
    }

  private:
    static void run_in_turn(JobSystem& system, std::uint32_t count, void (*share)(void*, std::uint32_t),
                            void* job) {
        system.given.insert(std::this_thread::get_id());
        for (std::uint32_t i = count; i > 0; --i) share(job, i - 1);
    }
};

}  // namespace rhview
