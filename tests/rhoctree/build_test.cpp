// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "random_geometry.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

std::vector<Triangle> triangles_of(std::span<const std::uint32_t> indices) {
    std::vector<Triangle> result;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        result.push_back({indices[i], indices[i + 1], indices[i + 2]});
    return result;
}

bool contains(const Aabb& box, const glm::vec3& p) {
    return p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z && p.x <= box.max.x && p.y <= box.max.y &&
           p.z <= box.max.z;
}

TEST(OctreeBuild, base_order_is_a_permutation_of_each_batch_with_triangles_unrotated) {
    const RandomGeometry geometry(1, 3, 2000);
    const Result<RhOctree> octree = build_octree(geometry.batches(), {50});
    ASSERT_TRUE(octree.ok());
    std::size_t first = 0;
    for (const auto& source : geometry.indices) {
        std::vector<Triangle> expected = triangles_of(source);
        std::vector<Triangle> actual = triangles_of(octree->indices().subspan(first, source.size()));
        std::ranges::sort(expected);
        std::ranges::sort(actual);
        EXPECT_EQ(actual, expected);
        first += source.size();
    }
    EXPECT_EQ(first, octree->indices().size());
}

TEST(OctreeBuild, every_node_is_one_range_per_batch_made_of_its_childrens_ranges_in_order) {
    const RandomGeometry geometry(2, 4, 1500);
    const Result<RhOctree> octree = build_octree(geometry.batches(), {64});
    ASSERT_TRUE(octree.ok());
    ASSERT_GT(octree->nodes().size(), 50u);
    std::size_t leaves = 0;
    for (std::uint32_t i = 0; i < octree->nodes().size(); ++i) {
        const OctreeNode& node = octree->nodes()[i];
        std::uint32_t triangles = 0;
        for (const DrawRange& range : octree->ranges(NodeId{i})) triangles += range.index_count / 3;
        EXPECT_EQ(triangles, node.triangle_count);
        if (octree->is_leaf(NodeId{i})) {
            ++leaves;
            EXPECT_LE(node.triangle_count, 64u);
            continue;
        }
        EXPECT_GT(node.triangle_count, 64u);
        std::map<BatchId, DrawRange> joined;
        int children = 0;
        for (std::uint32_t child = i + 1; child < node.end; child = octree->nodes()[child].end, ++children) {
            for (const DrawRange& range : octree->ranges(NodeId{child})) {
                const auto [place, is_new] = joined.emplace(range.batch, range);
                if (is_new) continue;
                EXPECT_EQ(place->second.first_index + place->second.index_count, range.first_index);
                place->second.index_count += range.index_count;
            }
        }
        EXPECT_GE(children, 2);
        EXPECT_LE(children, 8);
        std::vector<DrawRange> expected;
        for (const auto& [batch, range] : joined) expected.push_back(range);
        EXPECT_TRUE(std::ranges::equal(expected, octree->ranges(NodeId{i})));
    }
    EXPECT_EQ(leaves, octree->leaf_count());
}

TEST(OctreeBuild, node_boxes_are_the_tight_boxes_of_their_triangles) {
    const RandomGeometry geometry(3, 2, 1000);
    const Result<RhOctree> octree = build_octree(geometry.batches(), {32});
    ASSERT_TRUE(octree.ok());
    for (std::uint32_t i = 0; i < octree->nodes().size(); ++i) {
        Aabb expected;
        for (const DrawRange& range : octree->ranges(NodeId{i}))
            for (const std::uint32_t index : octree->indices().subspan(range.first_index, range.index_count))
                expected.grow(geometry.positions[index]);
        EXPECT_EQ(octree->nodes()[i].bounds, expected);
    }
}

TEST(OctreeBuild, sibling_centroids_lie_in_different_cells_of_one_grid) {
    const RandomGeometry geometry(4, 1, 3000);
    const Result<RhOctree> octree = build_octree(geometry.batches(), {100});
    ASSERT_TRUE(octree.ok());
    const auto centroid_box = [&](std::uint32_t node) {
        Aabb box;
        for (const DrawRange& range : octree->ranges(NodeId{node})) {
            for (const Triangle& t :
                 triangles_of(octree->indices().subspan(range.first_index, range.index_count)))
                box.grow((geometry.positions[t[0]] + geometry.positions[t[1]] + geometry.positions[t[2]]) /
                         3.0f);
        }
        return box;
    };
    for (std::uint32_t i = 0; i < octree->nodes().size(); ++i) {
        std::vector<Aabb> boxes;
        for (std::uint32_t child = i + 1; child < octree->nodes()[i].end; child = octree->nodes()[child].end)
            boxes.push_back(centroid_box(child));
        for (std::size_t a = 0; a < boxes.size(); ++a) {
            for (std::size_t b = a + 1; b < boxes.size(); ++b) {
                bool separated = false;
                for (int axis = 0; axis < 3; ++axis)
                    separated |=
                        boxes[a].max[axis] < boxes[b].min[axis] || boxes[b].max[axis] < boxes[a].min[axis];
                EXPECT_TRUE(separated);
            }
        }
    }
}

TEST(OctreeBuild, equal_inputs_give_equal_octrees) {
    const RandomGeometry geometry(5, 2, 3000);
    const Result<RhOctree> a = build_octree(geometry.batches(), {100});
    const Result<RhOctree> b = build_octree(geometry.batches(), {100});
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_TRUE(std::ranges::equal(a->indices(), b->indices()));
    ASSERT_EQ(a->nodes().size(), b->nodes().size());
    for (std::size_t i = 0; i < a->nodes().size(); ++i) EXPECT_EQ(a->nodes()[i].bounds, b->nodes()[i].bounds);
}

TEST(OctreeBuild, coincident_triangles_end_in_one_leaf_however_many) {
    std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    std::vector<std::uint32_t> indices;
    for (int i = 0; i < 100; ++i) indices.insert(indices.end(), {0, 1, 2});
    const TriangleBatch batch{MaterialId{0}, positions, indices};
    const Result<RhOctree> octree = build_octree(std::span(&batch, 1), {1});
    ASSERT_TRUE(octree.ok());
    ASSERT_EQ(octree->nodes().size(), 1u);
    EXPECT_EQ(octree->nodes()[0].triangle_count, 100u);
}

TEST(OctreeBuild, huge_tiny_and_degenerate_triangles_are_all_kept) {
    constexpr float kMax = std::numeric_limits<float>::max();
    const std::vector<glm::vec3> positions{{-kMax, -kMax, -kMax}, {kMax, kMax, kMax}, {kMax, -kMax, 0},
                                           {1e-30f, 0, 0},        {0, 1e-30f, 0},     {1e7f, 1e7f, 1e7f}};
    const std::vector<std::uint32_t> indices{0, 1, 2, 3, 4, 3, 5, 5, 5, 0, 0, 0, 3, 4, 5};
    const TriangleBatch batch{MaterialId{0}, positions, indices};
    const Result<RhOctree> octree = build_octree(std::span(&batch, 1), {1});
    ASSERT_TRUE(octree.ok());
    EXPECT_EQ(octree->indices().size(), indices.size());
    EXPECT_TRUE(contains(octree->nodes()[0].bounds, positions[0]));
    EXPECT_TRUE(contains(octree->nodes()[0].bounds, positions[1]));
}

TEST(OctreeBuild, no_triangles_give_no_node) {
    EXPECT_TRUE(build_octree({}).value().nodes().empty());
    const TriangleBatch empty;
    EXPECT_TRUE(build_octree(std::span(&empty, 1)).value().nodes().empty());
}

TEST(OctreeBuild, bad_batches_are_refused_by_name) {
    const std::vector<glm::vec3> positions{
        {0, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<float>::infinity(), 0}};
    const std::vector<std::uint32_t> out_of_range{0, 1, 0, 0, 1, 3};
    const std::vector<std::uint32_t> not_finite{0, 1, 2};
    const std::vector<std::uint32_t> cut_short{0, 1};
    const auto message = [&](const std::vector<std::uint32_t>& indices) {
        const TriangleBatch batch{MaterialId{0}, positions, indices};
        const Result<RhOctree> octree = build_octree(std::span(&batch, 1));
        return octree.ok() ? std::string() : octree.error().message;
    };
    EXPECT_EQ(message(out_of_range), "batch 0, triangle 1: index 3 is out of range (3 vertices)");
    EXPECT_EQ(message(not_finite), "batch 0, triangle 0: a corner is not finite; drop the triangle first");
    EXPECT_EQ(message(cut_short), "batch 0 has 2 indices, which is no multiple of three");
}

}  // namespace
}  // namespace rhview
