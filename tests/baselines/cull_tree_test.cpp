// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/baselines/cull_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rhview/baselines/nested_grid.h"
#include "tile_world.h"

namespace rhview {
namespace {

bool contains(const Aabb& outer, const Aabb& inner) {
    return glm::min(outer.min, inner.min) == outer.min && glm::max(outer.max, inner.max) == outer.max;
}

/// Three corners, of a batch.
using Triangle = std::array<std::uint32_t, 4>;

std::vector<Triangle> triangles_of(std::span<const TriangleBatch> batches) {
    std::vector<Triangle> result;
    for (std::uint32_t b = 0; b < batches.size(); ++b)
        for (std::size_t i = 0; i < batches[b].indices.size(); i += 3)
            result.push_back(
                {b, batches[b].indices[i], batches[b].indices[i + 1], batches[b].indices[i + 2]});
    std::ranges::sort(result);
    return result;
}

/// The leaves hold every triangle once, in boxes that hold it; nodes hold their children.
void expect_whole(const OrderedTree& tree, std::span<const TriangleBatch> batches) {
    std::vector<Triangle> found;
    const std::span<const CullNode> nodes = tree.tree.nodes();
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
        EXPECT_TRUE(contains(nodes[nodes[n].parent].bounds, nodes[n].bounds));
        EXPECT_LE(nodes[n].end, nodes[nodes[n].parent].end);
        EXPECT_TRUE(tree.tree.is_leaf(n) || tree.tree.ranges(n).empty());
        for (const DrawRange& range : tree.tree.ranges(n))
            for (std::uint32_t i = range.first_index; i < range.first_index + range.index_count; i += 3) {
                const std::uint32_t* corners = &tree.indices[i];
                const TriangleBatch& batch = batches[index_of(range.batch)];
                for (int c = 0; c < 3; ++c) {
                    const glm::vec3& corner = batch.positions[corners[c]];
                    EXPECT_TRUE(contains(nodes[n].bounds, {corner, corner}));
                }
                found.push_back(
                    {static_cast<std::uint32_t>(range.batch), corners[0], corners[1], corners[2]});
            }
    }
    std::ranges::sort(found);
    EXPECT_EQ(found, triangles_of(batches));
}

std::uint32_t triangles_in(const CullTree& tree, std::uint32_t leaf) {
    std::uint32_t indices = 0;
    for (const DrawRange& range : tree.ranges(leaf)) indices += range.index_count;
    return indices / 3;
}

TEST(CullTree, holds_every_triangle_once_whatever_it_is_made_of) {
    TileWorld world(3);
    world.scatter(1, 700, 20, 200);
    const std::vector<TriangleBatch> batches = world.batches();
    const RhOctree octree = build_octree(batches, {30}).value();
    const std::span<const std::uint32_t> base = octree.indices().first(octree.base_index_count());
    expect_whole({CullTree::of_octree(octree), {base.begin(), base.end()}}, batches);
    for (const std::uint32_t leaf : {1u, 30u, 100000u})
        expect_whole(make_object_tree(world.objects(), batches, leaf), batches);
    for (const std::uint32_t levels : {1u, 2u, 3u})
        expect_whole(make_nested_grid(batches, {levels, 5, 3, 10}), batches);
    expect_whole(make_nested_grid({}, {}), {});
    expect_whole(make_object_tree({}, {}, 10), {});
}

TEST(CullTree, objects_are_joined_to_leaves_of_one_range_per_batch_and_never_divided) {
    TileWorld world(2);
    world.scatter(2, 400, 0, 200);
    const OrderedTree fine = make_object_tree(world.objects(), world.batches(), 1);
    EXPECT_EQ(fine.tree.leaf_count(), 400u);
    const OrderedTree coarse = make_object_tree(world.objects(), world.batches(), 20);
    EXPECT_LT(coarse.tree.leaf_count(), 80u);
    for (std::uint32_t n = 0; n < coarse.tree.nodes().size(); ++n) {
        EXPECT_LE(triangles_in(coarse.tree, n), 20u);
        EXPECT_LE(coarse.tree.ranges(n).size(), 2u);
    }
}

TEST(CullTree, a_cell_is_divided_as_often_as_there_are_levels) {
    TileWorld world(1);
    world.scatter(3, 2000, 0, 200);
    const auto largest = [&](std::uint32_t levels) {
        const OrderedTree grid = make_nested_grid(world.batches(), {levels, 2, 2, 20});
        std::uint32_t most = 0;
        for (std::uint32_t n = 0; n < grid.tree.nodes().size(); ++n)
            most = std::max(most, triangles_in(grid.tree, n));
        return most;
    };
    EXPECT_GT(largest(1), 2 * largest(2));
    EXPECT_GT(largest(2), 2 * largest(3));
}

TEST(CullTree, tight_boxes_hold_the_leaves_and_are_no_larger_than_allowed) {
    TileWorld world(2);
    world.scatter(4, 900, 0, 200);
    OrderedTree made = make_object_tree(world.objects(), world.batches(), 4);
    CullTree& tree = made.tree;
    tree.find_tight_bounds({3, 1.4, 16});
    const auto area = [](const Aabb& box) {
        const glm::vec3 e = box.extent();
        return e.x * e.y + e.y * e.z + e.z * e.x;
    };
    std::size_t tighter = 0;
    for (std::uint32_t n = 0; n < tree.nodes().size(); ++n) {
        const std::span<const std::uint32_t> tight = tree.tight(n);
        ASSERT_FALSE(tight.empty());
        ASSERT_LE(tight.size(), 8u);
        double sum = 0.0;
        for (const std::uint32_t part : tight) sum += area(tree.nodes()[part].bounds);
        EXPECT_LE(sum, 1.4 * area(tree.nodes()[n].bounds) * (1 + 1e-6));
        for (std::uint32_t leaf = n; leaf < tree.nodes()[n].end; ++leaf) {
            const bool held = std::ranges::any_of(
                tight, [&](std::uint32_t part) { return part <= leaf && leaf < tree.nodes()[part].end; });
            EXPECT_TRUE(held || !tree.is_leaf(leaf));
        }
        tighter += tight.size() > 1 ? 1 : 0;
    }
    EXPECT_GT(tighter, 20u);
}

TEST(CullTree, moving_objects_have_nodes_of_their_own_that_follow_them) {
    TileWorld world(1);
    world.scatter(5, 50, 0, 100);
    OrderedTree made = make_object_tree(world.objects(), world.batches(), 10);
    CullTree& tree = made.tree;
    tree.find_tight_bounds({});
    const std::size_t still = tree.nodes().size();
    Uniform uniform(6);
    for (const std::size_t count : {40u, 40u, 7u, 0u, 1u}) {
        std::vector<Aabb> boxes;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 at(uniform.point(300));
            boxes.push_back({at, at + 1.0f});
        }
        tree.set_objects(boxes);
        EXPECT_EQ(tree.nodes().size(), still + (count == 0 ? 0 : 2 * count - 1));
        std::vector<std::uint32_t> found;
        for (std::uint32_t n = 0; n < tree.nodes().size(); ++n) {
            EXPECT_TRUE(contains(tree.nodes()[tree.nodes()[n].parent].bounds, tree.nodes()[n].bounds));
            EXPECT_FALSE(tree.tight(n).empty());
            for (const ObjectId object : tree.objects(n)) {
                found.push_back(static_cast<std::uint32_t>(object));
                EXPECT_TRUE(contains(tree.nodes()[n].bounds, boxes[index_of(object)]));
            }
        }
        std::ranges::sort(found);
        ASSERT_EQ(found.size(), count);
        for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(found[i], i);
    }
}

TEST(CullTree, an_object_that_is_not_alive_is_in_no_leaf) {
    TileWorld world(1);
    world.scatter(5, 50, 0, 100);
    CullTree tree = make_object_tree(world.objects(), world.batches(), 10).tree;
    std::vector<Aabb> boxes;
    for (int i = 0; i < 70; ++i)
        boxes.push_back({glm::vec3(static_cast<float>(i)), glm::vec3(static_cast<float>(i) + 1.0f)});
    const std::vector<std::uint64_t> alive{~std::uint64_t{0} & ~(std::uint64_t{1} << 5), 0b100};
    tree.set_objects(boxes, alive);
    std::vector<std::uint32_t> found;
    for (std::uint32_t n = 0; n < tree.nodes().size(); ++n)
        for (const ObjectId object : tree.objects(n)) found.push_back(static_cast<std::uint32_t>(object));
    EXPECT_EQ(found.size(), 64u);  // all of the first 64 but one, and one of six
    EXPECT_EQ(std::ranges::count(found, 5u), 0);
    EXPECT_EQ(std::ranges::count(found, 66u), 1);
}

}  // namespace
}  // namespace rhview
