// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The handles of the C interface.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "rhview/pipeline/moving_objects.h"
#include "rhview/pipeline/object_levels.h"
#include "rhview/pipeline/plan_views.h"
#include "rhview/pipeline/rhview_planner.h"
#include "rhview/pipeline/visibility_report.h"
#include "rhview/rhview.h"

namespace rhview::capi {

class View;

/// What a scene's handle and its views share.
struct Scene {
    glm::dvec3 origin{0.0};
    std::vector<rhview_batch> batches;  ///< until the build
    bool is_built = false;
    RhOctree octree;

    MovingObjects objects;
    std::vector<std::uint32_t> object_indices;            ///< by object: at full detail
    std::vector<bool> has_object;                         ///< by object
    std::shared_ptr<const std::vector<LodChain>> chains;  ///< null: none
    std::vector<LevelledObject> levelled;                 ///< by object
    std::uint32_t object_count = 0;
    std::vector<std::uint32_t> due;  ///< as C sees it
    double time_s = 0.0;

    std::vector<View*> views;
    std::vector<const FramePlan*> plans;  ///< scratch: those of a frame

    [[nodiscard]] std::uint32_t max_objects() const {
        return static_cast<std::uint32_t>(object_indices.size());
    }
};

}  // namespace rhview::capi

struct rhview_scene {
    std::shared_ptr<rhview::capi::Scene> state = std::make_shared<rhview::capi::Scene>();
};
