// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/plan_views.h"

#include <cstdint>
#include <exception>
#include <mutex>

namespace rhview {
namespace {

struct ViewsJob {
    std::span<const ViewToPlan> views;
    std::mutex mutex{};
    std::exception_ptr thrown{};  ///< memory ran out: the first that was

    void plan(std::uint32_t i) {
        try {
            views[i].planner->plan(*views[i].input, *views[i].plan);
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!thrown) thrown = std::current_exception();
        }
    }
};

}  // namespace

void plan_views(std::span<const ViewToPlan> views, const Workers& workers) {
    ViewsJob job{views};
    for_each_share(
        workers, static_cast<std::uint32_t>(views.size()),
        [](void* context, std::uint32_t i) { static_cast<ViewsJob*>(context)->plan(i); }, &job);
    if (job.thrown) std::rethrow_exception(job.thrown);
}

}  // namespace rhview
