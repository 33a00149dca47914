// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/frustum/frustum.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "rhview/frustum/box_batch.h"

namespace rhview {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// At the origin, looking along -z, 90 degrees each way, from 1 to 100 m.
View straight_view(ClipDepth depth = ClipDepth::NegativeOneToOne, double far = 100.0) {
    return {glm::dmat4(1.0), perspective(1.5707963267948966, 1.0, 1.0, far, depth), depth};
}

Aabb cube(const glm::vec3& centre, float half) {
    return {centre - half, centre + half};
}

Containment classify_all(const Frustum& frustum, const Aabb& box) {
    PlaneMask mask = frustum.mask;
    return classify(frustum, box, mask);
}

class FrustumInEveryClipDepth : public testing::TestWithParam<ClipDepth> {};

TEST_P(FrustumInEveryClipDepth, boxes_are_outside_of_each_plane_inside_or_crossing) {
    const Frustum frustum = make_frustum(straight_view(GetParam()));
    EXPECT_EQ(classify_all(frustum, cube({0, 0, -50}, 1)), Containment::Inside);
    EXPECT_EQ(classify_all(frustum, cube({-52, 0, -50}, 0.5f)), Containment::Outside);   // left
    EXPECT_EQ(classify_all(frustum, cube({52, 0, -50}, 0.5f)), Containment::Outside);    // right
    EXPECT_EQ(classify_all(frustum, cube({0, -52, -50}, 0.5f)), Containment::Outside);   // bottom
    EXPECT_EQ(classify_all(frustum, cube({0, 52, -50}, 0.5f)), Containment::Outside);    // top
    EXPECT_EQ(classify_all(frustum, cube({0, 0, -0.5f}, 0.25f)), Containment::Outside);  // near
    EXPECT_EQ(classify_all(frustum, cube({0, 0, -102}, 1)), Containment::Outside);       // far
    EXPECT_EQ(classify_all(frustum, cube({0, 0, 5}, 1)), Containment::Outside);          // behind
    for (const glm::vec3 crossing : {glm::vec3(-50, 0, -50), glm::vec3(50, 0, -50), glm::vec3(0, -50, -50),
                                     glm::vec3(0, 50, -50), glm::vec3(0, 0, -1), glm::vec3(0, 0, -100)})
        EXPECT_EQ(classify_all(frustum, cube(crossing, 0.5f)), Containment::Intersecting);
}

TEST_P(FrustumInEveryClipDepth, normals_point_inward_and_have_unit_length) {
    const Frustum frustum = make_frustum(straight_view(GetParam()));
    EXPECT_EQ(frustum.mask, 0x3f);
    for (const FrustumPlane& plane : frustum.planes) {
        EXPECT_NEAR(glm::dot(plane.normal, plane.normal), 1.0f, 1e-6f);
        EXPECT_GT(glm::dot(plane.normal, glm::vec3(0, 0, -50)) + plane.distance, 0.0f);
    }
    EXPECT_NEAR(frustum.planes[Frustum::Near].distance, -1.0f, 1e-6f);
    EXPECT_NEAR(frustum.planes[Frustum::Far].distance, 100.0f, 1e-3f);
}

TEST_P(FrustumInEveryClipDepth, far_plane_at_infinity_does_not_exist) {
    const Frustum frustum = make_frustum(straight_view(GetParam(), kInfinity));
    EXPECT_EQ(frustum.mask & (1 << Frustum::Far), 0);
    EXPECT_EQ(std::popcount(static_cast<unsigned>(frustum.mask)), 5);
    EXPECT_EQ(classify_all(frustum, cube({0, 0, -1e30f}, 1e28f)), Containment::Inside);
    EXPECT_EQ(classify_all(frustum, cube({0, 0, 1e30f}, 1e28f)), Containment::Outside);
}

TEST_P(FrustumInEveryClipDepth, orthographic_and_oblique_projections_are_understood) {
    View ortho = straight_view(GetParam());
    ortho.clip_from_camera = orthographic(4, 2, 1, 100, GetParam());
    const Frustum frustum = make_frustum(ortho);
    EXPECT_EQ(classify_all(frustum, cube({1.5f, 0, -99}, 0.25f)), Containment::Inside);
    EXPECT_EQ(classify_all(frustum, cube({2.5f, 0, -50}, 0.25f)), Containment::Outside);
    EXPECT_EQ(classify_all(frustum, cube({0, 1.5f, -50}, 0.25f)), Containment::Outside);
    EXPECT_EQ(classify_all(frustum, cube({0, 0, -101}, 0.25f)), Containment::Outside);

    View shifted = straight_view(GetParam());  // off-axis: at depth z it spans x from 2z to 0
    shifted.clip_from_camera[2][0] = -1.0;
    const Frustum off_axis = make_frustum(shifted);
    EXPECT_EQ(classify_all(off_axis, cube({-80, 0, -50}, 0.1f)), Containment::Inside);
    EXPECT_EQ(classify_all(off_axis, cube({1, 0, -50}, 0.1f)), Containment::Outside);
    EXPECT_EQ(classify_all(off_axis, cube({-101, 0, -50}, 0.1f)), Containment::Outside);
}

INSTANTIATE_TEST_SUITE_P(ClipDepths, FrustumInEveryClipDepth,
                         testing::Values(ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne,
                                         ClipDepth::ReversedZeroToOne));

TEST(Frustum, mask_keeps_only_planes_that_the_box_may_cross) {
    const Frustum frustum = make_frustum(straight_view());
    PlaneMask mask = frustum.mask;
    EXPECT_EQ(classify(frustum, cube({-50, 0, -50}, 1), mask), Containment::Intersecting);
    EXPECT_EQ(mask, 1 << Frustum::Left);
    // A box that only the planes left out would reject is taken as inside: the caller has promised.
    EXPECT_EQ(classify(frustum, cube({500, 0, -50}, 1), mask), Containment::Inside);
    PlaneMask none = 0;
    EXPECT_EQ(classify(frustum, cube({0, 0, 900}, 1), none), Containment::Inside);
}

TEST(Frustum, scene_origin_and_far_away_eye_make_no_difference) {
    View view = straight_view();
    const glm::dvec3 place(1e7 + 0.125, -3e6, 2e7);
    view.camera_from_world = look_along(place, {0, 0, -1}, {0, 1, 0});
    const Frustum frustum = make_frustum(view, place - glm::dvec3(8, 0, 0));
    EXPECT_EQ(classify_all(frustum, cube({8, 0, -50}, 1)), Containment::Inside);
    EXPECT_EQ(classify_all(frustum, cube({8 + 52, 0, -50}, 0.5f)), Containment::Outside);
}

TEST(Frustum, boxes_without_a_number_or_without_an_end_are_never_outside_nor_inside) {
    const Frustum frustum = make_frustum(straight_view());
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInf = std::numeric_limits<float>::infinity();
    for (const Aabb& box :
         {Aabb{glm::vec3(kNan), glm::vec3(kNan)}, Aabb{glm::vec3(0, kNan, 0), glm::vec3(1)},
          Aabb{glm::vec3(0, 0, 50), glm::vec3(1, kNan, 51)},
          Aabb{glm::vec3(kNan, 0, 50), glm::vec3(1, 1, 51)}, Aabb{}, Aabb{glm::vec3(-kInf), glm::vec3(kInf)},
          Aabb{glm::vec3(-3e38f), glm::vec3(3e38f)}})
        EXPECT_EQ(classify_all(frustum, box), Containment::Intersecting);
}

TEST(Frustum, point_sized_box_on_the_axis_is_inside) {
    const Frustum frustum = make_frustum(straight_view());
    EXPECT_EQ(classify_all(frustum, cube({0, 0, -50}, 0)), Containment::Inside);
    EXPECT_EQ(classify_all(frustum, cube({0, 0, -500}, 0)), Containment::Outside);
}

TEST(Frustum, of_a_singular_view_has_nothing_outside_where_contracts_are_not_checked) {
    const AssertHandler previous = set_assert_handler([](const char*, const char*, int) {});
    for (const View& view : {View{glm::dmat4(0.0), straight_view().clip_from_camera, ClipDepth::ZeroToOne},
                             View{glm::dmat4(1.0), glm::dmat4(0.0), ClipDepth::ZeroToOne},
                             View{glm::dmat4(std::nan("")), glm::dmat4(1.0), ClipDepth::ZeroToOne}}) {
        const Frustum frustum = make_frustum(view);
        for (const glm::vec3 place : {glm::vec3(0, 0, 50), glm::vec3(1e6f), glm::vec3(0)})
            EXPECT_NE(classify_all(frustum, cube(place, 1)), Containment::Outside);
    }
    set_assert_handler(previous);
}

TEST(Frustum, an_inverted_box_gets_the_same_answer_from_one_and_from_many) {
    const Frustum frustum = make_frustum(straight_view());
    const std::vector<Aabb> boxes{{glm::vec3(1, 1, -49), glm::vec3(-1, -1, -51)},
                                  {glm::vec3(9, 9, 60), glm::vec3(8, 8, 50)}};
    std::vector<std::uint64_t> visible(1);
    cull_boxes(frustum, boxes, visible);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        EXPECT_EQ(visible[0] >> i & 1u, classify_all(frustum, boxes[i]) != Containment::Outside ? 1u : 0u);
}

#if RHVIEW_ENABLE_ASSERTS
int broken_contracts = 0;

TEST(Frustum, singular_view_breaks_the_contract) {
    View view = straight_view();
    view.clip_from_camera[0][0] = 0.0;
    const AssertHandler previous =
        set_assert_handler([](const char*, const char*, int) { ++broken_contracts; });
    make_frustum(view);
    set_assert_handler(previous);
    EXPECT_EQ(broken_contracts, 1);
}
#endif

}  // namespace
}  // namespace rhview
