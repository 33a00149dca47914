// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/base/view.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace rhview {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

View sample_view() {
    return {look_along({1e7, 20.0, -3e6}, {1.0, -0.2, 3.0}, {0.0, 1.0, 0.0}),
            perspective(1.0, 16.0 / 9.0, 0.1, 500.0, ClipDepth::NegativeOneToOne),
            ClipDepth::NegativeOneToOne};
}

TEST(View, eye_is_where_the_camera_was_put) {
    EXPECT_LT(glm::distance(sample_view().eye(), glm::dvec3(1e7, 20.0, -3e6)), 1e-6);
}

TEST(View, eye_relative_clip_matrix_agrees_with_the_whole_one) {
    View view = sample_view();
    view.camera_from_world = look_along({3, 2, 1}, {1, 0, 1}, {0, 1, 0});
    const glm::dvec3 point(30, 4, 25);
    const glm::dvec4 whole = view.clip_from_camera * view.camera_from_world * glm::dvec4(point, 1.0);
    const glm::dvec4 relative = view.clip_from_eye_relative() * glm::dvec4(point - view.eye(), 1.0);
    EXPECT_LT(glm::distance(whole, relative), 1e-12);
}

TEST(View, perspective_maps_near_and_far_to_the_ends_of_each_clip_depth) {
    const struct {
        ClipDepth depth;
        double near, far;
    } cases[] = {{ClipDepth::NegativeOneToOne, -1, 1},
                 {ClipDepth::ZeroToOne, 0, 1},
                 {ClipDepth::ReversedZeroToOne, 1, 0}};
    for (const auto& c : cases) {
        for (const double far : {1e3, 1e9}) {
            for (const bool ortho : {false, true}) {
                const glm::dmat4 clip =
                    ortho ? orthographic(4, 3, 0.1, far, c.depth) : perspective(1.2, 1.5, 0.1, far, c.depth);
                const glm::dvec4 at_near = clip * glm::dvec4(0, 0, -0.1, 1);
                const glm::dvec4 at_far = clip * glm::dvec4(0, 0, -far, 1);
                EXPECT_NEAR(at_near.z / at_near.w, c.near, 1e-9);
                EXPECT_NEAR(at_far.z / at_far.w, c.far, 1e-9);
            }
        }
        const glm::dvec4 distant =
            perspective(1.2, 1.5, 0.1, kInfinity, c.depth) * glm::dvec4(0, 0, -1e12, 1);
        EXPECT_NEAR(distant.z / distant.w, c.far, 1e-9);
    }
}

TEST(View, bad_cameras_are_refused_by_name) {
    EXPECT_TRUE(validate(sample_view()).ok());
    View nan = sample_view();
    nan.camera_from_world[3][1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(validate(nan).error().message.find("finite"), std::string::npos);
    for (int i = 1; i < 200; ++i) {  // rounding leaves most of these a tiny angle
        View parallel = sample_view();
        const glm::dvec3 direction(0.37 * i, 1.0 / i, -0.11 * i);
        parallel.camera_from_world = look_along({0, 0, 0}, direction, -3.3 * direction);
        ASSERT_FALSE(validate(parallel).ok());
        EXPECT_NE(validate(parallel).error().message.find("up vector"), std::string::npos);
    }
    View same_rows = sample_view();
    for (int column = 0; column < 4; ++column)
        same_rows.clip_from_camera[column][1] = -2.0 * same_rows.clip_from_camera[column][0];
    EXPECT_NE(validate(same_rows).error().message.find("projection is singular"), std::string::npos);
    View flat = sample_view();
    flat.camera_from_world = glm::scale(glm::dmat4(1.0), glm::dvec3(1, 0, 1));
    EXPECT_NE(validate(flat).error().message.find("singular"), std::string::npos);
    View projective = sample_view();
    projective.camera_from_world[0][3] = 0.5;
    EXPECT_NE(validate(projective).error().message.find("affine"), std::string::npos);
    View no_width = sample_view();
    no_width.clip_from_camera[0][0] = 0.0;
    EXPECT_NE(validate(no_width).error().message.find("projection is singular"), std::string::npos);
}

}  // namespace
}  // namespace rhview
