// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/frustum/bounding_volumes.h"

#include <gtest/gtest.h>

#include <limits>

#include "perspective_hull.h"
#include "random_boxes.h"
#include "rhview/frustum/corner_test.h"

namespace rhview {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

template <class Volume>
Containment classify_all(const Frustum& frustum, const Volume& volume) {
    PlaneMask mask = frustum.mask;
    return classify(frustum, volume, mask);
}

/// At the origin, looking along -z, 90 degrees each way, from 1 to 100 m.
View straight_view(ClipDepth depth) {
    return {glm::dmat4(1.0), perspective(1.5707963267948966, 1.0, 1.0, 100.0, depth), depth};
}

TEST(Spheres, are_outside_of_each_plane_inside_or_crossing_in_every_clip_depth) {
    for (const ClipDepth depth :
         {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne, ClipDepth::ReversedZeroToOne}) {
        const Frustum frustum = make_frustum(straight_view(depth));
        EXPECT_EQ(classify_all(frustum, Sphere{{0, 0, -50}, 30}), Containment::Inside);
        for (const glm::vec3 side :
             {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0)}) {
            // The distance of that point from the side plane is 10 / sqrt(2).
            const glm::vec3 centre = glm::vec3(0, 0, -50) + 60.0f * side;
            EXPECT_EQ(classify_all(frustum, Sphere{centre, 7.0f}), Containment::Outside);
            EXPECT_EQ(classify_all(frustum, Sphere{centre, 7.1f}), Containment::Intersecting);
        }
        EXPECT_EQ(classify_all(frustum, Sphere{{0, 0, -110}, 9.9f}), Containment::Outside);
        EXPECT_EQ(classify_all(frustum, Sphere{{0, 0, -110}, 10.1f}), Containment::Intersecting);
        EXPECT_EQ(classify_all(frustum, Sphere{{0, 0, 1}, 1.9f}), Containment::Outside);
        EXPECT_EQ(classify_all(frustum, Sphere{{0, 0, -50}, 0}), Containment::Inside);
        PlaneMask mask = frustum.mask;
        classify(frustum, Sphere{{0, 0, -98}, 5}, mask);
        EXPECT_EQ(mask, 1 << Frustum::Far);
    }
}

TEST(OrientedBoxes, a_turned_box_is_tested_by_its_own_axes) {
    const Frustum frustum = make_frustum(straight_view(ClipDepth::ZeroToOne));
    // A long bar beside the left plane, turned to lie along it: its axis-aligned box would cross.
    const glm::vec3 along = glm::normalize(glm::vec3(-1, 0, -1)), off = glm::normalize(glm::vec3(-1, 0, 1));
    const glm::vec3 on_plane(-50, 0, -50);
    const OrientedBox bar{on_plane + 1.5f * off, {30.0f * along, 1.0f * off, glm::vec3(0, 1, 0)}};
    EXPECT_EQ(classify_all(frustum, bar), Containment::Outside);
    EXPECT_EQ(classify_all(frustum, OrientedBox{on_plane + 0.9f * off, bar.half_axes}),
              Containment::Intersecting);
    EXPECT_EQ(classify_all(frustum, OrientedBox{on_plane - 1.5f * off, bar.half_axes}), Containment::Inside);
}

TEST(OrientedBoxes, equal_axis_aligned_boxes_and_contain_spheres_in_random_views_far_from_the_origin) {
    std::size_t outside = 0, inside = 0;
    for (const double offset : {0.0, 1e5, 1e7}) {
        Uniform uniform(static_cast<std::uint32_t>(offset) + 1);
        for (int v = 0; v < 100; ++v) {
            const glm::dvec3 eye = glm::dvec3(offset) + uniform.point(20.0);
            const Frustum frustum = make_frustum(random_view(uniform, eye, static_cast<ClipDepth>(v % 3)));
            for (const Aabb& box : random_boxes(uniform, 200, eye, uniform.log(1.0, 300.0), 0.1, 100.0)) {
                const glm::vec3 half = 0.5f * box.extent();
                const OrientedBox oriented{
                    box.centre(),
                    {glm::vec3(half.x, 0, 0), glm::vec3(0, half.y, 0), glm::vec3(0, 0, half.z)}};
                const Sphere around{box.centre(), 1.0001f * glm::length(half)};
                const Containment answer = classify_all(frustum, oriented);
                // Both are proofs about nearly the same box: they may differ by "proves nothing" only.
                const Containment of_box = classify_all(frustum, box);
                ASSERT_FALSE(answer == Containment::Outside && of_box == Containment::Inside);
                ASSERT_FALSE(answer == Containment::Inside && of_box == Containment::Outside);
                if (classify_all(frustum, around) == Containment::Outside) {
                    ++outside;
                    ASSERT_EQ(answer, Containment::Outside);
                }
                if (classify_all(frustum, around) == Containment::Inside) {
                    ++inside;
                    ASSERT_EQ(answer, Containment::Inside);
                }
            }
        }
    }
    EXPECT_GT(outside, 1000u);
    EXPECT_GT(inside, 1000u);
}

TEST(OrientedBoxes, no_box_or_sphere_that_touches_the_frustum_in_long_double_is_outside) {
    Uniform uniform(5);
    std::size_t touching = 0, rejected = 0;
    for (int v = 0; v < 300; ++v) {
        PerspectiveCamera camera;
        camera.eye = uniform.point(v % 2 == 0 ? 10.0 : 1e7);
        camera.forward = uniform.point(1.0), camera.up = {0.1, 1.0, 0.05};
        camera.fov_y = uniform.log(0.02, 2.9), camera.near = uniform.log(1e-3, 1.0);
        camera.far = camera.near * uniform.log(10.0, 1e7), camera.aspect = uniform(0.5, 2.0);
        camera.clip_depth = static_cast<ClipDepth>(v % 3);
        const Frustum frustum = make_frustum(camera.view());
        const FrustumHull<Exact> hull = camera.hull();
        for (int b = 0; b < 200; ++b) {
            const glm::vec3 x = glm::normalize(glm::vec3(uniform.point(1.0)));
            const glm::vec3 y = glm::normalize(glm::cross(x, glm::vec3(uniform.point(1.0))));
            const glm::vec3 z = glm::cross(x, y);
            const double distance = uniform.log(0.1 * camera.near, 2.0 * camera.far);
            const glm::vec3 centre(camera.eye +
                                   distance * (glm::normalize(camera.forward) + 0.7 * uniform.point(1.0)));
            const glm::dvec3 half =
                distance * uniform.log(1e-3, 1.0) * glm::dvec3(1.0, uniform(0, 1), uniform(0, 1));
            const OrientedBox box{centre,
                                  {x * static_cast<float>(half.x), y * static_cast<float>(half.y),
                                   z * static_cast<float>(half.z)}};
            const HullBox<Exact> exact{ExactVec(centre) - ExactVec(camera.eye),
                                       {ExactVec(x), ExactVec(y), ExactVec(z)},
                                       ExactVec(half) * Exact{0.999999}};  // the axes are rounded
            const bool touches = !are_separated(hull, exact);
            touching += touches;
            const bool outside = classify_all(frustum, box) == Containment::Outside;
            rejected += outside;
            ASSERT_FALSE(touches && outside);
            const Sphere sphere{centre, static_cast<float>(1.0001 * glm::length(half))};
            ASSERT_FALSE(touches && classify_all(frustum, sphere) == Containment::Outside);
        }
    }
    EXPECT_GT(touching, 3000u);
    EXPECT_GT(rejected, 3000u);
}

TEST(BoundingVolumes, without_a_number_or_an_end_prove_nothing) {
    const Frustum frustum = make_frustum(straight_view(ClipDepth::ZeroToOne));
    for (const float odd : {kNan, kInf}) {
        EXPECT_EQ(classify_all(frustum, Sphere{{0, 0, -50}, odd}), Containment::Intersecting);
        EXPECT_EQ(classify_all(frustum, Sphere{{odd, 0, 50}, 1}), Containment::Intersecting);
        EXPECT_EQ(classify_all(frustum, OrientedBox{{0, odd, 50}, {}}), Containment::Intersecting);
        EXPECT_EQ(classify_all(frustum,
                               OrientedBox{{0, 0, 50}, {glm::vec3(1), glm::vec3(0, odd, 0), glm::vec3(1)}}),
                  Containment::Intersecting);
    }
    const OrientedBox point{{0, 0, -50}, {}};
    EXPECT_EQ(classify_all(frustum, point), Containment::Inside);
}

TEST(CornerFrustum, rejects_a_large_box_beyond_all_corners_that_no_plane_rejects) {
    const View view = straight_view(ClipDepth::ReversedZeroToOne);
    const CornerFrustum frustum = make_corner_frustum(view);
    const Aabb behind_the_corner{glm::vec3(105, -400, -400), glm::vec3(900, 400, 400)};
    EXPECT_EQ(classify_all(make_frustum(view), behind_the_corner), Containment::Intersecting);
    PlaneMask mask = frustum.mask;
    EXPECT_EQ(classify(frustum, behind_the_corner, mask), Containment::Outside);
    const Aabb at_the_corner{glm::vec3(95, -400, -400), glm::vec3(900, 400, 400)};
    mask = frustum.mask;
    EXPECT_EQ(classify(frustum, at_the_corner, mask), Containment::Intersecting);
    EXPECT_NEAR(frustum.extents[0].corner_box.max.x, 100.0f, 0.01f);
    EXPECT_NEAR(frustum.extents[0].corner_box.min.z, -100.0f, 0.01f);
    EXPECT_NEAR(frustum.extents[0].corner_box.max.z, -1.0f, 0.01f);
}

TEST(CornerFrustum, without_a_far_plane_answers_as_the_plain_frustum) {
    View view = straight_view(ClipDepth::ReversedZeroToOne);
    view.clip_from_camera = perspective(1.0, 1.0, 0.1, HUGE_VAL, view.clip_depth);
    const CornerFrustum frustum = make_corner_frustum(view);
    Uniform uniform(3);
    for (const Aabb& box : random_boxes(uniform, 2000, glm::dvec3(0), 100.0, 1.0, 300.0)) {
        PlaneMask mask = frustum.mask;
        EXPECT_EQ(classify(frustum, box, mask), classify_all(make_frustum(view), box));
    }
}

TEST(CornerFrustum, a_box_without_a_number_is_not_outside_even_beyond_the_corners) {
    const CornerFrustum frustum = make_corner_frustum(straight_view(ClipDepth::ZeroToOne));
    for (const float odd : {kNan, kInf, -kInf}) {
        PlaneMask mask = frustum.mask;
        EXPECT_EQ(classify(frustum, Aabb{glm::vec3(200, odd, 0), glm::vec3(300, 1, 1)}, mask),
                  Containment::Intersecting);
    }
}

}  // namespace
}  // namespace rhview
