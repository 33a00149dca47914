// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "vertex_reuse.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rhview {
namespace {

/// A sphere whose triangles share their vertices, in rings.
struct Sphere {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    explicit Sphere(std::uint32_t sides) {
        for (std::uint32_t i = 0; i <= sides; ++i)
            for (std::uint32_t j = 0; j <= sides; ++j) {
                const float theta = 3.14159265f * static_cast<float>(i) / static_cast<float>(sides);
                const float phi = 6.2831853f * static_cast<float>(j) / static_cast<float>(sides);
                positions.emplace_back(std::sin(theta) * std::cos(phi), std::cos(theta),
                                       std::sin(theta) * std::sin(phi));
            }
        for (std::uint32_t i = 0; i < sides; ++i)
            for (std::uint32_t j = 0; j < sides; ++j) {
                const std::uint32_t a = i * (sides + 1) + j, b = a + sides + 1;
                for (const std::uint32_t index : {a, a + 1, b, b, a + 1, b + 1}) indices.push_back(index);
            }
    }
};

/// Cubes of 24 vertices: a quad's two triangles share an edge and face alike.
struct Cubes {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    explicit Cubes(int count) {
        for (int c = 0; c < count; ++c)
            for (int face = 0; face < 6; ++face) {
                const auto first = static_cast<std::uint32_t>(positions.size());
                const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
                for (int corner = 0; corner < 4; ++corner) {
                    glm::vec3 p(0.0f);
                    p[axis] = static_cast<float>(face % 2);
                    p[u] = static_cast<float>(corner & 1);
                    p[v] = static_cast<float>(corner >> 1);
                    positions.push_back(p + glm::vec3(3.0f * static_cast<float>(c), 0.0f, 0.0f));
                }
                if (face % 2 == 1)
                    for (const std::uint32_t i : {0u, 1u, 2u, 2u, 1u, 3u}) indices.push_back(first + i);
                else
                    for (const std::uint32_t i : {0u, 2u, 1u, 1u, 2u, 3u}) indices.push_back(first + i);
            }
    }
};

RhOctree build(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices) {
    const TriangleBatch batch{MaterialId{0}, positions, indices};
    OctreeOptions options;
    options.max_leaf_triangles = 1000000;
    return build_octree({&batch, 1}, options).value();
}

TEST(VertexReuse, counts_the_vertices_that_the_last_ones_do_not_hold) {
    EXPECT_EQ(shaded_vertices({}), 0u);
    const std::vector<std::uint32_t> quad{0, 1, 2, 2, 1, 3};
    EXPECT_EQ(shaded_vertices(quad), 4u);
    // Two vertices of one place in the cache drive each other out.
    const std::vector<std::uint32_t> rivals{0, 64, 0, 64, 0, 64};
    EXPECT_EQ(shaded_vertices(rivals), 6u);
}

TEST(VertexReuse, half_is_drawn_of_flat_clusters_all_of_those_that_are_never_skipped) {
    NormalCluster flat, cone, never;
    flat.index_count = cone.index_count = never.index_count = 300;
    flat.facing.cutoff = 0.0f;
    cone.facing.cutoff = 0.5f;
    EXPECT_EQ(expected_share(std::vector{flat}), 0.5);
    EXPECT_EQ(expected_share(std::vector{cone}), 0.75);
    EXPECT_EQ(expected_share(std::vector{never}), 1.0);
    EXPECT_EQ(expected_share(std::vector{flat, never}), 0.75);
    EXPECT_EQ(expected_share({}), 1.0);
}

TEST(VertexReuse, cubes_are_ordered_by_normal_for_nothing) {
    const Cubes cubes(500);
    const RhOctree octree = build(cubes.positions, cubes.indices);
    EXPECT_GE(octree.clusters().size(), 6u);
    EXPECT_EQ(shaded_vertices(octree.indices()), shaded_vertices(cubes.indices));
}

TEST(VertexReuse, a_smooth_surface_keeps_the_sources_order_where_vertices_are_shared_more_than_skipped) {
    const Sphere sphere(60);
    const RhOctree octree = build(sphere.positions, sphere.indices);
    ASSERT_EQ(octree.pieces().size(), 1u);
    const double drawn =
        expected_share(octree.clusters()) * static_cast<double>(shaded_vertices(octree.indices()));
    EXPECT_LE(drawn, static_cast<double>(shaded_vertices(sphere.indices)));
}

}  // namespace
}  // namespace rhview
