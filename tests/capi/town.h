// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "balls.h"
#include "rhview/base/view.h"
#include "rhview/rhview.h"

namespace rhview {

/// A structure as the header asks for it.
template <class Struct>
Struct sized() {
    Struct made{};
    made.size = sizeof(Struct);
    return made;
}

#define EXPECT_OK(call) EXPECT_EQ(call, RHVIEW_OK) << rhview_last_error()
#define ASSERT_OK(call) ASSERT_EQ(call, RHVIEW_OK) << rhview_last_error()

inline rhview_costs costs_with_queries() {
    auto costs = sized<rhview_costs>();
    costs.index_ns = 1.0;
    costs.draw_ns = 60.0;
    costs.has_hardware_queries = 1;
    costs.hardware_queries = {0.0, 300.0, 30.0, 1e-3, 80.0};
    return costs;
}

inline rhview_camera camera_at(double angle) {
    auto camera = sized<rhview_camera>();
    const glm::dmat4 world = look_along({0, 0, 0}, {std::cos(angle), 0, std::sin(angle)}, {0, 1, 0});
    const glm::dmat4 clip = perspective(1.0, 1.5, 0.1, 500.0, ClipDepth::ReversedZeroToOne);
    for (int i = 0; i < 16; ++i) {
        camera.camera_from_world[i] = world[i / 4][i % 4];
        camera.clip_from_camera[i] = clip[i / 4][i % 4];
    }
    camera.clip_depth = RHVIEW_DEPTH_REVERSED;
    camera.viewport_width = 1280;
    camera.viewport_height = 720;
    return camera;
}

/// Balls around the eye, built and with one view, through C.
class Town {
  public:
    explicit Town(std::uint32_t max_objects = 0, const rhview_build_options* given = nullptr)
        : balls(511, 3, 60, 200) {
        auto options = sized<rhview_scene_options>();
        options.max_objects = max_objects;
        status_ = rhview_scene_create(&options, &scene);
        for (const TriangleBatch& source : balls.batches()) {
            auto batch = sized<rhview_batch>();
            batch.positions = &source.positions.data()->x;
            batch.vertex_count = source.positions.size();
            batch.indices = source.indices.data();
            batch.index_count = source.indices.size();
            batch.is_two_sided = source.two_sided ? 1 : 0;
            keep(rhview_scene_add_batch(scene, &batch, nullptr));
        }
        const rhview_costs costs = costs_with_queries();
        auto build = sized<rhview_build_options>();
        build.costs = &costs;
        build.max_leaf_triangles = 40;
        keep(rhview_scene_build(scene, given != nullptr ? given : &build));
    }
    ~Town() {
        for (rhview_view* view : views) rhview_view_destroy(view);
        rhview_scene_destroy(scene);
    }
    Town(const Town&) = delete;
    Town& operator=(const Town&) = delete;

    /// The first call that failed.
    [[nodiscard]] rhview_status status() const { return status_; }

    rhview_view* add_view(std::uint32_t occlusion, double angle = 0.0) {
        const rhview_costs costs = costs_with_queries();
        auto options = sized<rhview_view_options>();
        options.costs = &costs;
        options.occlusion = occlusion;
        rhview_view* view = nullptr;
        keep(rhview_view_create(scene, &options, &view));
        const rhview_camera camera = camera_at(angle);
        keep(rhview_view_set_camera(view, &camera));
        if (view != nullptr) views.push_back(view);
        return view;
    }

    Balls balls;
    rhview_scene* scene = nullptr;
    std::vector<rhview_view*> views;

  private:
    void keep(rhview_status status) { status_ = status_ == RHVIEW_OK ? status : status_; }

    rhview_status status_ = RHVIEW_OK;
};

inline rhview_plan plan_of(const rhview_view* view) {
    auto plan = sized<rhview_plan>();
    EXPECT_OK(rhview_view_plan(view, &plan));
    return plan;
}

}  // namespace rhview
