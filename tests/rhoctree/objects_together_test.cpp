// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// What the octree makes of the author's objects: small ones stay whole.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "rhview/rhoctree/rhoctree.h"

namespace rhview {
namespace {

/// Objects of triangles that lie about; each triangle has vertices of its own.
struct Yard {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    std::vector<BatchObject> objects;

    /// One of `triangles` in a box of half the given size.
    void add(std::mt19937& random, const glm::vec3& centre, const glm::vec3& half, std::uint32_t triangles) {
        const auto uniform = [&] { return static_cast<float>(random() >> 8) / 8388608.0f - 1.0f; };
        BatchObject object{static_cast<std::uint32_t>(indices.size()), 3 * triangles, {}};
        for (std::uint32_t t = 0; t < triangles; ++t) {
            const glm::vec3 place = centre + half * glm::vec3(uniform(), uniform(), uniform());
            for (int corner = 0; corner < 3; ++corner) {
                const glm::vec3 p = place + 0.02f * glm::vec3(uniform(), uniform(), uniform());
                indices.push_back(static_cast<std::uint32_t>(positions.size()));
                positions.push_back(p);
                object.bounds = {glm::min(object.bounds.min, p), glm::max(object.bounds.max, p)};
            }
        }
        objects.push_back(object);
    }

    [[nodiscard]] TriangleBatch batch() const { return {MaterialId{0}, positions, indices, false, objects}; }
};

/// The leaves that have triangles of an object.
std::vector<std::set<std::uint32_t>> leaves_of_objects(const RhOctree& octree, const Yard& yard) {
    std::vector<std::set<std::uint32_t>> leaves(yard.objects.size());
    for (std::uint32_t n = 0; n < octree.nodes().size(); ++n) {
        if (!octree.is_leaf(NodeId{n})) continue;
        for (const DrawRange& range : octree.ranges(NodeId{n}))
            for (const std::uint32_t vertex :
                 octree.indices().subspan(range.first_index, range.index_count)) {
                // Vertex i is index i of the source.
                const auto next =
                    std::ranges::upper_bound(yard.objects, vertex, {}, &BatchObject::first_index);
                leaves[static_cast<std::size_t>(next - yard.objects.begin()) - 1].insert(n);
            }
    }
    return leaves;
}

Yard crates(std::uint32_t seed, int count) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<float>(random() >> 8) / 8388608.0f - 1.0f; };
    Yard yard;
    for (int i = 0; i < count; ++i)
        yard.add(random, 200.0f * glm::vec3(uniform(), 0.1f * uniform(), uniform()), glm::vec3(0.7f),
                 20 + static_cast<std::uint32_t>(random() % 40));
    return yard;
}

TEST(ObjectsTogether, a_small_object_is_in_one_leaf) {
    const Yard yard = crates(1, 500);
    const TriangleBatch batch = yard.batch();
    const Result<RhOctree> octree = build_octree({&batch, 1}, {300});
    ASSERT_TRUE(octree.ok());
    EXPECT_GT(octree->leaf_count(), 60u);
    for (const std::set<std::uint32_t>& leaves : leaves_of_objects(*octree, yard))
        EXPECT_EQ(leaves.size(), 1u);

    // Without objects some are cut through.
    const TriangleBatch unknown{MaterialId{0}, yard.positions, yard.indices};
    const Result<RhOctree> cutting = build_octree({&unknown, 1}, {300});
    ASSERT_TRUE(cutting.ok());
    EXPECT_TRUE(std::ranges::any_of(leaves_of_objects(*cutting, yard),
                                    [](const auto& leaves) { return leaves.size() > 1; }));
}

TEST(ObjectsTogether, a_long_object_of_few_triangles_is_divided) {
    Yard yard = crates(2, 500);
    std::mt19937 random(3);
    yard.add(random, glm::vec3(0.0f), {200.0f, 0.1f, 0.1f}, 100);
    const TriangleBatch batch = yard.batch();
    const Result<RhOctree> octree = build_octree({&batch, 1}, {300});
    ASSERT_TRUE(octree.ok());
    EXPECT_GT(leaves_of_objects(*octree, yard).back().size(), 4u);
}

TEST(ObjectsTogether, an_object_larger_than_a_leaf_is_divided) {
    Yard yard = crates(4, 50);
    std::mt19937 random(5);
    yard.add(random, glm::vec3(0.0f), glm::vec3(0.7f), 1000);
    const TriangleBatch batch = yard.batch();
    const Result<RhOctree> octree = build_octree({&batch, 1}, {300});
    ASSERT_TRUE(octree.ok());
    EXPECT_GT(leaves_of_objects(*octree, yard).back().size(), 3u);
    for (std::uint32_t n = 0; n < octree->nodes().size(); ++n) {
        if (!octree->is_leaf(NodeId{n})) continue;
        EXPECT_LE(octree->nodes()[n].triangle_count, 300u);
    }
}

TEST(ObjectsTogether, objects_that_cannot_be_are_refused_by_name) {
    const Yard yard = crates(6, 3);
    const auto message = [&](std::size_t object, const BatchObject& wrong) {
        std::vector<BatchObject> objects = yard.objects;
        objects[object] = wrong;
        const TriangleBatch batch{MaterialId{0}, yard.positions, yard.indices, false, objects};
        const Result<RhOctree> octree = build_octree({&batch, 1});
        return octree ? std::string() : octree.error().message;
    };
    const BatchObject right = yard.objects[1];
    EXPECT_EQ(message(1, right), "");
    EXPECT_EQ(message(1, {right.first_index + 1, 3, right.bounds}),
              "batch 0, object 1: its indices are no whole triangles");
    EXPECT_EQ(message(1, {right.first_index - 3, 3, right.bounds}),
              "batch 0, object 1: it begins before the one before it ends");
    EXPECT_EQ(message(2, {yard.objects[2].first_index, 0xffffffffu, right.bounds}),
              "batch 0, object 2: it ends beyond the batch's indices");
    EXPECT_EQ(message(1, {right.first_index, right.index_count, {}}), "batch 0, object 1: its box is none");
    EXPECT_EQ(message(1, {right.first_index, 0, {}}), "");
}

}  // namespace
}  // namespace rhview
