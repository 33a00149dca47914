// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/frame_planner.h"

namespace rhview {

void append_visible_objects(const Frustum& frustum, std::span<const Aabb> boxes,
                            std::vector<ObjectId>& objects) {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        PlaneMask mask = frustum.mask;
        if (classify(frustum, boxes[i], mask) != Containment::Outside) objects.push_back(ObjectId{i});
    }
}

}  // namespace rhview
