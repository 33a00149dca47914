// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// NaN, infinities, denormals, negative zeros and the largest numbers, in every float that comes over the
// border: each is refused, or what is planned with it still shows what is in view.

#include <cfloat>
#include <glm/matrix.hpp>
#include <limits>
#include <string>

#include "town.h"

namespace rhview {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHostile[] = {std::numeric_limits<double>::quiet_NaN(),
                               kInfinity,
                               -kInfinity,
                               -0.0,
                               std::numeric_limits<double>::denorm_min(),
                               -1e-310,
                               1e-45,
                               DBL_MAX,
                               -DBL_MAX,
                               1e300,
                               FLT_MAX,
                               -FLT_MAX,
                               1e20,
                               -1.0,
                               1e-20};

using Long4 = glm::vec<4, long double>;
using LongMatrix4 = glm::mat<4, 4, long double>;

/// Whether a point is in view by a margin that float can tell.
bool well_in_view(const LongMatrix4& clip_from_scene, const glm::vec3& point) {
    const Long4 p = clip_from_scene * Long4(Long4::value_type(point.x), point.y, point.z, 1.0L);
    const long double w = p.w * (1.0L - 1e-4L);
    return p.w > 0.0L && std::abs(p.x) < w && std::abs(p.y) < w && p.z < w && p.z > 1e-4L * p.w;
}

LongMatrix4 matrix_of(const double* columns) {
    LongMatrix4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = columns[i];
    return matrix;
}

/// A town with objects, and its view; `number_of_two_sided_left_out` compares its plan with the camera.
class HostileTown {
  public:
    HostileTown() : town(8), view(town.add_view(RHVIEW_OCCLUSION_EXACT)) {
        EXPECT_OK(town.status());
        auto object = sized<rhview_object>();
        object.box = {{9.0f, -1.0f, -1.0f}, {11.0f, 1.0f, 1.0f}};
        object.index_count = 300;
        EXPECT_OK(rhview_scene_add_object(town.scene, &object, &number));
    }

    rhview_status plan() {
        EXPECT_OK(rhview_scene_begin_frame(town.scene, time_s += 0.01));
        const rhview_status status = rhview_plan_views(&view, 1, nullptr);
        EXPECT_OK(rhview_scene_end_frame(town.scene));
        return status;
    }

    /// Triangles of the two-sided batch that are well in view and neither drawn nor asked about.
    std::size_t left_out(const rhview_camera& camera) {
        const std::uint32_t* indices = nullptr;
        std::size_t count = 0;
        EXPECT_OK(rhview_scene_indices(town.scene, &indices, &count));
        std::vector<bool> shown(town.balls.positions.size());
        const rhview_plan plan = plan_of(view);
        const auto show = [&](const rhview_draw& draw) {
            ASSERT_LE(std::uint64_t{draw.first_index} + draw.index_count, count);
            for (std::uint32_t i = 0; i < draw.index_count; ++i) shown[indices[draw.first_index + i]] = true;
        };
        for (std::size_t i = 0; i < plan.draw_count; ++i) show(plan.draws[i]);
        for (std::size_t i = 0; i < plan.conditional_draw_count; ++i) show(plan.conditional_draws[i].draw);
        const LongMatrix4 clip = matrix_of(camera.clip_from_camera) * matrix_of(camera.camera_from_world);
        std::size_t left_out = 0;
        for (const std::uint32_t index : town.balls.indices[2]) {
            in_view += well_in_view(clip, town.balls.positions[index]) ? 1 : 0;
            if (!shown[index] && well_in_view(clip, town.balls.positions[index])) ++left_out;
        }
        return left_out;
    }

    [[nodiscard]] bool shows_object() const {
        const rhview_plan plan = plan_of(view);
        for (std::size_t i = 0; i < plan.object_count; ++i)
            if (plan.objects[i].object == number) return true;
        for (std::size_t i = 0; i < plan.conditional_object_count; ++i)
            if (plan.conditional_objects[i].object == number) return true;
        return false;
    }

    Town town;
    rhview_view* view;
    std::uint32_t number = 0;
    double time_s = 0.0;
    std::size_t in_view = 0;
};

TEST(HostileNumbers, of_cameras_are_refused_or_leave_nothing_out) {
    HostileTown hostile;
    int accepted = 0, refused = 0;
    for (int entry = 0; entry < 32; ++entry)
        for (const double value : kHostile) {
            rhview_camera camera = camera_at(0.7);
            (entry < 16 ? camera.camera_from_world[entry] : camera.clip_from_camera[entry - 16]) = value;
            const rhview_status status = rhview_view_set_camera(hostile.view, &camera);
            if (status != RHVIEW_OK) {
                EXPECT_EQ(status, RHVIEW_INVALID_DATA);
                ++refused;
                continue;
            }
            ++accepted;
            EXPECT_OK(hostile.plan());
            EXPECT_EQ(hostile.left_out(camera), 0u) << "entry " << entry << ": " << value;
        }
    EXPECT_GT(refused, 3 * 32);
    EXPECT_GT(accepted, 100);
    EXPECT_GT(hostile.in_view, 10'000u);
}

TEST(HostileNumbers, of_boxes_are_refused_or_show_the_object) {
    HostileTown hostile;
    const rhview_camera camera = camera_at(0.0);
    ASSERT_OK(rhview_view_set_camera(hostile.view, &camera));
    int accepted = 0;
    for (int side = 0; side < 6; ++side)
        for (const double value : kHostile) {
            rhview_box box{{9.0f, -1.0f, -1.0f}, {11.0f, 1.0f, 1.0f}};
            (side < 3 ? box.min[side] : box.max[side - 3]) = static_cast<float>(value);
            const bool possible = std::isfinite(static_cast<float>(value)) && box.min[0] <= box.max[0] &&
                                  box.min[1] <= box.max[1] && box.min[2] <= box.max[2];
            for (const auto call : {&rhview_scene_move_object, &rhview_scene_jump_object}) {
                const rhview_status status = call(hostile.town.scene, hostile.number, &box);
                EXPECT_EQ(status, possible ? RHVIEW_OK : RHVIEW_INVALID_ARGUMENT) << side << ": " << value;
                if (status != RHVIEW_OK) continue;
                ++accepted;
                EXPECT_OK(hostile.plan());
                EXPECT_TRUE(hostile.shows_object()) << side << ": " << value;
            }
        }
    EXPECT_GT(accepted, 60);
}

TEST(HostileNumbers, of_objects_and_times_are_refused_or_show_the_object) {
    HostileTown hostile;
    const rhview_camera camera = camera_at(0.0);
    ASSERT_OK(rhview_view_set_camera(hostile.view, &camera));
    for (const double value : kHostile)
        for (double rhview_object::*const number : {&rhview_object::top_speed, &rhview_object::scale}) {
            auto object = sized<rhview_object>();
            object.box = {{9.0f, -1.0f, -1.0f}, {11.0f, 1.0f, 1.0f}};
            object.index_count = 300;
            object.*number = value;
            const std::uint32_t before = hostile.number;
            if (rhview_scene_add_object(hostile.town.scene, &object, &hostile.number) != RHVIEW_OK) {
                hostile.number = before;
                continue;
            }
            for (int frame = 0; frame < 3; ++frame) {
                EXPECT_OK(hostile.plan());
                EXPECT_TRUE(hostile.shows_object()) << value;
            }
            EXPECT_OK(rhview_scene_remove_object(hostile.town.scene, hostile.number));
            hostile.number = before;
        }
    double last = hostile.time_s;
    for (const double value : kHostile) {
        const bool possible = std::isfinite(value) && value >= last;
        EXPECT_EQ(rhview_scene_begin_frame(hostile.town.scene, value),
                  possible ? RHVIEW_OK : RHVIEW_INVALID_ARGUMENT)
            << value;
        if (possible) last = value;
        EXPECT_OK(rhview_plan_views(&hostile.view, 1, nullptr));
        EXPECT_TRUE(hostile.shows_object()) << value;
        EXPECT_OK(rhview_scene_end_frame(hostile.town.scene));
    }
}

TEST(HostileNumbers, of_costs_and_bounds_are_refused_or_leave_nothing_out) {
    HostileTown hostile;
    const rhview_camera camera = camera_at(0.7);
    ASSERT_OK(rhview_view_set_camera(hostile.view, &camera));
    int accepted = 0;
    const auto check = [&](double value) {
        ++accepted;
        for (int frame = 0; frame < 2; ++frame) {
            EXPECT_OK(hostile.plan());
            EXPECT_EQ(hostile.left_out(camera), 0u) << value;
        }
    };
    for (const double value : kHostile) {
        for (int number = 0; number < 9; ++number) {
            rhview_costs costs = costs_with_queries();
            double* const numbers[] = {&costs.index_ns,
                                       &costs.draw_ns,
                                       &costs.call_ns,
                                       &costs.shown_index_ns,
                                       &costs.hardware_queries.frame_ns,
                                       &costs.hardware_queries.query_ns,
                                       &costs.hardware_queries.box_ns,
                                       &costs.hardware_queries.pixel_ns,
                                       &costs.hardware_queries.draw_ns};
            *numbers[number] = value;
            auto options = sized<rhview_view_options>();
            options.costs = &costs;
            options.occlusion = RHVIEW_OCCLUSION_EXACT;
            rhview_view* view = nullptr;
            const rhview_status status = rhview_view_create(hostile.town.scene, &options, &view);
            EXPECT_EQ(status == RHVIEW_OK, std::isfinite(value) && value >= 0.0) << number << ": " << value;
            if (status != RHVIEW_OK) continue;
            EXPECT_OK(rhview_view_set_camera(view, &camera));
            std::swap(view, hostile.view);
            check(value);
            std::swap(view, hostile.view);
            rhview_view_destroy(view);
        }
        for (double rhview_level_bounds::*const number :
             {&rhview_level_bounds::max_error_px, &rhview_level_bounds::budget_ns,
              &rhview_level_bounds::object_ns}) {
            auto bounds = sized<rhview_level_bounds>();
            bounds.*number = value;
            if (rhview_view_set_levels(hostile.view, &bounds) == RHVIEW_OK) check(value);
            EXPECT_OK(rhview_view_set_levels(hostile.view, nullptr));
        }
    }
    EXPECT_GT(accepted, 60);
}

TEST(HostileNumbers, of_corners_and_origins_are_refused_or_leave_nothing_else_out) {
    for (const double value : kHostile)
        for (int coordinate = 0; coordinate < 3; ++coordinate) {
            auto place = sized<rhview_scene_options>();
            place.origin[coordinate] = value;
            rhview_scene* scene = nullptr;
            EXPECT_EQ(rhview_scene_create(&place, &scene) == RHVIEW_OK, std::isfinite(value)) << value;
            rhview_scene_destroy(scene);

            ASSERT_OK(rhview_scene_create(nullptr, &scene));
            // A triangle ahead, and one of whose nine coordinates one is the value.
            float corners[18] = {9, -1, -1, 9, 1, -1, 9, 0, 1, 19, -1, -1, 19, 1, -1, 19, 0, 1};
            corners[9 + 4 * coordinate] = static_cast<float>(value);
            const std::uint32_t indices[] = {0, 1, 2, 3, 4, 5};
            auto batch = sized<rhview_batch>();
            batch.positions = corners;
            batch.vertex_count = 6;
            batch.indices = indices;
            batch.index_count = 6;
            batch.is_two_sided = 1;
            ASSERT_OK(rhview_scene_add_batch(scene, &batch, nullptr));
            const bool possible = std::isfinite(static_cast<float>(value));
            EXPECT_EQ(rhview_scene_build(scene, nullptr), possible ? RHVIEW_OK : RHVIEW_INVALID_DATA);
            if (possible) {
                rhview_view* view = nullptr;
                ASSERT_OK(rhview_view_create(scene, nullptr, &view));
                const rhview_camera camera = camera_at(0.0);
                ASSERT_OK(rhview_view_set_camera(view, &camera));
                ASSERT_OK(rhview_plan_views(&view, 1, nullptr));
                std::uint32_t drawn = 0;
                const rhview_plan plan = plan_of(view);
                for (std::size_t i = 0; i < plan.draw_count; ++i) drawn += plan.draws[i].index_count;
                EXPECT_GE(drawn, 3u) << value;
                rhview_view_destroy(view);
            }
            rhview_scene_destroy(scene);
        }
}

}  // namespace
}  // namespace rhview
