// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The promise that matters: what a renderer's float transform could put on the screen is never `Outside`, and
// `Inside` means that no vertex is clipped. The oracle is that float transform itself, as `gl` does it, and
// long double.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "random_boxes.h"
#include "rhview/base/rounding.h"
#include "rhview/frustum/corner_test.h"
#include "rhview/frustum/frustum.h"

namespace rhview {
namespace {

/// The vertex shader of `gl`, in float: eye subtracted as a pair, then the camera-relative clip matrix.
struct FloatRenderer {
    explicit FloatRenderer(const View& view)
        : eye(split_position(view.eye())), clip(view.clip_from_eye_relative()) {}
    [[nodiscard]] glm::vec4 transform(const glm::vec3& vertex) const {
        const glm::vec3 relative = (vertex - eye.high) - eye.low;
        return clip * glm::vec4(relative, 1.0f);
    }
    SplitPosition eye;
    glm::mat4 clip;
};

/// Which of the six clip conditions a vertex breaks, one bit each.
unsigned broken_conditions(const glm::vec4& c, ClipDepth depth) {
    const float near_limit = depth == ClipDepth::NegativeOneToOne ? -c.w : 0.0f;
    return (c.x < -c.w ? 1u : 0u) | (c.x > c.w ? 2u : 0u) | (c.y < -c.w ? 4u : 0u) | (c.y > c.w ? 8u : 0u) |
           (c.z < near_limit ? 16u : 0u) | (c.z > c.w ? 32u : 0u);
}

struct Case {
    double world_offset;
    ClipDepth depth;
};

class FrustumOracle : public testing::TestWithParam<Case> {};

TEST_P(FrustumOracle,
       no_box_with_a_vertex_that_a_float_renderer_keeps_is_outside_and_inside_boxes_are_not_clipped) {
    const auto [offset, depth] = GetParam();
    Uniform uniform(static_cast<std::uint32_t>(offset) + static_cast<std::uint32_t>(depth));
    std::size_t outside = 0, inside = 0;
    for (int v = 0; v < 300; ++v) {
        const glm::dvec3 eye = glm::dvec3(offset) + uniform.point(50.0);
        const View view = random_view(uniform, eye, depth);
        const Frustum frustum = make_frustum(view);
        const FloatRenderer renderer(view);
        for (int b = 0; b < 300; ++b) {
            const glm::vec3 centre(eye + uniform.point(uniform.log(0.1, 1e4)));
            const glm::vec3 half(uniform.log(1e-6, 1e3) *
                                 glm::dvec3(uniform(0, 1), uniform(0, 1), uniform(0, 1)));
            const Aabb box{centre - half, centre + half};
            PlaneMask mask = frustum.mask;
            const Containment answer = classify(frustum, box, mask);
            unsigned broken_by_all = 0x3f, broken_by_any = 0;
            for (int i = 0; i < 8; ++i) {
                const glm::vec3 corner((i & 1 ? box.max : box.min).x, (i & 2 ? box.max : box.min).y,
                                       (i & 4 ? box.max : box.min).z);
                const unsigned broken = broken_conditions(renderer.transform(corner), depth);
                broken_by_all &= broken;
                broken_by_any |= broken;
            }
            // The renderer throws a box away as a whole only if all its corners break one and the same
            // condition.
            if (answer == Containment::Outside) {
                ++outside;
                ASSERT_NE(broken_by_all, 0u) << "a box that may be drawn was rejected";
            }
            if (answer == Containment::Inside) {
                ++inside;
                ASSERT_EQ(broken_by_any, 0u) << "a box that is clipped was called inside";
            }
        }
    }
    EXPECT_GT(outside, 10'000u);  // the test must not pass by proving nothing
    EXPECT_GT(inside, 1'000u);
}

INSTANTIATE_TEST_SUITE_P(
    Offsets, FrustumOracle,
    testing::Values(Case{0, ClipDepth::NegativeOneToOne}, Case{1e3, ClipDepth::NegativeOneToOne},
                    Case{1e5, ClipDepth::NegativeOneToOne}, Case{1e7, ClipDepth::NegativeOneToOne},
                    Case{0, ClipDepth::ZeroToOne}, Case{1e7, ClipDepth::ZeroToOne},
                    Case{0, ClipDepth::ReversedZeroToOne}, Case{1e7, ClipDepth::ReversedZeroToOne}));

/// Whether anything of a triangle is left after clipping. Sutherland & Hodgman, homogeneous, in double.
bool is_drawn(const std::array<glm::vec4, 3>& corners, ClipDepth depth) {
    std::vector<glm::dvec4> polygon(corners.begin(), corners.end()), next;
    for (int condition = 0; condition < 6; ++condition) {
        const auto inside_by = [&](const glm::dvec4& c) {
            const double near_limit = depth == ClipDepth::NegativeOneToOne ? -c.w : 0.0;
            const double by[] = {c.x + c.w, c.w - c.x, c.y + c.w, c.w - c.y, c.z - near_limit, c.w - c.z};
            return by[condition];
        };
        next.clear();
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec4 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
            const double da = inside_by(a), db = inside_by(b);
            if (da >= 0.0) next.push_back(a);
            if ((da >= 0.0) != (db >= 0.0)) next.push_back(glm::mix(a, b, da / (da - db)));
        }
        polygon.swap(next);
        if (polygon.empty()) return false;
    }
    return true;
}

TEST(FrustumOracle, what_a_float_renderer_draws_of_a_huge_triangle_is_never_outside_by_corners_or_edges) {
    // Triangles with an edge along an axis that grazes a corner of the frustum, and vertices very far away,
    // whose rounding moves that edge.
    Uniform uniform(21);
    std::size_t drawn = 0, outside = 0;
    for (int v = 0; v < 4000; ++v) {
        const glm::dvec3 eye = uniform.point(uniform.log(1.0, 1e5));
        const auto depth = static_cast<ClipDepth>(v % 3);
        View view = random_view(uniform, eye, depth);
        if (v % 2 == 0)
            view.clip_from_camera =
                perspective(uniform(0.3, 1.5), uniform(0.5, 2.0), 1.0, uniform.log(3.0, 300.0), depth);
        const CornerFrustum frustum = make_corner_frustum(view);
        const FloatRenderer renderer(view);
        const glm::dmat4 world_from_clip = glm::inverse(view.clip_from_eye_relative());
        for (int t = 0; t < 60; ++t) {
            const double near_depth = depth == ClipDepth::NegativeOneToOne ? -1.0 : 0.0;
            const glm::dvec4 corner = world_from_clip * glm::dvec4(t & 1 ? 1.0 : -1.0, t & 2 ? 1.0 : -1.0,
                                                                   t & 4 ? 1.0 : near_depth, 1.0);
            const glm::dvec3 at = eye + glm::dvec3(corner) / corner.w;
            const double reach = glm::length(at - eye) * uniform.log(1.0, 1e5);
            const double off = uniform.log(1e-9, 1.0) * reach * (t & 8 ? 1.0 : -1.0);
            const int axis = t % 3;
            glm::dvec3 along = uniform.point(1.0);
            along[axis] = 0.0;
            glm::dvec3 aside = uniform.point(1.0);
            aside[axis] = uniform(0.0, 1.0) * (t & 16 ? 1.0 : -1.0);
            glm::dvec3 edge = at;
            edge[axis] += off;
            const std::array<glm::vec3, 3> vertices{glm::vec3(edge + reach * along),
                                                    glm::vec3(edge - reach * uniform(0.0, 1.0) * along),
                                                    glm::vec3(edge + reach * aside)};
            const Aabb box{glm::min(glm::min(vertices[0], vertices[1]), vertices[2]),
                           glm::max(glm::max(vertices[0], vertices[1]), vertices[2])};
            PlaneMask mask = frustum.mask;
            const bool is_outside = classify(frustum, box, mask) == Containment::Outside;
            outside += is_outside;
            const bool seen = is_drawn({renderer.transform(vertices[0]), renderer.transform(vertices[1]),
                                        renderer.transform(vertices[2])},
                                       depth);
            drawn += seen;
            ASSERT_FALSE(is_outside && seen) << "view " << v << ", triangle " << t;
        }
    }
    EXPECT_GT(drawn, 10'000u);  // the test must not pass by proving nothing
    EXPECT_GT(outside, 10'000u);
}

TEST(FrustumOracle, boxes_that_touch_the_frustum_in_long_double_are_never_outside) {
    Uniform uniform(7);
    for (int v = 0; v < 500; ++v) {
        const glm::dvec3 eye = uniform.point(1e6);
        const View view = random_view(uniform, eye, ClipDepth::ReversedZeroToOne);
        const Frustum frustum = make_frustum(view);
        const glm::dmat4 eye_from_clip = glm::inverse(view.clip_from_eye_relative());
        for (int b = 0; b < 200; ++b) {
            // A point on the frustum's surface, as a box of no size rounded outwards.
            glm::dvec4 clip(uniform(-1, 1), uniform(-1, 1), uniform(0, 1), 1.0);
            clip[b % 3] = b % 3 == 2 ? (b & 1 ? 0.0 : 1.0) : (b & 1 ? -1.0 : 1.0);
            const glm::dvec4 p = eye_from_clip * clip;
            const glm::dvec3 world = eye + glm::dvec3(p) / p.w;
            Aabb box;
            for (int axis = 0; axis < 3; ++axis) {
                box.min[axis] = std::nextafter(static_cast<float>(world[axis]), -3e38f);
                box.max[axis] = std::nextafter(static_cast<float>(world[axis]), 3e38f);
            }
            PlaneMask mask = frustum.mask;
            ASSERT_NE(classify(frustum, box, mask), Containment::Outside);
        }
    }
}

}  // namespace
}  // namespace rhview
