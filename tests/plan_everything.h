// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdlib>
#include <glm/geometric.hpp>
#include <vector>

#include "rhview/rhoctree/draw_list.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// Views of a box from outside, from its middle, and of all of it at once.
inline std::vector<View> views_of(const Aabb& bounds) {
    const glm::dvec3 centre(bounds.centre());
    const double size = glm::length(glm::dvec3(bounds.extent())) + 1e-3;
    std::vector<View> views;
    const auto add = [&](const glm::dvec3& eye, const glm::dvec3& forward, double fov_y) {
        View view;
        view.camera_from_world = look_along(eye, forward, {0.0, 1.0, 0.0});
        view.clip_from_camera = perspective(fov_y, 1.5, 1e-3 * size, 4.0 * size, view.clip_depth);
        if (validate(view)) views.push_back(view);
    };
    add(centre, {1.0, 0.0, 0.3}, 1.0);
    add(centre + glm::dvec3(0.3 * size, 0.1 * size, 0.0), {-1.0, -0.2, 0.5}, 0.5);
    add(centre + glm::dvec3(1.5 * size, 0.2, 0.1), {-1.0, -0.1, 0.0}, 1.2);
    return views;
}

/// Plans `octree` in every way there is, and aborts if a range leaves the index buffer. What is planned is
/// chained into the answer.
inline std::uint64_t plan_everything(const RhOctree& octree) {
    if (octree.nodes().empty()) return 0;
    std::uint64_t hash = 0xcbf29ce484222325ull;
    const auto chain = [&](const std::vector<DrawRange>& ranges) {
        for (const DrawRange& range : ranges) {
            if (std::uint64_t{range.first_index} + range.index_count > octree.indices().size()) std::abort();
            for (const std::uint32_t value :
                 {static_cast<std::uint32_t>(range.batch), range.first_index, range.index_count})
                hash = (hash ^ value) * 0x100000001b3ull;
        }
    };
    DrawListSolver solver;
    DrawList list;
    NodeList nodes;
    std::vector<DrawRange> ranges;
    for (const View& view : views_of(octree.nodes()[0].bounds)) {
        const Frustum frustum = make_frustum(view, glm::dvec3(0.0));
        const Viewpoint viewpoint = make_viewpoint(view);
        for (const double draw_ns : {0.0, 20.0, 2000.0}) {
            solver.solve(octree, frustum, viewpoint, {.index_ns = 0.25, .draw_ns = draw_ns}, list);
            chain(list.ranges);
        }
        ranges.clear();
        seed_draw_list(octree, frustum, nodes);
        append_ranges(octree, nodes, ranges);
        leaf_draw_list(octree, frustum, nodes);
        append_ranges(octree, nodes, ranges);
        chain(ranges);
    }
    return hash;
}

}  // namespace rhview
