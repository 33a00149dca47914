// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The program's promise on real pixels: a culled frame has the depths of the whole scene, bit for bit.

#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "gl_fixture.h"
#include "random_geometry.h"
#include "rhview/baselines/draw_everything.h"
#include "rhview/baselines/octree_leaves.h"
#include "rhview/pipeline/rhview_planner.h"
#include "rhview/scenes/object_motion.h"
#include "static_objects.h"
#include "uniform.h"

namespace rhview::gl {
namespace {

/// Scattered triangles in three materials, one of them two-sided, and placed objects and instances: turned,
/// mirrored, squashed.
Scene scattered(const glm::dvec3& origin) {
    SceneBuilder builder(origin);
    const RandomGeometry geometry(41, 3, 1500, 60.0f);
    const glm::dmat4 to_world = glm::translate(glm::dmat4(1.0), origin);
    for (std::size_t b = 0; b < 3; ++b) {
        const MaterialId material = builder.add_material({"", glm::vec3(0.8f), b == 2, false});
        for (std::size_t first = 0; first < geometry.indices[b].size(); first += 90)
            builder.add_static(
                material, {geometry.positions, {}, {}, std::span(geometry.indices[b]).subspan(first, 90)},
                to_world);
    }
    const MeshId mesh = builder.add_mesh(MaterialId{0}, triangle_piece()).value();
    Uniform uniform(42);
    for (int i = 0; i < 40; ++i) {
        glm::dmat4 place =
            glm::translate(to_world, glm::dvec3(uniform(-60, 60), uniform(-9, 9), uniform(-60, 60)));
        place = glm::rotate(place, uniform(0, 6), glm::dvec3(0.3, 1, 0.2));
        builder.add_dynamic(mesh, glm::scale(place, glm::dvec3(i % 2 ? -4.0 : 4.0, uniform(0.1, 5), 2.0)));
    }
    const MeshPiece clump{geometry.positions, {}, {}, std::span(geometry.indices[1]).first(300)};
    for (const MaterialId material : {MaterialId{0}, MaterialId{2}}) {
        const bool small = material == MaterialId{0};
        const MeshId shape = builder.add_mesh(material, small ? triangle_piece() : clump).value();
        for (int i = 0; i < 30; ++i) {
            glm::dmat4 place =
                glm::translate(to_world, glm::dvec3(uniform(-60, 60), uniform(-9, 9), uniform(-60, 60)));
            place = glm::rotate(place, uniform(0, 6), glm::dvec3(0.2, 1, 0.5));
            const glm::dvec3 scale(i % 2 ? -0.3 : 0.3, uniform(0.1, 0.5), 0.2);
            EXPECT_TRUE(builder.add_instance(shape, glm::scale(place, (small ? 12.0 : 1.0) * scale)));
        }
    }
    return builder.finish("scattered").value();
}

struct Method {
    std::unique_ptr<FramePlanner> planner;
    std::unique_ptr<RhOctree> octree;
    SceneBuffers buffers;
};

std::vector<Method> every_method(const Scene& scene) {
    std::vector<Method> methods;
    methods.push_back(
        {std::make_unique<FrustumObjects>(objects_of(scene)), nullptr, SceneBuffers::upload(scene).value()});
    for (const bool seed : {false, true}) {
        auto octree = std::make_unique<RhOctree>(build_octree(scene.triangle_batches(), {40}).value());
        SceneBuffers buffers = SceneBuffers::upload(scene, octree->indices()).value();
        std::unique_ptr<FramePlanner> planner;
        if (seed)
            planner = std::make_unique<SeedPlanner>(*octree);
        else
            planner = std::make_unique<OctreeLeaves>(*octree);
        methods.push_back({std::move(planner), std::move(octree), std::move(buffers)});
    }
    // By few costs each: gaps bridged, and replicas drawn instead.
    for (const DrawCosts& costs : {DrawCosts{1, 0, 0}, DrawCosts{10, 500, 0}, DrawCosts{10, 20000, 0}}) {
        OctreeOptions options;
        options.max_leaf_triangles = 40;
        options.replica_budget = 1.0;
        options.costs = costs;
        auto octree = std::make_unique<RhOctree>(build_octree(scene.triangle_batches(), options).value());
        SceneBuffers buffers = SceneBuffers::upload(scene, octree->indices()).value();
        auto planner = std::make_unique<RhviewPlanner>(*octree, costs);
        methods.push_back({std::move(planner), std::move(octree), std::move(buffers)});
    }
    return methods;
}

struct OracleCase {
    ClipDepth depth;
    double offset;
    double far;
};

class Oracle : public GlTest, public testing::WithParamInterface<OracleCase> {};

TEST_P(Oracle, culled_frames_miss_no_pixel_from_random_views) {
    const auto [depth, offset, far] = GetParam();
    const glm::dvec3 origin(offset, -offset, 2.0 * offset);
    const Scene scene = scattered(origin);
    const std::vector<Aabb> boxes = scene.object_boxes();
    ASSERT_EQ(boxes.size(), 100u);
    std::vector<std::uint32_t> counts;
    for (const SceneBatch& batch : scene.batches)
        counts.push_back(static_cast<std::uint32_t>(batch.indices.size()));
    DrawEverything reference(counts, scene.bounds());
    const std::vector<Method> methods = every_method(scene);

    Uniform uniform(43);
    FramePlan plan, everything;
    std::uint64_t culled_indices = 0, all_indices = 0;
    std::size_t covered = 0;
    for (int i = 0; i < 40; ++i) {
        const glm::dvec3 eye = origin + glm::dvec3(uniform(-70, 70), uniform(-12, 12), uniform(-70, 70));
        const FrameInput input{view_at(eye, {uniform(-1, 1), uniform(-0.4, 0.4), uniform(-1, 1)}, depth, far),
                               scene.origin, boxes};
        for (const Method& method : methods) {
            method.planner->plan(input, plan);
            const std::vector<float> culled = depths_of(plan, method.buffers, input.culling_view);
            culled_indices += counters_.indices;
            reference.plan(input, everything);
            const std::vector<float> whole = depths_of(everything, method.buffers, input.culling_view);
            all_indices += counters_.indices;
            covered += covered_pixels(whole, depth);
            ASSERT_EQ(count_missing_pixels(culled, whole), 0u) << "view " << i;
        }
    }
    EXPECT_LT(culled_indices, all_indices / 2);
    EXPECT_GT(covered, 40u * 3u * 1000u);
}

INSTANTIATE_TEST_SUITE_P(Views, Oracle,
                         testing::Values(OracleCase{ClipDepth::NegativeOneToOne, 0.0, 1000.0},
                                         OracleCase{ClipDepth::ZeroToOne, 0.0, 30.0},
                                         OracleCase{ClipDepth::ReversedZeroToOne, 0.0, 30.0},
                                         OracleCase{ClipDepth::ReversedZeroToOne, 1e7,
                                                    std::numeric_limits<double>::infinity()},
                                         OracleCase{ClipDepth::NegativeOneToOne, 1e5, 1e6}));

TEST_F(GlTest, every_method_draws_a_scene_of_instances_alone) {
    Scene scene = scattered(glm::dvec3(0.0));
    scene.batches.clear();
    scene.dynamic_objects.clear();
    const std::vector<Aabb> boxes = scene.object_boxes();
    const std::vector<std::uint32_t> groups = object_groups(scene);
    DrawEverything reference({}, scene.bounds());
    const std::vector<Method> methods = every_method(scene);
    FramePlan plan, everything;
    std::size_t covered = 0, drawn = 0;
    for (int i = 0; i < 8; ++i) {
        FrameInput input{view_at({8.0 * i - 30, 2, 50}, {0.2 * i - 0.7, 0, -1}), scene.origin, boxes};
        input.object_groups = groups;
        reference.plan(input, everything);
        for (const Method& method : methods) {
            method.planner->plan(input, plan);
            const std::vector<float> whole = depths_of(everything, method.buffers, input.culling_view);
            const std::vector<float> culled = depths_of(plan, method.buffers, input.culling_view);
            EXPECT_EQ(counters_.instances, plan.objects.size());
            EXPECT_LE(counters_.draw_calls, 4u);  // two meshes, mirrored or not
            ASSERT_EQ(count_missing_pixels(culled, whole), 0u) << "view " << i;
            covered += covered_pixels(culled);
            drawn += plan.objects.size();
        }
    }
    EXPECT_GT(covered, 8u * 6 * 300);
    EXPECT_LT(drawn, 8u * 6 * 40);
}

TEST_F(GlTest, oracle_sees_a_single_missing_triangle) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    builder.add_static(material, triangle_piece());
    builder.add_static(material, triangle_piece(), glm::translate(glm::dmat4(1.0), glm::dvec3(2, 0, 0)));
    const Scene scene = builder.finish("two").value();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    FramePlan both, one;
    both.opaque = {{BatchId{0}, 0, 6}};
    one.opaque = {{BatchId{0}, 0, 3}};
    const View view = view_at({0, 0, 0}, {0, 0, -1});
    const std::vector<float> whole = depths_of(both, buffers, view);
    const std::vector<float> missing = depths_of(one, buffers, view);
    EXPECT_EQ(count_missing_pixels(missing, whole), covered_pixels(whole) - covered_pixels(missing));
    EXPECT_GT(count_missing_pixels(missing, whole), 100u);
}

TEST_F(GlTest, depths_do_not_depend_on_the_order_of_drawing) {
    const Scene scene = scattered(glm::dvec3(0.0));
    const RhOctree octree = build_octree(scene.triangle_batches(), {30}).value();
    const SceneBuffers source_order = SceneBuffers::upload(scene).value();
    const SceneBuffers base_order = SceneBuffers::upload(scene, octree.indices()).value();
    std::vector<std::uint32_t> counts;
    for (const SceneBatch& batch : scene.batches)
        counts.push_back(static_cast<std::uint32_t>(batch.indices.size()));
    DrawEverything everything(counts, scene.bounds());
    FramePlan plan;
    everything.plan({}, plan);
    const View view = view_at({0, 3, 70}, {0, -0.1, -1});
    EXPECT_EQ(depths_of(plan, source_order, view), depths_of(plan, base_order, view));
}

}  // namespace
}  // namespace rhview::gl
