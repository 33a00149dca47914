// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/static_instances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <random>

#include "rhview/scenes/scene_builder.h"

namespace rhview {
namespace {

RepeatedMesh mesh(std::uint32_t id, std::uint64_t placements, std::uint64_t triangles,
                  bool two_sided = false) {
    return {MeshId{id}, placements, triangles, triangles, 16, two_sided};
}

std::vector<MeshId> ids(std::initializer_list<std::uint32_t> numbers) {
    std::vector<MeshId> result;
    for (const std::uint32_t number : numbers) result.push_back(MeshId{number});
    return result;
}

constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 60;

TEST(InstanceChoice, dear_draws_flatten_everything_that_fits) {
    const std::vector<RepeatedMesh> meshes{mesh(0, 2, 1), mesh(3, 5000, 100), mesh(4, 7, 100'000, true)};
    EXPECT_EQ(choose_flattened(meshes, {0.25, 1e9}, kUnlimited), ids({0, 3, 4}));
}

TEST(InstanceChoice, cheap_draws_keep_large_meshes_that_facing_can_not_cut) {
    // Two-sided, so flattening shows no triangle less; one-sided, it does.
    const std::vector<RepeatedMesh> meshes{mesh(0, 100, 10'000, true), mesh(1, 100, 10'000, false),
                                           mesh(2, 100, 10, true)};
    EXPECT_EQ(choose_flattened(meshes, {3.5, 200}, kUnlimited), ids({1, 2}));
    EXPECT_EQ(choose_flattened(meshes, {3.5, 2e6}, kUnlimited), ids({0, 1, 2}));
}

TEST(InstanceChoice, without_memory_nothing_is_flattened) {
    const std::vector<RepeatedMesh> meshes{mesh(0, 2, 1), mesh(1, 100, 100)};
    EXPECT_TRUE(choose_flattened(meshes, {0.25, 1e9}, 0).empty());
    EXPECT_TRUE(choose_flattened({}, {}, kUnlimited).empty());
}

TEST(InstanceChoice, a_small_budget_goes_to_what_saves_most_per_byte) {
    // A call saved costs the bytes of one mesh: the smaller, the better. The largest does not fit what the
    // smallest left, the one between does.
    const std::vector<RepeatedMesh> meshes{mesh(0, 10, 5000), mesh(1, 10, 10), mesh(2, 10, 2000)};
    const InstanceCosts costs{0.25, 20'000};
    EXPECT_EQ(choose_flattened(meshes, costs, meshes[1].flattened_bytes()), ids({1}));
    EXPECT_EQ(choose_flattened(meshes, costs, meshes[1].flattened_bytes() - 1), ids({}));
    EXPECT_EQ(choose_flattened(meshes, costs, meshes[0].flattened_bytes()), ids({1, 2}));
    const std::uint64_t all =
        meshes[0].flattened_bytes() + meshes[1].flattened_bytes() + meshes[2].flattened_bytes();
    EXPECT_EQ(choose_flattened(meshes, costs, all - 1), ids({1, 2}));
    EXPECT_EQ(choose_flattened(meshes, costs, all), ids({0, 1, 2}));
}

TEST(InstanceChoice, of_equal_meshes_the_first_are_flattened) {
    const std::vector<RepeatedMesh> meshes{mesh(2, 9, 50), mesh(5, 9, 50), mesh(7, 9, 50)};
    EXPECT_EQ(choose_flattened(meshes, {}, 2 * meshes[0].flattened_bytes()), ids({2, 5}));
}

TEST(InstanceChoice, a_mesh_costs_as_its_placements_do) {
    const InstanceCosts costs{0.5, 1000};
    // Half of them in view: a box each, a call and 300 indices; or the indices that facing leaves.
    EXPECT_DOUBLE_EQ(kept_ns(mesh(0, 8, 100), costs), 8 * (15 + 0.5 * (1000 + 150)));
    EXPECT_DOUBLE_EQ(flattened_ns(mesh(0, 8, 100), costs), 8 * 0.5 * (0.72 * 150 + 15));
    EXPECT_DOUBLE_EQ(flattened_ns(mesh(0, 8, 100, true), costs), 8 * 0.5 * (1.04 * 150 + 15));
    // Free draws: none is charged.
    EXPECT_DOUBLE_EQ(flattened_ns(mesh(0, 8, 100, true), {0.5, 0}), 8 * 0.5 * 1.04 * 150);
}

TEST(InstanceChoice, greedy_keeps_the_budget_and_loses_at_most_one_mesh_to_the_best_choice) {
    std::mt19937 random(5);
    for (int round = 0; round < 200; ++round) {
        std::vector<RepeatedMesh> meshes;
        for (std::uint32_t i = 0; i < 9; ++i)
            meshes.push_back(mesh(i, 2 + random() % 50, 1 + random() % 3000, random() % 2 == 0));
        const InstanceCosts costs{0.1 * static_cast<double>(1 + random() % 40),
                                  static_cast<double>(random() % 3000)};
        const std::uint64_t budget = random() % 4'000'000;
        const auto saved = [&](const RepeatedMesh& m) {
            return std::max(0.0, kept_ns(m, costs) - flattened_ns(m, costs));
        };
        const std::vector<MeshId> chosen = choose_flattened(meshes, costs, budget);
        double greedy = 0.0, best = 0.0, most_left_out = 0.0;
        std::uint64_t bytes = 0;
        for (const RepeatedMesh& m : meshes) {
            if (std::ranges::binary_search(chosen, m.mesh)) {
                greedy += saved(m);
                bytes += m.flattened_bytes();
                EXPECT_GT(saved(m), 0.0);
            } else {
                most_left_out = std::max(most_left_out, saved(m));
            }
        }
        EXPECT_LE(bytes, budget);
        for (unsigned subset = 0; subset < 512; ++subset) {
            double sum = 0.0;
            std::uint64_t taken = 0;
            for (std::size_t i = 0; i < 9; ++i)
                if ((subset >> i & 1u) != 0) {
                    sum += saved(meshes[i]);
                    taken += meshes[i].flattened_bytes();
                }
            if (taken <= budget) best = std::max(best, sum);
        }
        EXPECT_GE(greedy + most_left_out, best * (1 - 1e-12));
    }
}

const std::vector<glm::vec3> kPositions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<glm::vec3> kNormals{{0, 0, 1}, {0.6f, 0.8f, 0}, {0, 1, 0}, {-1, 0, 0}};
const std::vector<PackedColour> kColours{pack_colour({1, 0, 0}), pack_colour({0, 1, 0}),
                                         pack_colour({0, 0, 1}), pack_colour({1, 1, 0})};
const std::vector<std::uint32_t> kIndices{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
const std::vector<std::uint32_t> kThree{3, 1, 2};

/// Turned, mirrored, squashed, far.
std::vector<glm::dmat4> places() {
    const glm::dmat4 one(1.0);
    return {glm::translate(one, {5, 0, 0}), glm::scale(glm::translate(one, {0, 7, 1}), {-1, 1, 2}),
            glm::rotate(glm::translate(one, {1000, 7, 1}), 0.7, glm::dvec3(0.3, 1, 0.2)),
            glm::scale(glm::rotate(one, 2.0, glm::dvec3(0, 1, 1)), {-0.25, 3, 1})};
}

enum class Way { Direct, Instances };

/// Three meshes in three formats, of two materials, each at every place, beside a batch and a dynamic object
/// of the second mesh.
Scene scene_of(Way way) {
    SceneBuilder builder(glm::dvec3(1, 2, 3));
    const MaterialId wall = builder.add_material({"wall", glm::vec3(0.5f), false, false});
    const MaterialId leaf = builder.add_material({"leaf", glm::vec3(0.2f), true, true});
    const std::vector<std::pair<MaterialId, MeshPiece>> pieces{{wall, {kPositions, kNormals, {}, kIndices}},
                                                               {leaf, {kPositions, {}, kColours, kIndices}},
                                                               {leaf, {kPositions, {}, kColours, kThree}}};
    builder.add_static(wall, pieces[0].second, glm::translate(glm::dmat4(1.0), glm::dvec3(-3, 0, 0)));
    for (const auto& [material, piece] : pieces) {
        const std::optional<MeshId> mesh = builder.add_mesh(material, piece);
        if (index_of(*mesh) == 1) builder.add_dynamic(*mesh, glm::dmat4(1.0));
        for (const glm::dmat4& place : places()) {
            if (way == Way::Instances)
                EXPECT_TRUE(builder.add_instance(*mesh, place));
            else
                builder.add_static(material, piece, place);
        }
    }
    return builder.finish("placed").value();
}

struct Corner {
    glm::vec3 position;
    glm::vec3 normal;
    std::uint32_t colour = 0;
};
struct Triangle {
    MaterialId material;
    std::array<Corner, 3> corners;
    [[nodiscard]] auto key() const {
        std::vector<double> key{static_cast<double>(index_of(material))};
        for (const Corner& c : corners)
            for (const double v :
                 {double(c.position.x), double(c.position.y), double(c.position.z), double(c.colour)})
                key.push_back(v);
        return key;
    }
};

std::vector<Triangle> triangles_of(const Scene& scene) {
    std::vector<Triangle> triangles;
    for (const SceneBatch& batch : scene.batches) {
        const VertexPool& pool = scene.pools[batch.pool];
        for (std::size_t i = 0; i < batch.indices.size(); i += 3) {
            Triangle triangle{batch.material, {}};
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t v = batch.indices[i + c];
                triangle.corners[c] = {
                    pool.positions[v], pool.normals.empty() ? glm::vec3(0) : unpack_normal(pool.normals[v]),
                    pool.colours.empty() ? 0 : static_cast<std::uint32_t>(pool.colours[v])};
            }
            triangles.push_back(triangle);
        }
    }
    std::ranges::sort(triangles, {}, &Triangle::key);
    return triangles;
}

void expect_same_triangles(const Scene& a, const Scene& b) {
    const std::vector<Triangle> left = triangles_of(a), right = triangles_of(b);
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
        EXPECT_EQ(left[i].key(), right[i].key()) << i;
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_LT(glm::length(left[i].corners[c].normal - right[i].corners[c].normal), 4.0f / 511) << i;
    }
}

void expect_objects_cover(const Scene& scene) {
    for (const SceneBatch& batch : scene.batches) {
        std::uint32_t next = 0;
        for (const SceneObject& object : batch.objects) {
            EXPECT_EQ(object.first_index, next);
            next += object.index_count;
            Aabb box;
            for (std::uint32_t i = object.first_index; i < next; ++i)
                box.grow(scene.pools[batch.pool].positions[batch.indices[i]]);
            EXPECT_EQ(object.bounds, box);
        }
        EXPECT_EQ(next, batch.indices.size());
    }
}

TEST(StaticInstances, flattened_they_are_what_the_builder_makes_without_them) {
    const Scene direct = scene_of(Way::Direct);
    Scene scene = scene_of(Way::Instances);
    ASSERT_TRUE(settle_instances(scene, {InstancePolicy::Flatten, {}, 0}).ok());
    expect_same_triangles(scene, direct);
    expect_objects_cover(scene);
    EXPECT_TRUE(scene.static_instances.empty());
    EXPECT_EQ(scene.static_objects(), direct.static_objects());
    // Of the meshes, only the dynamic object's is left, and its vertices.
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.dynamic_objects[0].mesh, MeshId{0});
    EXPECT_EQ(scene.meshes[0].indices.size(), kIndices.size());
    EXPECT_EQ(scene.vertex_count(), direct.vertex_count() - 4 - 3);
    EXPECT_EQ(scene.instancing.flattened_meshes, 3u);
    EXPECT_EQ(scene.instancing.flattened_placements, 12u);
    EXPECT_EQ(scene.instancing.flattened_bytes, scene.instancing.all_flattened_bytes);
    EXPECT_EQ(scene.instancing.flattened_bytes, 4u * (48 + 4 * 16) + 4u * (48 + 4 * 16) + 4u * (12 + 3 * 16));
    EXPECT_EQ(scene.instancing.kept_bytes, 0u);
    EXPECT_EQ(scene.instancing.chosen_ns, scene.instancing.all_flattened_ns);
}

TEST(StaticInstances, kept_they_count_as_placed_and_are_stored_once) {
    const Scene direct = scene_of(Way::Direct);
    Scene scene = scene_of(Way::Instances);
    ASSERT_TRUE(settle_instances(scene, {InstancePolicy::Keep, {}, kUnlimited}).ok());
    EXPECT_EQ(scene.static_instances.size(), 12u);
    EXPECT_EQ(scene.static_triangles(), direct.static_triangles());
    EXPECT_EQ(scene.static_objects(), direct.static_objects());
    EXPECT_EQ(scene.batch_triangles(), 4u);
    EXPECT_EQ(scene.instance_triangles(), 4u * 9);
    EXPECT_EQ(scene.vertex_count(), 4u + 4 + 4 + 3);
    EXPECT_EQ(scene.instancing.kept_meshes, 3u);
    EXPECT_EQ(scene.instancing.kept_placements, 12u);
    EXPECT_EQ(scene.instancing.kept_bytes, (48u + 4 * 16) + (48 + 4 * 16) + (12 + 3 * 16));
    EXPECT_EQ(scene.instancing.flattened_meshes, 0u);
    EXPECT_EQ(scene.instancing.chosen_ns, scene.instancing.all_kept_ns);
}

TEST(StaticInstances, boxes_hold_what_is_placed_as_closely_as_float_can) {
    const Scene scene = scene_of(Way::Instances);
    ASSERT_EQ(scene.object_count(), 13u);
    const std::vector<Aabb> boxes = scene.object_boxes();
    for (std::uint32_t i = 1; i < 13; ++i) {
        const StaticInstance& instance = scene.static_instances[i - 1];
        EXPECT_EQ(scene.object_mesh(ObjectId{i}), instance.mesh);
        EXPECT_EQ(scene.object_placement(ObjectId{i}), instance.scene_from_mesh);
        EXPECT_EQ(boxes[i], instance.bounds);
        const SceneMesh& of = scene.meshes[index_of(instance.mesh)];
        glm::dvec3 low(1e9), high(-1e9);
        for (const std::uint32_t vertex : of.indices) {
            const glm::dvec4 p(glm::dvec3(scene.pools[of.pool].positions[vertex]), 1.0);
            low = glm::min(low, glm::dvec3(instance.scene_from_mesh * p));
            high = glm::max(high, glm::dvec3(instance.scene_from_mesh * p));
        }
        for (int axis = 0; axis < 3; ++axis) {
            const double slack = 3e-7 * std::max(1e-30, std::max(std::abs(low[axis]), std::abs(high[axis])));
            EXPECT_LE(static_cast<double>(boxes[i].min[axis]), low[axis]);
            EXPECT_GE(static_cast<double>(boxes[i].min[axis]), low[axis] - slack);
            EXPECT_GE(static_cast<double>(boxes[i].max[axis]), high[axis]);
            EXPECT_LE(static_cast<double>(boxes[i].max[axis]), high[axis] + slack);
        }
    }
}

TEST(StaticInstances, what_is_kept_stays_what_it_was_beside_what_is_flattened) {
    const Scene before = scene_of(Way::Instances);
    Scene scene = before;
    // Room for one mesh, and what saves most per byte is the smallest.
    InstanceOptions options{InstancePolicy::Auto, {0.25, 2000}, 4u * (12 + 3 * 16)};
    ASSERT_TRUE(settle_instances(scene, options).ok());
    EXPECT_EQ(scene.instancing.flattened_meshes, 1u);
    EXPECT_EQ(scene.instancing.kept_meshes, 2u);
    EXPECT_EQ(scene.instancing.flattened_bytes, options.budget_bytes);
    EXPECT_EQ(scene.instancing.budget_bytes, options.budget_bytes);
    EXPECT_LT(scene.instancing.chosen_ns, scene.instancing.all_kept_ns);
    EXPECT_GT(scene.instancing.chosen_ns, scene.instancing.all_flattened_ns);
    ASSERT_EQ(scene.static_instances.size(), 8u);
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.static_triangles(), before.static_triangles());
    EXPECT_EQ(scene.batch_triangles(), 4u + 4);
    expect_objects_cover(scene);
    for (std::size_t m = 0; m < 2; ++m) {
        const SceneMesh &now = scene.meshes[m], &then = before.meshes[m];
        ASSERT_EQ(now.indices.size(), then.indices.size());
        EXPECT_EQ(now.bounds, then.bounds);
        for (std::size_t i = 0; i < now.indices.size(); ++i) {
            const VertexPool &pool = scene.pools[now.pool], &old = before.pools[then.pool];
            EXPECT_EQ(pool.positions[now.indices[i]], old.positions[then.indices[i]]);
            if (!pool.colours.empty()) {
                EXPECT_EQ(pool.colours[now.indices[i]], old.colours[then.indices[i]]);
            }
        }
    }
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(scene.static_instances[i].mesh, before.static_instances[i].mesh);
        EXPECT_EQ(scene.static_instances[i].scene_from_mesh, before.static_instances[i].scene_from_mesh);
    }
}

TEST(StaticInstances, settling_again_or_without_instances_changes_nothing) {
    Scene scene = scene_of(Way::Direct);
    const Scene before = scene;
    ASSERT_TRUE(settle_instances(scene, {}).ok());
    EXPECT_EQ(scene.instancing.all_flattened_bytes, 0u);
    EXPECT_EQ(scene.vertex_count(), before.vertex_count());
    expect_same_triangles(scene, before);
}

TEST(StaticInstances, scene_without_a_batch_may_be_all_instances) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    const MeshId one = builder.add_mesh(material, {kPositions, {}, {}, kIndices}).value();
    for (const glm::dmat4& place : places()) EXPECT_TRUE(builder.add_instance(one, place));
    Scene scene = builder.finish("instances").value();
    EXPECT_TRUE(scene.batches.empty());
    EXPECT_FALSE(scene.bounds().is_empty());
    ASSERT_TRUE(settle_instances(scene, {InstancePolicy::Flatten, {}, 0}).ok());
    ASSERT_EQ(scene.batches.size(), 1u);
    EXPECT_EQ(scene.static_triangles(), 16u);
    EXPECT_TRUE(scene.meshes.empty());
}

TEST(StaticInstances, more_memory_than_is_free_is_told_before_anything_is_changed) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    std::vector<glm::vec3> positions(300'000, glm::vec3(1));
    std::vector<std::uint32_t> indices(positions.size());
    std::iota(indices.begin(), indices.end(), 0u);
    const MeshId large = builder.add_mesh(material, {positions, {}, {}, indices}).value();
    for (int i = 0; i < 100; ++i) builder.add_instance(large, glm::dmat4(1.0));
    Scene scene = builder.finish("large").value();
    const StaticInstance one = scene.static_instances[0];
    scene.static_instances.resize(300'000, one);
    const Status status = settle_instances(scene, {InstancePolicy::Flatten, {}, 0});
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().message.find("large, its instances flattened, needs about"), std::string::npos);
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.static_instances.size(), 300'000u);
    // Left to choose, it keeps what does not fit.
    ASSERT_TRUE(settle_instances(scene, {InstancePolicy::Auto, {0.25, 1e9}, kUnlimited}).ok());
    EXPECT_EQ(scene.instancing.flattened_meshes, 0u);
    EXPECT_LT(scene.instancing.budget_bytes, kUnlimited);
}

TEST(StaticInstances, meshes_are_measured_by_the_vertices_they_use) {
    const std::vector<RepeatedMesh> repeated = repeated_meshes(scene_of(Way::Instances));
    ASSERT_EQ(repeated.size(), 3u);
    EXPECT_EQ(repeated[0].vertices, 4u);
    EXPECT_EQ(repeated[2].vertices, 3u);
    EXPECT_EQ(repeated[2].triangles, 1u);
    EXPECT_EQ(repeated[2].placements, 4u);
    EXPECT_EQ(repeated[0].bytes_per_vertex, 16u);
    EXPECT_FALSE(repeated[0].two_sided);
    EXPECT_TRUE(repeated[1].two_sided);
}

TEST(StaticInstances, places_that_can_not_be_drawn_through_are_refused) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    const MeshId one = builder.add_mesh(material, {kPositions, {}, {}, kIndices}).value();
    glm::dmat4 sheared(1.0), projective(1.0), unknown(1.0), flat(1.0);
    sheared[1][0] = 5.0;
    projective[2][3] = 0.1;
    unknown[3][1] = std::nan("");
    flat[2] = flat[0];
    const glm::dmat4 identity(1.0);
    for (const glm::dmat4& place :
         {sheared, projective, unknown, flat, glm::scale(identity, glm::dvec3(1, 0, 1)),
          glm::scale(identity, glm::dvec3(1e-30)), glm::translate(identity, glm::dvec3(1e300, 0, 0)),
          glm::translate(identity, glm::dvec3(1e39, 0, 0))})
        EXPECT_FALSE(builder.add_instance(one, place));
    glm::dmat4 bent(1.0);
    bent[1][0] = 0.5;
    const glm::dmat4 unequal =
        glm::rotate(glm::scale(glm::rotate(identity, 1.0, glm::dvec3(1, 1, 1)), glm::dvec3(-100, 0.01, 1)),
                    0.0, glm::dvec3(0, 1, 0));
    EXPECT_TRUE(builder.add_instance(one, bent));
    EXPECT_TRUE(builder.add_instance(one, unequal));
    EXPECT_EQ(builder.finish("few")->static_instances.size(), 2u);
}

TEST(PackedNormal, unpacks_to_what_was_packed) {
    std::mt19937 random(3);
    for (int i = 0; i < 1000; ++i) {
        glm::vec3 n;
        for (int c = 0; c < 3; ++c) n[c] = static_cast<float>(random() % 2001) / 1000.0f - 1.0f;
        if (glm::length(n) < 0.1f) continue;
        n = glm::normalize(n);
        EXPECT_LT(glm::length(unpack_normal(pack_normal(n)) - n), 0.9f / 511);
        EXPECT_EQ(pack_normal(unpack_normal(pack_normal(n))), pack_normal(n));
    }
    EXPECT_EQ(unpack_normal(PackedNormal{0x200}).x, -1.0f);  // -512: beyond -1
}

}  // namespace
}  // namespace rhview
