// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/plan_views.h"

#include <cstdint>

namespace rhview {

void plan_views(std::span<const ViewToPlan> views, const Workers& workers) {
    const auto plan_one = [](void* job, std::uint32_t i) {
        const ViewToPlan& view = (*static_cast<std::span<const ViewToPlan>*>(job))[i];
        view.planner->plan(*view.input, *view.plan);
    };
    for_each_share(workers, static_cast<std::uint32_t>(views.size()), plan_one, &views);
}

}  // namespace rhview
