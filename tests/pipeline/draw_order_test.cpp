// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/draw_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>

#include "balls.h"
#include "rhview/rhoctree/draw_list.h"
#include "uniform.h"

namespace rhview {
namespace {

constexpr DrawCosts kCosts{0.25, 20.0, 0.0};

struct Lists {
    Lists() : balls(131, 4, 60, 200) {
        OctreeOptions options;
        options.max_leaf_triangles = 40;
        options.replica_budget = 1.0;
        options.costs = kCosts;
        octree = build_octree(balls.batches(), options).value();
    }
    std::vector<DrawRange> at(const glm::vec3& eye) {
        View view;
        view.camera_from_world = look_along(glm::dvec3(eye), {0.3, 0.1, -1.0}, {0, 1, 0});
        view.clip_from_camera = perspective(1.5, 1.5, 0.1, 500.0, view.clip_depth);
        solver.solve(octree, make_frustum(view), make_viewpoint(view), kCosts, list);
        return list.ranges;
    }

    Balls balls;
    RhOctree octree;
    DrawListSolver solver;
    DrawList list;
};

/// By looking at every piece and replica.
double distance(const RhOctree& octree, const DrawRange& range, const glm::vec3& eye) {
    double nearest = 1e30;
    const auto look = [&](std::uint32_t first, std::uint32_t count, const Aabb& box) {
        if (first >= range.first_index + range.index_count || first + count <= range.first_index) return;
        nearest =
            std::min(nearest, static_cast<double>(glm::distance(glm::clamp(eye, box.min, box.max), eye)));
    };
    for (const OctreePiece& piece : octree.pieces()) look(piece.first_index, piece.index_count, piece.bounds);
    for (const OctreeReplica& replica : octree.replicas())
        look(replica.first_index, replica.index_count, octree.node(replica.node).bounds);
    return nearest;
}

auto by_place(std::vector<DrawRange> ranges) {
    std::ranges::sort(ranges, {},
                      [](const DrawRange& r) { return std::tuple(r.first_index, r.index_count); });
    return ranges;
}

TEST(DrawOrder, draws_the_near_before_what_is_twice_as_far_and_loses_nothing) {
    Lists lists;
    DrawOrder order(lists.octree);
    Uniform uniform(132);
    std::size_t pairs = 0;
    for (int i = 0; i < 40; ++i) {
        const glm::vec3 eye(uniform.point(40.0));
        const std::vector<DrawRange> before = lists.at(eye);
        std::vector<DrawRange> after = before;
        order.sort(eye, false, after);
        ASSERT_EQ(by_place(after), by_place(before));
        double farthest = 0.0;
        for (const DrawRange& range : after) {
            const double here = distance(lists.octree, range, eye);
            EXPECT_GT(here, 0.49 * farthest);
            pairs += here < farthest;
            farthest = std::max(farthest, here);
        }
    }
    EXPECT_GT(pairs, 100u);
}

TEST(DrawOrder, within_a_slab_a_batch_is_drawn_once_in_its_own_order) {
    Lists lists;
    DrawOrder order(lists.octree);
    const glm::vec3 eye(3, 2, 60);
    std::vector<DrawRange> ranges = lists.at(eye);
    order.sort(eye, false, ranges);
    std::size_t runs = 1;
    for (std::size_t i = 1; i < ranges.size(); ++i) runs += ranges[i].batch != ranges[i - 1].batch;
    EXPECT_LE(runs, 12u * lists.octree.batch_count());
    EXPECT_LT(runs, ranges.size() / 2);
}

TEST(DrawOrder, keeps_batches_together_where_a_batch_is_one_call) {
    Lists lists;
    DrawOrder order(lists.octree);
    const glm::vec3 eye(3, 2, 30);
    std::vector<DrawRange> ranges = lists.at(eye);
    const std::vector<DrawRange> before = ranges;
    order.sort(eye, true, ranges);
    EXPECT_TRUE(std::ranges::is_sorted(ranges, {}, &DrawRange::batch));
    EXPECT_EQ(by_place(ranges), by_place(before));
    EXPECT_NE(ranges, before);
}

TEST(DrawOrder, of_nothing_is_nothing) {
    Lists lists;
    DrawOrder order(lists.octree);
    std::vector<DrawRange> none;
    order.sort({}, false, none);
    EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace rhview
