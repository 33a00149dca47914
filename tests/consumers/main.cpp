// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// What an engine does first; both ways of taking rhview compile it.

#include <rhview/base/aabb.h>
#include <rhview/base/version.h>
#include <rhview/base/view.h>
#include <rhview/frustum/frustum.h>
#include <rhview/lod/lod_chain.h>
#include <rhview/pipeline/seed_planner.h>
#include <rhview/timing_model/profile.h>

#include <cstdio>
#include <vector>

int main() {
    rhview::View view;
    view.camera_from_world = rhview::look_along({0, 2, 0}, {0, 0, -1}, {0, 1, 0});
    view.clip_from_camera = rhview::perspective(1.0, 1.5, 0.1, 100.0, rhview::ClipDepth::ZeroToOne);
    view.clip_depth = rhview::ClipDepth::ZeroToOne;
    if (!rhview::validate(view)) return 1;

    const rhview::Frustum frustum = rhview::make_frustum(view);
    rhview::PlaneMask mask = frustum.mask;
    if (rhview::classify(frustum, {{-1, 1, -11}, {1, 3, -9}}, mask) != rhview::Containment::Inside) return 2;
    mask = frustum.mask;
    if (rhview::classify(frustum, {{-1, 1, 9}, {1, 3, 11}}, mask) != rhview::Containment::Outside) return 3;

    const std::vector<glm::vec3> positions{{-1, 1, -10}, {1, 1, -10}, {0, 3, -10},
                                           {-1, 1, 10},  {1, 1, 10},  {0, 3, 10}};
    const std::vector<std::uint32_t> indices{0, 1, 2, 3, 4, 5};
    const rhview::TriangleBatch batch{rhview::MaterialId{0}, positions, indices};
    const auto octree = rhview::build_octree({&batch, 1}, {.max_leaf_triangles = 1});
    if (!octree) return 4;
    rhview::SeedPlanner planner(*octree);
    rhview::FramePlan plan;
    planner.plan({.culling_view = view}, plan);
    if (plan.opaque.size() != 1 || plan.opaque[0].index_count != 3) return 5;

    const auto profile = rhview::parse_profile(
        R"({"schema": "rhview.profile/1", "device": {"renderer": "r", "version": "v"}, "c0_ns": 0, "c1_ns": 2, "c3_ns": 9})",
        "profile");
    if (!profile || profile->predict_ns({.indices = 3, .draw_calls = 1}) != 15.0) return 6;

    std::printf("rhview %s: one box inside, one outside\n", rhview::kVersion);
    return 0;
}
