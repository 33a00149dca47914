// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/lod/lod_chain.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "meshes.h"
#include "point_triangle.h"
#include "rhview/base/assert.h"

namespace rhview {
namespace {

LodChain chain_of(const TestMesh& mesh, const LodOptions& options = {}) {
    const LodMesh lod_mesh = mesh.mesh();
    auto chains = build_lod_chains({&lod_mesh, 1}, options);
    EXPECT_TRUE(chains.ok());
    return std::move(chains->front());
}

Triangle triangle_of(const TestMesh& mesh, std::span<const std::uint32_t> indices, std::size_t t) {
    return {mesh.positions[indices[t]], mesh.positions[indices[t + 1]], mesh.positions[indices[t + 2]]};
}

/// The greatest distance of sampled points of the triangles `from` from the triangles `to`, all of `mesh`.
double sampled_distance(const TestMesh& mesh, std::span<const std::uint32_t> from,
                        std::span<const std::uint32_t> to, int steps) {
    double most = 0.0;
    for (std::size_t t = 0; t < from.size(); t += 3) {
        const Triangle source = triangle_of(mesh, from, t);
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                const glm::dvec3 p = source.a + (source.b - source.a) * (1.0 * i / steps) +
                                     (source.c - source.a) * (1.0 * j / steps);
                double least = std::numeric_limits<double>::infinity();
                for (std::size_t s = 0; s < to.size(); s += 3)
                    least = std::min(least, distance_squared(p, triangle_of(mesh, to, s)));
                most = std::max(most, least);
            }
    }
    return std::sqrt(most);
}

void expect_well_formed(const LodChain& chain, const LodMesh& mesh) {
    ASSERT_GE(chain.levels.size(), 1u);
    EXPECT_EQ(chain.levels[0], (LodLevel{0, static_cast<std::uint32_t>(mesh.indices.size()), 0.0f, 0}));
    EXPECT_EQ(chain.vertex_count, mesh.positions.size());
    std::uint32_t next = 0;
    for (std::size_t i = 1; i < chain.levels.size(); ++i) {
        const LodLevel &level = chain.levels[i], &before = chain.levels[i - 1];
        EXPECT_EQ(level.first_index, next);
        EXPECT_EQ(level.index_count % 3, 0u);
        EXPECT_LE(level.index_count, 0.8 * before.index_count);
        EXPECT_GT(level.error, before.error);
        EXPECT_TRUE(std::isfinite(level.error));
        EXPECT_GE(level.sloppy, before.sloppy);
        next += level.index_count;
    }
    EXPECT_EQ(chain.indices.size(), next);
    const std::set<std::uint32_t> own(mesh.indices.begin(), mesh.indices.end());
    for (const std::uint32_t index : chain.indices) ASSERT_TRUE(own.contains(index));
}

TEST(LodChain, errors_bound_the_sampled_distance_both_ways_and_are_hardly_looser) {
    for (const TestMesh& mesh : {rippled_torus(24, 60, 0.06), wavy_sheet(36)}) {
        const LodChain chain = chain_of(mesh);
        ASSERT_GE(chain.levels.size(), 4u);
        expect_well_formed(chain, mesh.mesh());
        for (std::size_t i = 1; i < chain.levels.size(); ++i) {
            const auto level = indices_of(chain, mesh.mesh(), i);
            // As many points a triangle as make them equally dense on either side.
            const double share = static_cast<double>(mesh.indices.size()) / static_cast<double>(level.size());
            const int steps = std::min(40, static_cast<int>(std::sqrt(20.0 * share)));
            const double of_mesh = sampled_distance(mesh, mesh.indices, level, 2);
            const double of_level = sampled_distance(mesh, level, mesh.indices, steps);
            EXPECT_GE(chain.levels[i].error, std::max(of_mesh, of_level)) << i;
            EXPECT_LE(chain.levels[i].error, 1.12 * std::max(of_mesh, of_level) + 1e-4) << i;
        }
    }
}

TEST(LodChain, a_smooth_mesh_gets_as_small_as_was_asked_for_at_errors_that_grow) {
    const LodChain chain = chain_of(rippled_torus(60, 150, 0.02), {.min_triangles = 100});
    EXPECT_EQ(chain.end, LodEnd::Smallest);
    EXPECT_LE(chain.levels[chain.levels.size() - 1].index_count, 3u * 130u);
    EXPECT_GE(chain.levels[chain.levels.size() - 1].index_count, 3u * 80u);
    EXPECT_LT(chain.levels[1].error, 0.02f);
}

TEST(LodChain, a_mesh_in_a_shared_pool_gets_the_chain_that_it_has_alone) {
    const TestMesh torus = rippled_torus(20, 50, 0.03);
    TestMesh pooled;
    pooled.positions.assign(1000, glm::vec3(1e6f));
    pooled.positions.insert(pooled.positions.end(), torus.positions.begin(), torus.positions.end());
    pooled.positions.insert(pooled.positions.end(), 1000, glm::vec3(-1e6f));
    for (const std::uint32_t index : torus.indices) pooled.indices.push_back(index + 1000);
    const LodChain alone = chain_of(torus), chain = chain_of(pooled);
    EXPECT_EQ(alone.levels, chain.levels);
    for (std::size_t i = 0; i < alone.indices.size(); ++i)
        EXPECT_EQ(alone.indices[i] + 1000, chain.indices[i]);
}

TEST(LodChain, locked_borders_keep_every_vertex_of_the_border) {
    constexpr std::uint32_t kSide = 40;
    const TestMesh sheet = wavy_sheet(kSide);
    const LodChain chain = chain_of(sheet, {.lock_borders = true, .allow_sloppy = false});
    ASSERT_GE(chain.levels.size(), 3u);
    for (std::size_t level = 1; level < chain.levels.size(); ++level) {
        const auto indices = indices_of(chain, sheet.mesh(), level);
        const std::set<std::uint32_t> used(indices.begin(), indices.end());
        for (std::uint32_t i = 0; i <= kSide; ++i)
            for (const std::uint32_t border :
                 {i, kSide * (kSide + 1) + i, i * (kSide + 1), i * (kSide + 1) + kSide})
                ASSERT_TRUE(used.contains(border)) << "level " << level << ", vertex " << border;
    }
    const LodChain free_chain = chain_of(sheet, {.allow_sloppy = false});
    const auto coarsest = indices_of(free_chain, sheet.mesh(), free_chain.levels.size() - 1);
    EXPECT_LT(std::set(coarsest.begin(), coarsest.end()).size(), 4u * kSide)
        << "nothing was locked by itself";
}

TEST(LodChain, triangles_that_share_no_vertex_are_joined_by_position) {
    const TestMesh mesh = unshared(rippled_torus(24, 60, 0.02));
    const LodChain chain = chain_of(mesh, {.allow_sloppy = false});
    expect_well_formed(chain, mesh.mesh());
    EXPECT_GE(chain.levels.size(), 4u);
    EXPECT_EQ(chain.end, LodEnd::Smallest);
}

TEST(LodChain, levels_stand_in_an_order_for_the_vertex_cache) {
    const TestMesh mesh = rippled_torus(60, 120, 0.02);
    const LodChain chain = chain_of(mesh);
    for (std::size_t i = 1; i < chain.levels.size(); ++i) {
        const auto indices = indices_of(chain, mesh.mesh(), i);
        if (indices.size() < 3 * 500) break;
        const auto statistics =
            meshopt_analyzeVertexCache(indices.data(), indices.size(), mesh.positions.size(), 16, 0, 0);
        EXPECT_LT(statistics.acmr, 0.85f) << i;
    }
}

TEST(LodChain, what_cannot_be_simplified_keeps_level_0_and_says_why) {
    const auto expect_level_0 = [](const TestMesh& mesh, LodEnd end, const LodOptions& options = {}) {
        const LodChain chain = chain_of(mesh, options);
        EXPECT_EQ(chain.levels.size(), 1u);
        EXPECT_EQ(chain.levels[0].index_count, mesh.indices.size());
        EXPECT_EQ(chain.end, end) << text_of(chain.end);
    };
    expect_level_0({}, LodEnd::FewTriangles);
    expect_level_0(wavy_sheet(4), LodEnd::FewTriangles);
    TestMesh broken = wavy_sheet(12);
    broken.positions[17].y = std::numeric_limits<float>::quiet_NaN();
    expect_level_0(broken, LodEnd::NotFinite);
    broken.positions[17].y = std::numeric_limits<float>::infinity();
    expect_level_0(broken, LodEnd::NotFinite);
    TestMesh line = wavy_sheet(12);
    for (glm::vec3& p : line.positions) p = {p.x, 0, 0};
    expect_level_0(line, LodEnd::NoArea);
    // Scattered triangles: each is nothing but border.
    TestMesh scattered;
    for (std::uint32_t i = 0; i < 100; ++i) {
        const auto at = static_cast<float>(3 * i);
        scattered.positions.insert(scattered.positions.end(), {{at, 0, 0}, {at + 1, 0, 0}, {at, 1, 0}});
        scattered.indices.insert(scattered.indices.end(), {3 * i, 3 * i + 1, 3 * i + 2});
    }
    expect_level_0(scattered, LodEnd::Locked, {.lock_borders = true, .allow_sloppy = false});
    // A book: many pages on one spine, which is an edge of all of them.
    TestMesh book;
    book.positions = {{0, 0, 0}, {0, 1, 0}};
    for (std::uint32_t i = 0; i < 60; ++i) {
        const double angle = 0.1 * i;
        book.positions.push_back(glm::vec3(std::cos(angle), 0.5, std::sin(angle)));
        book.indices.insert(book.indices.end(), {0, 1, i + 2});
    }
    expect_level_0(book, LodEnd::NonManifold, {.lock_borders = true, .allow_sloppy = false});
}

TEST(LodChain, positions_that_no_triangle_uses_may_be_anything) {
    TestMesh mesh = rippled_torus(20, 40, 0.02);
    mesh.positions.push_back(glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    EXPECT_GE(chain_of(mesh).levels.size(), 3u);
}

TEST(LodChain, sloppy_levels_are_marked_last_and_only_where_allowed) {
    // Scattered triangles with locked borders: no edge of theirs can go.
    TestMesh litter;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const glm::vec3 at(i % 20, 0.1 * (i * i % 7), i / 20);
        litter.positions.insert(litter.positions.end(),
                                {at, at + glm::vec3(0.5f, 0, 0), at + glm::vec3(0, 0, 0.5f)});
        litter.indices.insert(litter.indices.end(), {3 * i, 3 * i + 2, 3 * i + 1});
    }
    const LodChain with = chain_of(litter, {.lock_borders = true}),
                   without = chain_of(litter, {.lock_borders = true, .allow_sloppy = false});
    expect_well_formed(with, litter.mesh());
    EXPECT_EQ(with.levels[with.levels.size() - 1].sloppy, 1u);
    for (const LodLevel& level : without.levels) EXPECT_EQ(level.sloppy, 0u);
    EXPECT_LT(with.levels[with.levels.size() - 1].index_count,
              without.levels[without.levels.size() - 1].index_count);
    for (std::size_t i = 1; i < with.levels.size(); ++i) {
        const auto level = indices_of(with, litter.mesh(), i);
        EXPECT_GE(with.levels[i].error, sampled_distance(litter, litter.indices, level, 3)) << i;
        EXPECT_GE(with.levels[i].error, sampled_distance(litter, level, litter.indices, 12)) << i;
    }
}

TEST(LodChain, chains_are_the_same_on_one_thread_and_on_many) {
    std::vector<TestMesh> meshes;
    for (std::uint32_t i = 0; i < 9; ++i) meshes.push_back(rippled_torus(12 + i, 40 + 7 * i, 0.01 * i));
    std::vector<LodMesh> spans;
    for (const TestMesh& mesh : meshes) spans.push_back(mesh.mesh());
    const auto build = [&](std::size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        return build_lod_chains(spans, {}).value();
    };
    const std::vector<LodChain> alone = build(1);
    for (int repeat = 0; repeat < 3; ++repeat) {
        const std::vector<LodChain> chains = build(4);
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            EXPECT_EQ(alone[i].levels, chains[i].levels);
            EXPECT_EQ(alone[i].indices, chains[i].indices);
        }
    }
}

TEST(LodChain, progress_rises_to_one_and_can_stop_the_build) {
    std::vector<TestMesh> meshes(6, rippled_torus(20, 50, 0.02));
    std::vector<LodMesh> spans;
    for (const TestMesh& mesh : meshes) spans.push_back(mesh.mesh());
    std::vector<double> told;
    LodOptions options;
    options.progress = [&](double done) {
        told.push_back(done);
        return true;
    };
    ASSERT_TRUE(build_lod_chains(spans, options).ok());
    ASSERT_GE(told.size(), 3u);
    EXPECT_TRUE(std::ranges::is_sorted(told));
    EXPECT_DOUBLE_EQ(told.back(), 1.0);
    options.progress = [](double) { return false; };
    const auto stopped = build_lod_chains(spans, options);
    ASSERT_FALSE(stopped.ok());
    EXPECT_EQ(stopped.error().message, "the build was stopped before it was done");
}

TEST(LodChain, one_large_mesh_tells_progress_too) {
    const TestMesh mesh = rippled_torus(60, 120, 0.02);
    int calls = 0;
    LodOptions options;
    options.progress = [&](double) { return ++calls < 2; };
    const LodMesh span = mesh.mesh();
    EXPECT_FALSE(build_lod_chains({&span, 1}, options).ok());
    EXPECT_EQ(calls, 2);
}

TEST(LodChain, bad_meshes_are_errors_that_name_the_mesh) {
    const TestMesh good = wavy_sheet(6);
    TestMesh bad = good;
    bad.indices[10] = 49;
    std::vector<LodMesh> meshes{good.mesh(), bad.mesh()};
    EXPECT_EQ(build_lod_chains(meshes, {}).error().message, "mesh 1: an index is not below its 49 positions");
    bad.indices.pop_back();
    meshes[1] = bad.mesh();
    EXPECT_EQ(build_lod_chains(meshes, {}).error().message,
              "mesh 1: its index count 215 is no multiple of three; give whole triangles");
}

}  // namespace
}  // namespace rhview
