// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Random boxes and views over everything that floats make hard, against separating axes in long double. How
// many: the environment variable RHVIEW_FRUSTUM_RANDOM_BOXES, by default a million (a tenth of that with
// contract checks on).

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "perspective_hull.h"
#include "rhview/frustum/box_batch.h"
#include "rhview/frustum/corner_test.h"
#include "uniform.h"

namespace rhview {
namespace {

constexpr double kDegree = 0.017453292519943295;

std::size_t boxes_to_test() {
    if (const char* count = std::getenv("RHVIEW_FRUSTUM_RANDOM_BOXES"))
        return std::strtoull(count, nullptr, 10);
    return RHVIEW_ENABLE_ASSERTS ? 100'000 : 1'000'000;
}

PerspectiveCamera random_camera(Uniform& uniform, double world_offset) {
    PerspectiveCamera camera;
    camera.eye = glm::dvec3(world_offset) + uniform.point(50.0);
    camera.forward = uniform.point(1.0);
    camera.up = {0.1, 1.0, 0.05};
    camera.fov_y = uniform.log(1.0, 170.0) * kDegree;
    camera.aspect = uniform.log(0.5, 2.5);
    camera.near = uniform.log(1e-3, 10.0);
    camera.far = uniform.log(4.0 * camera.near, 1e8);
    camera.clip_depth = static_cast<ClipDepth>(static_cast<int>(uniform(0.0, 3.0)));
    return camera;
}

/// Around a place in or near the frustum, at any depth, so that many boxes touch its sides and corners.
Aabb random_box(Uniform& uniform, const FrustumHull<Exact>& hull, const glm::dvec3& eye) {
    const double depth =
        uniform.log(0.5, 2.0 * static_cast<double>(glm::length(hull[7]) / glm::length(hull[3])));
    const double x = uniform(-0.4, 1.4), y = uniform(-0.4, 1.4);
    const glm::dvec3 origin(hull[0]), right(hull[1] - hull[0]), above(hull[2] - hull[0]);
    const double size = uniform.log(1e-6, 1e6);
    const glm::dvec3 half = size * glm::dvec3(uniform(0.02, 1), uniform(0.02, 1), uniform(0.02, 1));
    const glm::dvec3 centre =
        eye + depth * (origin + x * right + y * above) + 1.2 * size * uniform.point(1.0);
    return {glm::vec3(centre - half), glm::vec3(centre + half)};
}

struct Tally {
    std::size_t boxes = 0, touching = 0, by_planes = 0, by_corners = 0;
};

/// The share of `positives` that do not touch.
double false_share(std::size_t touching, std::size_t positives) {
    return 1.0 - static_cast<double>(touching) / static_cast<double>(std::max<std::size_t>(positives, 1));
}

TEST(RandomBoxes, no_box_that_touches_the_frustum_in_long_double_is_ever_rejected) {
    constexpr double kOffsets[] = {0.0, 1e3, 1e5, 1e7};
    constexpr int kBoxesPerView = 200;
    const std::size_t views = boxes_to_test() / kBoxesPerView;
    Uniform uniform(11);
    Tally tallies[12];
    std::vector<Aabb> boxes(kBoxesPerView);
    std::vector<std::uint64_t> words(visibility_words(kBoxesPerView));
    for (std::size_t v = 0; v < views; ++v) {
        const PerspectiveCamera camera = random_camera(uniform, kOffsets[v % 4]);
        const View view = camera.view();
        if (!validate(view)) continue;
        const CornerFrustum frustum = make_corner_frustum(view);
        const FrustumHull<Exact> hull = camera.hull();
        for (Aabb& box : boxes) box = random_box(uniform, hull, camera.eye);
        cull_boxes(frustum, boxes, words);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            PlaneMask mask = frustum.mask, corner_mask = frustum.mask;
            const bool planes =
                classify(static_cast<const Frustum&>(frustum), boxes[i], mask) != Containment::Outside;
            const bool corners = classify(frustum, boxes[i], corner_mask) != Containment::Outside;
            const bool touches = !are_separated(hull, hull_box(boxes[i], camera.eye));
            ASSERT_EQ(words[i / 64] >> (i % 64) & 1u, planes ? 1u : 0u);
            ASSERT_TRUE(planes || !touches) << "planes rejected a box that may be visible, view " << v;
            ASSERT_TRUE(corners || !touches) << "corners rejected a box that may be visible, view " << v;
            const double size = glm::length(glm::dvec3(boxes[i].extent())) / 2.0;
            const int decade = std::clamp(static_cast<int>(std::floor(std::log10(size))) + 6, 0, 11);
            Tally& tally = tallies[decade];
            ++tally.boxes, tally.touching += touches, tally.by_planes += planes, tally.by_corners += corners;
        }
    }
    std::size_t touching = 0, separated = 0;
    for (int decade = 0; decade < 12; ++decade) {
        const Tally& t = tallies[decade];
        std::printf(
            "half size from %s1e%+d m: %zu boxes, %zu touch; %.2f %% of the planes' positives are wrong, "
            "with corners %.2f %%\n",
            decade == 0 ? "0 or " : "", decade - 6, t.boxes, t.touching,
            100.0 * false_share(t.touching, t.by_planes), 100.0 * false_share(t.touching, t.by_corners));
        touching += t.touching;
        separated += t.boxes - t.touching;
    }
    // The test must not pass by proving nothing.
    EXPECT_GT(touching, views * kBoxesPerView / 20);
    EXPECT_GT(separated, views * kBoxesPerView / 20);
}

class FalsePositives : public testing::TestWithParam<bool> {};

TEST_P(FalsePositives, are_at_most_four_percent_of_what_the_corner_test_keeps) {
    // A common camera, held upright or not, and boxes of one size spread evenly: what a hierarchy meets.
    const bool rolled = GetParam();
    PerspectiveCamera camera;
    camera.fov_y = 60.0 * kDegree, camera.aspect = 16.0 / 9.0, camera.near = 0.1, camera.far = 200.0;
    camera.clip_depth = ClipDepth::ReversedZeroToOne;
    for (const double half : {2.0, 8.0, 32.0, 64.0, 128.0}) {
        Uniform uniform(static_cast<std::uint32_t>(half));
        Tally tally;
        for (int v = 0; v < 40; ++v) {
            const double yaw = uniform(0.0, 6.283185307179586);
            camera.forward = {std::cos(yaw), uniform(-0.4, 0.2), std::sin(yaw)};
            if (rolled) camera.forward = uniform.point(1.0), camera.up = uniform.point(1.0);
            const CornerFrustum frustum = make_corner_frustum(camera.view());
            const FrustumHull<Exact> hull = camera.hull();
            for (int b = 0; b < 2000; ++b) {
                const glm::vec3 centre(uniform.point(300.0));
                const Aabb box{centre - glm::vec3(static_cast<float>(half)),
                               centre + glm::vec3(static_cast<float>(half))};
                PlaneMask mask = frustum.mask, corner_mask = frustum.mask;
                tally.by_planes +=
                    classify(static_cast<const Frustum&>(frustum), box, mask) != Containment::Outside;
                tally.by_corners += classify(frustum, box, corner_mask) != Containment::Outside;
                tally.touching += !are_separated(hull, hull_box(box, camera.eye));
            }
        }
        const double planes = false_share(tally.touching, tally.by_planes);
        const double corners = false_share(tally.touching, tally.by_corners);
        std::printf("half size %g m: %.2f %% of the planes' positives are wrong, with corners %.2f %%\n",
                    half, 100.0 * planes, 100.0 * corners);
        EXPECT_GE(corners, 0.0);
        EXPECT_LE(corners, 0.04) << half;
        EXPECT_LE(corners, half >= 32.0 ? 0.5 * planes : planes) << half;
    }
}

INSTANTIATE_TEST_SUITE_P(UprightAndRolled, FalsePositives, testing::Bool());

}  // namespace
}  // namespace rhview
