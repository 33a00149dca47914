// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The widening itself, without a device: the renderer's float transform of points on a box, moved by a step
// of the rasteriser's grid, stays inside the widened box and behind its shifted depth.

#include "rhview/pipeline/query_boxes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "rhview/base/rounding.h"
#include "uniform.h"

namespace rhview {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr RasterPrecision kRaster{1280, 720, 8, 0.0};

struct Lens {
    ClipDepth depth;
    double far;
    bool orthographic;
    double shear;  ///< of depth by x and y: an oblique near plane
    double offset;
};

View view_through(const Lens& lens, Uniform& uniform) {
    View view;
    view.clip_depth = lens.depth;
    view.camera_from_world =
        look_along(lens.offset * glm::dvec3(1, -1, 0.5) + uniform.point(50.0), uniform.point(1.0), {0, 1, 0});
    view.clip_from_camera = lens.orthographic
                                ? orthographic(160, 90, 0.1, lens.far, lens.depth)
                                : perspective(uniform(0.3, 2.0), 16.0 / 9.0, 0.1, lens.far, lens.depth);
    view.clip_from_camera[0][2] += lens.shear;
    view.clip_from_camera[1][2] -= 0.7 * lens.shear;
    return view;
}

/// The vertex shader's arithmetic.
glm::vec4 renderer_clip(const glm::mat4& clip, const glm::vec3& position, const SplitPosition& eye) {
    glm::vec4 result;
    for (int r = 0; r < 4; ++r) {
        volatile float sum = clip[3][r];
        for (int c = 0; c < 3; ++c) {
            const volatile float high = position[c] - eye.high[c];
            const volatile float relative = high - eye.low[c];
            const volatile float product = clip[c][r] * relative;
            sum = sum + product;
        }
        result[r] = sum;
    }
    return result;
}

class Widening : public testing::TestWithParam<Lens> {};

TEST_P(Widening, holds_every_point_of_the_box_as_the_renderer_sees_it) {
    Uniform uniform(21);
    const double step = 2.0 * std::exp2(-kRaster.subpixel_bits) / kRaster.height;  // 1 grid step, in x/w
    int tested = 0;
    for (int v = 0; v < 400; ++v) {
        const View view = view_through(GetParam(), uniform);
        const glm::dvec3 origin = GetParam().offset * glm::dvec3(1, -1, 0.5);
        const BoxWidener widener(view, origin, kRaster);
        const SplitPosition eye = split_position(view.eye() - origin);
        const glm::dmat4 m(widener.clip_from_relative());
        glm::dmat3 a;  // rows x, y and w; of parallel rays x, y and the direction itself
        const glm::dvec3 x(m[0][0], m[1][0], m[2][0]), y(m[0][1], m[1][1], m[2][1]);
        glm::dvec3 w(m[0][3], m[1][3], m[2][3]);
        const bool parallel = w == glm::dvec3(0.0);
        if (parallel) w = glm::normalize(glm::cross(x, y));
        a = glm::transpose(glm::dmat3(x, y, w));
        const glm::dmat3 inverse = glm::inverse(a);
        for (int b = 0; b < 40; ++b) {
            Aabb box;
            box.grow(glm::vec3(uniform.point(200.0)));
            box.max +=
                glm::vec3(uniform.log(1e-3, 50), uniform.log(1e-3, 50), b % 5 ? uniform.log(1e-3, 50) : 0);
            const BoxInstance instance = widener.widen(box, 77);
            EXPECT_EQ(instance.faces_and_slot >> BoxInstance::kSlotShift, 77u);
            if (instance.is_cover()) continue;
            ++tested;
            for (int p = 0; p < 30; ++p) {
                glm::vec3 point;
                for (int axis = 0; axis < 3; ++axis)
                    point[axis] = p & (1 << axis) ? box.max[axis] : box.min[axis];
                if (p >= 8)
                    point[p % 3] =
                        glm::mix(box.min[p % 3], box.max[p % 3], static_cast<float>(uniform(0, 1)));
                point = glm::clamp(point, box.min, box.max);
                const glm::dvec4 clip(renderer_clip(widener.clip_from_relative(), point, eye));
                const double moved_x = clip.x + (p % 2 ? step : -step) * clip.w;
                const double moved_y = clip.y + (p % 3 ? step : -step) * clip.w;
                const glm::dvec3 exact_relative =
                    glm::dvec3(point) - glm::dvec3(eye.high) - glm::dvec3(eye.low);
                const double third = parallel ? glm::dot(w, exact_relative) : clip.w - m[3][3];
                const glm::dvec3 q = inverse * glm::dvec3(moved_x - m[3][0], moved_y - m[3][1], third);
                for (int axis = 0; axis < 3; ++axis) {
                    ASSERT_GT(q[axis], static_cast<double>(instance.low[axis]));
                    ASSERT_LT(q[axis], static_cast<double>(instance.high[axis]));
                }
                const double z = m[0][2] * q.x + m[1][2] * q.y + m[2][2] * q.z + m[3][2];
                const glm::dvec4 error(widener.depth_error());
                const double shift =
                    glm::dot(glm::dvec3(error), glm::abs(q)) + error.w + instance.shift * clip.w;
                // At least one step of the depth buffer nearer than what the renderer makes of the vertex.
                const double ulp = clip.w * (view.clip_depth == ClipDepth::NegativeOneToOne
                                                 ? 0x1p-23
                                                 : 0x1p-24 * std::abs(clip.z / clip.w));
                if (widener.nearer() < 0.0f)
                    ASSERT_LE(z - shift, clip.z - ulp);
                else
                    ASSERT_GE(z + shift, clip.z + ulp);
            }
        }
    }
    EXPECT_GT(tested, 1000);
}

INSTANTIATE_TEST_SUITE_P(Lenses, Widening,
                         testing::Values(Lens{ClipDepth::NegativeOneToOne, 1000, false, 0, 0},
                                         Lens{ClipDepth::NegativeOneToOne, 1e6, false, 0, 1e6},
                                         Lens{ClipDepth::ZeroToOne, 1000, false, 0, 0},
                                         Lens{ClipDepth::ZeroToOne, 1000, false, 0.3, 1e4},
                                         Lens{ClipDepth::ReversedZeroToOne, kInfinity, false, 0, 1e7},
                                         Lens{ClipDepth::ReversedZeroToOne, 1000, false, 0.2, 0},
                                         Lens{ClipDepth::NegativeOneToOne, 1000, true, 0, 0},
                                         Lens{ClipDepth::ReversedZeroToOne, 1000, true, 0.01, 1e5}));

TEST(QueryBoxes, faces_are_those_that_face_the_eye) {
    const View view{look_along({0, 0, 0}, {0, 0, -1}, {0, 1, 0}),
                    perspective(1.0, 1.0, 0.1, 100.0, ClipDepth::ZeroToOne), ClipDepth::ZeroToOne};
    const BoxWidener widener(view, glm::dvec3(0.0), kRaster);
    const auto faces = [&](const Aabb& box) { return widener.widen(box, 0).faces_and_slot; };
    EXPECT_EQ(faces({{-1, -1, -12}, {1, 1, -10}}), 2u << 4);
    EXPECT_EQ(faces({{2, 3, -12}, {4, 5, -10}}), 1u | 1u << 2 | 2u << 4);
    EXPECT_EQ(faces({{-4, -5, -12}, {-2, -3, -10}}), 2u | 2u << 2 | 2u << 4);
    View parallel = view;
    parallel.clip_from_camera = orthographic(20, 20, 0.1, 100, ClipDepth::ZeroToOne);
    const BoxWidener along(parallel, glm::dvec3(0.0), kRaster);
    EXPECT_EQ(along.widen({{2, 3, -12}, {4, 5, -10}}, 0).faces_and_slot, 2u << 4);
}

TEST(QueryBoxes, what_is_scaled_to_nothing_widens_no_box) {
    for (const glm::dvec3& scale : {glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 1.0), glm::dvec3(0.0, 3.0, 0.0)})
        EXPECT_EQ(rounding_growth(glm::scale(glm::dmat4(1.0), scale)), 1.0);
    EXPECT_EQ(rounding_growth(glm::dmat4(glm::dmat3(1, 2, 3, 4, 5, 6, 7, 8, 9))), 1.0);
}

TEST(QueryBoxes, an_objects_rounding_grows_with_its_shear) {
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    EXPECT_EQ(rounding_growth(glm::translate(glm::dmat4(1.0), {1e6, 2, 3})), 1.0);
    EXPECT_DOUBLE_EQ(rounding_growth(glm::scale(glm::dmat4(1.0), {1e-3, 5, -100})), 1.0);
    EXPECT_LE(rounding_growth(glm::scale(turned, {1e-3, 5, 100})), 3.0);
    glm::dmat4 sheared(1.0);
    sheared[1][0] = 100.0;
    EXPECT_GT(rounding_growth(sheared), 100.0);
}

}  // namespace
}  // namespace rhview
