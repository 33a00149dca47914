// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/rhoctree/draw_list.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "random_geometry.h"

namespace rhview {
namespace {

View random_view(std::mt19937& random) {
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
    };
    const glm::dvec3 eye(uniform(-120, 120), uniform(-20, 20), uniform(-120, 120));
    const glm::dvec3 forward(uniform(-1, 1), uniform(-0.3, 0.3), uniform(-1, 1));
    return {look_along(eye, forward, {0, 1, 0}),
            perspective(uniform(0.1, 2.0), 1.6, 0.1, uniform(20, 400), ClipDepth::NegativeOneToOne),
            ClipDepth::NegativeOneToOne};
}

bool may_be_visible(const RhOctree& octree, const Frustum& frustum, std::uint32_t node) {
    PlaneMask mask = frustum.mask;
    return classify(frustum, octree.nodes()[node].bounds, mask) != Containment::Outside;
}

bool is_leaf(const RhOctree& octree, std::uint32_t node) {
    return octree.is_leaf(NodeId{node});
}

/// Leaves below the drawn nodes, each counted.
std::multiset<std::uint32_t> covered_leaves(const RhOctree& octree, const NodeList& list) {
    std::multiset<std::uint32_t> leaves;
    for (const NodeId id : list.nodes)
        for (auto i = static_cast<std::uint32_t>(id); i < octree.node(id).end; ++i)
            if (is_leaf(octree, i)) leaves.insert(i);
    return leaves;
}

/// Leaves not outside, themselves and all their ancestors: what a traversal can reach.
std::multiset<std::uint32_t> visible_leaves(const RhOctree& octree, const Frustum& frustum) {
    std::multiset<std::uint32_t> leaves;
    for (std::uint32_t i = 0; i < octree.nodes().size();) {
        if (!may_be_visible(octree, frustum, i)) {
            i = octree.nodes()[i].end;
            continue;
        }
        if (is_leaf(octree, i)) leaves.insert(i);
        ++i;
    }
    return leaves;
}

class DrawList : public testing::TestWithParam<std::uint32_t> {};

TEST_P(DrawList, covers_every_leaf_that_may_be_visible_exactly_once) {
    const RandomGeometry geometry(11, 3, 3000);
    const RhOctree octree = build_octree(geometry.batches(), {GetParam()}).value();
    std::mt19937 random(12);
    NodeList seed, leaves;
    for (int i = 0; i < 200; ++i) {
        const Frustum frustum = make_frustum(random_view(random));
        seed_draw_list(octree, frustum, seed);
        leaf_draw_list(octree, frustum, leaves);
        // Every leaf the plain test can't reject is drawn, whatever the masks skipped, and drawn once.
        const auto expected = visible_leaves(octree, frustum);
        EXPECT_EQ(covered_leaves(octree, seed), expected);
        EXPECT_EQ(covered_leaves(octree, leaves), expected);
        EXPECT_LE(seed.nodes.size(), leaves.nodes.size());
    }
}

TEST_P(DrawList, seed_rule_draws_the_topmost_nodes_inside_and_the_leaves_that_cross) {
    const RandomGeometry geometry(13, 1, 3000);
    const RhOctree octree = build_octree(geometry.batches(), {GetParam()}).value();
    std::mt19937 random(14);
    NodeList seed;
    std::size_t inner = 0;
    for (int i = 0; i < 100; ++i) {
        const Frustum frustum = make_frustum(random_view(random));
        seed_draw_list(octree, frustum, seed);
        std::vector<NodeId> expected;
        for (std::uint32_t n = 0; n < octree.nodes().size();) {
            PlaneMask mask = frustum.mask;
            const Containment containment = classify(frustum, octree.nodes()[n].bounds, mask);
            const bool drawn = containment == Containment::Inside ||
                               (containment == Containment::Intersecting && is_leaf(octree, n));
            if (drawn) expected.push_back(NodeId{n});
            inner += drawn && !is_leaf(octree, n);
            n = drawn || containment == Containment::Outside ? octree.nodes()[n].end : n + 1;
        }
        EXPECT_EQ(seed.nodes, expected);
    }
    EXPECT_TRUE(inner > 100 || GetParam() > 20) << inner;
}

INSTANTIATE_TEST_SUITE_P(LeafSizes, DrawList, testing::Values(1u, 20u, 500u, 100000u));

TEST(DrawListTraversal, everything_in_view_is_one_node_and_nothing_in_view_is_none) {
    const RandomGeometry geometry(15, 1, 500);
    const RhOctree octree = build_octree(geometry.batches(), {10}).value();
    View view{look_along({0, 0, 1000}, {0, 0, -1}, {0, 1, 0}),
              perspective(1.0, 1.0, 1.0, 5000.0, ClipDepth::ZeroToOne), ClipDepth::ZeroToOne};
    NodeList list;
    seed_draw_list(octree, make_frustum(view), list);
    EXPECT_EQ(list.nodes, std::vector<NodeId>{NodeId{0}});
    EXPECT_EQ(list.nodes_visited, 1u);
    leaf_draw_list(octree, make_frustum(view), list);
    EXPECT_EQ(list.nodes.size(), octree.leaf_count());
    view.camera_from_world = look_along({0, 0, 1000}, {0, 0, 1}, {0, 1, 0});
    seed_draw_list(octree, make_frustum(view), list);
    EXPECT_TRUE(list.nodes.empty());
    leaf_draw_list(octree, make_frustum(view), list);
    EXPECT_TRUE(list.nodes.empty());
    seed_draw_list(RhOctree(), make_frustum(view), list);
    EXPECT_TRUE(list.nodes.empty());
    EXPECT_EQ(list.nodes_visited, 0u);
}

}  // namespace
}  // namespace rhview
