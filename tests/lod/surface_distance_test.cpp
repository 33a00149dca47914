// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "surface_distance.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "meshes.h"
#include "uniform.h"

namespace rhview {
namespace {

Triangle random_triangle(Uniform& uniform, double flatness) {
    Triangle triangle{uniform.point(1.0), uniform.point(1.0), uniform.point(1.0)};
    // Nearer to a line the smaller it is; a point at 0.
    triangle.c = triangle.a + 0.3 * (triangle.b - triangle.a) + flatness * (triangle.c - triangle.a);
    return triangle;
}

/// The least distance among points spread over the triangle, and how far apart they are.
std::pair<double, double> sampled_distance(const glm::dvec3& p, const Triangle& triangle) {
    constexpr int kSteps = 120;
    double least = 1e300;
    for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; i + j <= kSteps; ++j) {
            const double u = 1.0 * i / kSteps, v = 1.0 * j / kSteps;
            const glm::dvec3 at = triangle.a + u * (triangle.b - triangle.a) + v * (triangle.c - triangle.a);
            least = std::min(least, glm::length(p - at));
        }
    const double longest =
        std::max({glm::length(triangle.b - triangle.a), glm::length(triangle.c - triangle.a),
                  glm::length(triangle.c - triangle.b)});
    return {least, longest / kSteps};
}

TEST(PointTriangle, the_distance_is_that_of_the_nearest_of_many_points_of_the_triangle) {
    Uniform uniform(1);
    for (int i = 0; i < 2000; ++i) {
        const Triangle triangle = random_triangle(uniform, i % 3 == 0 ? 1.0 : i % 3 == 1 ? 1e-3 : 0.0);
        const glm::dvec3 p = uniform.point(2.0);
        const auto [sampled, spacing] = sampled_distance(p, triangle);
        const double distance = std::sqrt(distance_squared(p, triangle));
        ASSERT_LE(distance, sampled + 1e-9) << i;
        ASSERT_GE(distance, sampled - spacing) << i;
    }
}

TEST(PointTriangle, a_triangle_that_is_one_point_is_as_far_as_the_point) {
    const glm::dvec3 a(1, 2, 3);
    EXPECT_DOUBLE_EQ(distance_squared({1, 2, 5}, {a, a, a}), 4.0);
}

TEST(TriangleTree, the_nearest_triangle_is_as_near_as_an_exhaustive_search_finds_one) {
    const TestMesh mesh = rippled_torus(12, 30, 0.05);
    const TriangleTree tree(mesh.positions, mesh.indices);
    const auto count = static_cast<std::uint32_t>(mesh.indices.size() / 3);
    Uniform uniform(2);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 p = uniform.point(1.6);
        double least = 1e300;
        for (std::uint32_t t = 0; t < count; ++t)
            least = std::min(least, distance_squared(p, tree.triangle(t)));
        const auto found = tree.nearest(p, static_cast<std::uint32_t>(i) % count);
        ASSERT_DOUBLE_EQ(found.distance_squared, least) << i;
        ASSERT_DOUBLE_EQ(distance_squared(p, tree.triangle(found.triangle)), least) << i;
    }
}

/// Points all over `from`'s triangles: the greatest of their distances from `to`, by exhaustive search.
double sampled_one_sided(const TestMesh& from, const TestMesh& to, int steps) {
    const TriangleTree tree(to.positions, to.indices);
    double most = 0.0;
    for (std::size_t t = 0; t < from.indices.size(); t += 3) {
        const glm::dvec3 a = from.positions[from.indices[t]], b = from.positions[from.indices[t + 1]],
                         c = from.positions[from.indices[t + 2]];
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                const glm::dvec3 p = a + (b - a) * (1.0 * i / steps) + (c - a) * (1.0 * j / steps);
                double least = 1e300;
                for (std::uint32_t s = 0; s < to.indices.size() / 3; ++s)
                    least = std::min(least, distance_squared(p, tree.triangle(s)));
                most = std::max(most, least);
            }
    }
    return std::sqrt(most);
}

TEST(SurfaceDistance, the_bound_is_above_all_sampled_distances_and_hardly_more) {
    for (const double ripple : {0.0, 0.03, 0.1}) {
        const TestMesh fine = rippled_torus(16, 40, ripple), coarse = rippled_torus(7, 11, 0.0);
        for (const bool from_fine : {true, false}) {
            const TestMesh &from = from_fine ? fine : coarse, &to = from_fine ? coarse : fine;
            const TriangleTree tree(to.positions, to.indices);
            const double bound = one_sided_distance_bound({from.positions, from.indices}, tree, 0.0);
            const double sampled = sampled_one_sided(from, to, from_fine ? 6 : 30);
            EXPECT_GE(bound, sampled * (1.0 - 1e-12)) << ripple;
            EXPECT_LE(bound, 1.06 * sampled) << ripple;
        }
    }
}

TEST(SurfaceDistance, a_surface_is_at_no_distance_from_itself_cut_otherwise) {
    // Quads cut along the other diagonal: the same plane, and no triangle lies within another.
    TestMesh sheet = wavy_sheet(8);
    for (glm::vec3& p : sheet.positions) p.y = 0.0f;
    TestMesh other = sheet;
    other.indices.clear();
    for (std::uint32_t i = 0; i < 8; ++i)
        for (std::uint32_t j = 0; j < 8; ++j) {
            const std::uint32_t a = i * 9 + j;
            other.add_quad(a + 1, a + 10, a + 9, a);
        }
    const TriangleTree tree(other.positions, other.indices);
    EXPECT_LT(one_sided_distance_bound({sheet.positions, sheet.indices}, tree, 0.0), 1e-4);
}

TEST(SurfaceDistance, it_is_one_sided) {
    TestMesh sheet = wavy_sheet(4), more = sheet;
    more.positions.push_back({5, 0, 0});
    more.indices.insert(more.indices.end(), {0, 1, 25});
    const TriangleTree tree(sheet.positions, sheet.indices), tree_of_more(more.positions, more.indices);
    EXPECT_LT(one_sided_distance_bound({sheet.positions, sheet.indices}, tree_of_more, 0.0), 1e-6);
    EXPECT_GT(one_sided_distance_bound({more.positions, more.indices}, tree, 0.0), 3.99);
}

TEST(SurfaceDistance, the_bound_is_the_same_on_one_thread_and_on_many) {
    const TestMesh fine = rippled_torus(40, 90, 0.05), coarse = rippled_torus(9, 23, 0.02);
    const TriangleTree tree(coarse.positions, coarse.indices);
    const auto bound = [&](std::size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        return one_sided_distance_bound({fine.positions, fine.indices}, tree, 0.0);
    };
    const double alone = bound(1);
    for (int repeat = 0; repeat < 5; ++repeat) EXPECT_EQ(bound(4), alone);
}

}  // namespace
}  // namespace rhview
