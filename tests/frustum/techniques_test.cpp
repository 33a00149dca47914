// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Whatever is switched on, what may be visible is shown; and what shows too much is known by name.

#include "rhview/frustum/techniques.h"

#include <gtest/gtest.h>

#include <cmath>

#include "random_boxes.h"
#include "rhview/frustum/bounding_volumes.h"
#include "rhview/frustum/corner_test.h"

namespace rhview {
namespace {

struct Case {
    const char* name;
    CullingTechniques techniques;
    bool exact = true;  ///< shows what the flat batch shows, no more and no less
};

std::vector<Case> cases() {
    using enum BoxTest;
    using enum Traversal;
    using enum Threads;
    return {
        {"eight_corners_flat", {EightCorners, Flat}},
        {"p_and_n_vertex_flat", {PAndNVertex, Flat}},
        {"radar_flat", {Radar, Flat}, false},
        {"vector_within_flat", {VectorWithin, Flat}},
        {"vector_across_flat", {VectorAcross, Flat}},
        {"eight_corners", {EightCorners, Stackless}},
        {"p_and_n_vertex_stack", {PAndNVertex, Stack}},
        {"p_and_n_vertex", {PAndNVertex, Stackless}},
        {"radar", {Radar, Stackless}, false},
        {"vector_within", {VectorWithin, Stackless}},
        {"vector_across", {VectorAcross, Stackless}},
        {"plane_coherency", {.plane_coherency = true}},
        {"octant_test", {.octant_test = true}, false},
        {"octant_test_flat", {.traversal = Flat, .octant_test = true}, false},
        {"masking", {.masking = true}},
        {"masking_stack", {.traversal = Stack, .masking = true}},
        {"masking_octant", {.octant_test = true, .masking = true}, false},
        {"coherency_octant", {.plane_coherency = true, .octant_test = true}, false},
        {"translation_coherency", {.translation_coherency = true}, false},
        {"frustum_box_first", {.frustum_box_first = true}, false},
        {"everything",
         {.plane_coherency = true, .octant_test = true, .masking = true, .frustum_box_first = true},
         false},
        {"static_split", {PAndNVertex, Stackless, StaticSplit}},
        {"work_stealing", {.threads = WorkStealing, .plane_coherency = true, .masking = true}},
        {"work_stealing_across", {.test = VectorAcross, .threads = WorkStealing, .masking = true}},
    };
}

class EveryTechnique : public testing::TestWithParam<Case> {};

/// A walk: turns, moves and both; symmetric and not.
View view_of_frame(int frame, double offset) {
    View view;
    view.clip_depth = static_cast<ClipDepth>(frame / 30 % 3);
    const double turn = frame % 30 < 15 ? 0.05 * (frame % 30) : 0.75;
    const double way = frame % 30 < 15 ? 0.0 : 3.0 * (frame % 30 - 15);
    view.camera_from_world = look_along(glm::dvec3(offset) + glm::dvec3(way, 0.3 * way, 5.0),
                                        {std::cos(turn), 0.1, std::sin(turn)}, {0, 1, 0});
    view.clip_from_camera = perspective(1.0, 1.5, 0.1, 60.0, view.clip_depth);
    if (frame >= 90 && frame < 100) view.clip_from_camera[2][0] = 0.3;  // off-axis
    if (frame >= 100) view.clip_from_camera = orthographic(40, 30, 0.1, 60.0, view.clip_depth);
    return view;
}

/// By a test that proves more than the flat batch: with the corners, or with the narrower slack that each
/// plane allows and box tests round up.
bool is_proved_outside(const CornerFrustum& frustum, const Aabb& box) {
    PlaneMask mask = frustum.mask;
    if (classify(frustum, box, mask) == Containment::Outside) return true;
    const glm::vec3 half = 0.5f * box.extent();
    const OrientedBox same{box.centre(),
                           {glm::vec3(half.x, 0, 0), glm::vec3(0, half.y, 0), glm::vec3(0, 0, half.z)}};
    mask = frustum.mask;
    return classify(frustum, same, mask) == Containment::Outside;
}

TEST_P(EveryTechnique, shows_all_that_the_flat_batch_shows_and_no_more_but_what_it_is_known_for) {
    std::size_t shown = 0, needed = 0, total = 0;
    for (const double offset : {0.0, 1e5}) {
        Uniform uniform(1);
        const std::vector<Aabb> boxes = random_boxes(uniform, 4000, glm::dvec3(offset), 80.0, 0.05, 8.0);
        const BoxHierarchy tree(boxes, {HierarchySplit::SurfaceArea, 2, 8});
        TechniqueCuller culler(tree, GetParam().techniques);
        std::vector<OrderRange> ranges, again;
        std::vector<std::uint64_t> words(visibility_words(boxes.size()));
        for (int frame = 0; frame < 120; ++frame) {
            const View view = view_of_frame(frame, offset);
            culler.cull(view, glm::dvec3(0.0), ranges);
            cull_boxes(make_frustum(view), tree.boxes(), words);
            const CornerFrustum corners = make_corner_frustum(view);
            std::vector<bool> visible(boxes.size());
            for (const OrderRange& range : ranges)
                for (std::uint32_t i = 0; i < range.count; ++i) visible[range.first + i] = true;
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                const bool flat = words[i / 64] >> (i % 64) & 1u;
                if (GetParam().exact)
                    ASSERT_EQ(visible[i], flat) << "frame " << frame << " place " << i;
                else
                    ASSERT_TRUE(visible[i] || !flat || is_proved_outside(corners, tree.boxes()[i]))
                        << "frame " << frame << " place " << i;
                shown += visible[i];
                needed += flat;
                ++total;
            }
        }
    }
    EXPECT_GT(needed, total / 50);
    EXPECT_LT(shown, needed + needed / 5);  // it must reject something
}

INSTANTIATE_TEST_SUITE_P(Techniques, EveryTechnique, testing::ValuesIn(cases()),
                         [](const auto& c) { return std::string(c.param.name); });

TEST(Techniques, planes_that_the_octant_test_skips_are_still_tested_below) {
    // Small boxes all over, under nodes that are small beside the frustum: were the skipped planes masked,
    // boxes beyond them would be taken as inside.
    Uniform uniform(3);
    const std::vector<Aabb> boxes = random_boxes(uniform, 20000, glm::dvec3(0.0), 120.0, 0.05, 0.5);
    const BoxHierarchy tree(boxes, {HierarchySplit::SurfaceArea, 2, 4});
    TechniqueCuller plain(tree, {.masking = true}), octant(tree, {.octant_test = true, .masking = true});
    std::vector<OrderRange> expected, ranges;
    const auto count = [](const std::vector<OrderRange>& r) {
        std::size_t sum = 0;
        for (const OrderRange& range : r) sum += range.count;
        return sum;
    };
    for (int frame = 0; frame < 90; ++frame) {
        plain.cull(view_of_frame(frame, 0.0), glm::dvec3(0.0), expected);
        octant.cull(view_of_frame(frame, 0.0), glm::dvec3(0.0), ranges);
        // A leaf's box that crosses one plane of its octant is not tested against the others.
        EXPECT_GE(count(ranges), count(expected));
        EXPECT_LE(count(ranges), count(expected) + count(expected) / 100 + 5);
    }
}

}  // namespace
}  // namespace rhview
