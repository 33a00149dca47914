// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/scene_builder.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace rhview {
namespace {

const std::array<glm::vec3, 4> kPositions{glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0),
                                          glm::vec3(9, 9, 9)};
const std::array<glm::vec3, 4> kNormals{glm::vec3(0, 0, 1), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1),
                                        glm::vec3(0, 0, 1)};
const std::array<std::uint32_t, 3> kIndices{0, 1, 2};

MeshPiece triangle(bool normals = false) {
    MeshPiece piece;
    piece.positions = kPositions;
    if (normals) piece.normals = kNormals;
    piece.indices = kIndices;
    return piece;
}

glm::vec3 face_normal(const Scene& scene, const SceneBatch& batch, std::size_t first) {
    const auto& p = scene.pools[batch.pool].positions;
    const glm::vec3 a = p[batch.indices[first]], b = p[batch.indices[first + 1]],
                    c = p[batch.indices[first + 2]];
    return glm::normalize(glm::cross(b - a, c - a));
}

TEST(SceneBuilder, objects_of_one_material_share_a_batch_and_unused_vertices_are_left_out) {
    SceneBuilder builder;
    const MaterialId red = builder.add_material({});
    const MaterialId blue = builder.add_material({});
    builder.add_static(red, triangle());
    builder.add_static(blue, triangle());
    builder.add_static(red, triangle(), glm::translate(glm::dmat4(1.0), glm::dvec3(5, 0, 0)));
    const Result<Scene> scene = builder.finish("two");
    ASSERT_TRUE(scene.ok());
    ASSERT_EQ(scene->batches.size(), 2u);
    EXPECT_EQ(scene->batches[0].material, red);
    ASSERT_EQ(scene->batches[0].objects.size(), 2u);
    EXPECT_EQ(scene->batches[0].objects[1].first_index, 3u);
    EXPECT_EQ(scene->batches[0].objects[1].bounds, (Aabb{glm::vec3(5, 0, 0), glm::vec3(6, 1, 0)}));
    EXPECT_EQ(scene->vertex_count(), 9u);
    EXPECT_EQ(scene->static_triangles(), 3u);
}

TEST(SceneBuilder, vertex_formats_get_their_own_pool_and_batch) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    builder.add_static(material, triangle(false));
    builder.add_static(material, triangle(true));
    const Result<Scene> scene = builder.finish("formats");
    ASSERT_TRUE(scene.ok());
    EXPECT_EQ(scene->pools.size(), 2u);
    EXPECT_EQ(scene->batches.size(), 2u);
    EXPECT_TRUE(scene->pools[0].normals.empty());
    EXPECT_EQ(scene->pools[1].normals.size(), 3u);
}

TEST(SceneBuilder, mirrored_triangle_keeps_its_outside_outside) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    builder.add_static(material, triangle(true), glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1)));
    const Result<Scene> scene = builder.finish("mirrored");
    ASSERT_TRUE(scene.ok());
    const SceneBatch& batch = scene->batches[0];
    EXPECT_GT(face_normal(*scene, batch, 0).z, 0.99f);
    EXPECT_EQ(scene->pools[batch.pool].normals[0], pack_normal({0, 0, 1}));
    // The first corner stays first: depths are interpolated in the same order.
    EXPECT_EQ(scene->pools[batch.pool].positions[batch.indices[0]], glm::vec3(0, 0, 0));
}

TEST(SceneBuilder, normals_survive_non_uniform_scale) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    const glm::dmat4 map = glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(1, 0, 0)) *
                           glm::scale(glm::dmat4(1.0), glm::dvec3(5, 0.1, 3));
    builder.add_static(material, triangle(true), map);
    const Result<Scene> scene = builder.finish("scaled");
    ASSERT_TRUE(scene.ok());
    EXPECT_EQ(scene->pools[0].normals[0], pack_normal(face_normal(*scene, scene->batches[0], 0)));
}

TEST(SceneBuilder, triangles_that_are_not_finite_are_dropped_counted_and_reported) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    std::array<glm::vec3, 4> positions = kPositions;
    positions[3].y = std::numeric_limits<float>::quiet_NaN();
    const std::array<std::uint32_t, 6> indices{0, 1, 2, 0, 2, 3};
    builder.add_static(material, {positions, {}, {}, indices});
    const Result<Scene> scene = builder.finish("nan");
    ASSERT_TRUE(scene.ok());
    EXPECT_EQ(scene->static_triangles(), 1u);
    EXPECT_EQ(scene->dropped_triangles, 1u);
    EXPECT_EQ(scene->vertex_count(), 3u);
    ASSERT_EQ(scene->warnings.size(), 1u);
    EXPECT_NE(scene->warnings[0].find("1 triangles"), std::string::npos);
}

TEST(SceneBuilder, scene_without_triangles_is_an_error) {
    SceneBuilder builder;
    builder.add_material({});
    const Result<Scene> scene = builder.finish("empty.glb");
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.error().message.rfind("empty.glb: ", 0), 0u);
}

TEST(SceneBuilder, positions_are_relative_to_the_origin) {
    SceneBuilder builder(glm::dvec3(1e7, 0, 0));
    const MaterialId material = builder.add_material({});
    builder.add_static(material, triangle(), glm::translate(glm::dmat4(1.0), glm::dvec3(1e7 + 0.25, 0, 0)));
    const MeshId mesh = builder.add_mesh(material, triangle()).value();
    builder.add_dynamic(mesh, glm::translate(glm::dmat4(1.0), glm::dvec3(1e7 + 4, 0, 0)));
    const Result<Scene> scene = builder.finish("far");
    ASSERT_TRUE(scene.ok());
    EXPECT_EQ(scene->batches[0].objects[0].bounds.min.x, 0.25f);
    EXPECT_NEAR(scene->bounds().max.x, 5.0f, 1e-5f);
    EXPECT_EQ(scene->dynamic_triangles(), 1u);
    EXPECT_EQ(scene->meshes[0].bounds.max, glm::vec3(1, 1, 0));
}

TEST(SceneBuilder, dropped_vertex_of_one_object_is_forgotten_by_the_next) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({});
    std::array<glm::vec3, 4> positions = kPositions;
    positions[1].x = std::numeric_limits<float>::infinity();
    builder.add_static(material, {positions, {}, {}, kIndices});
    builder.add_static(material, triangle());
    const Result<Scene> scene = builder.finish("reused");
    ASSERT_TRUE(scene.ok());
    EXPECT_EQ(scene->dropped_triangles, 1u);
    EXPECT_EQ(scene->static_triangles(), 1u);
    EXPECT_EQ(scene->pools[0].positions[1], kPositions[1]);
}

TEST(SceneBuilder, rooms_reserved_for_several_batches_of_a_pool_add_up) {
    SceneBuilder builder;
    const MaterialId red = builder.add_material({});
    const MaterialId blue = builder.add_material({});
    builder.reserve(red, true, false, 300, 3);
    builder.reserve(blue, true, false, 500, 3);
    builder.add_static(red, triangle(true));
    Result<Scene> scene = builder.finish("reserved");
    ASSERT_TRUE(scene.ok());
    EXPECT_EQ(scene->pools[0].positions.own().capacity(), 800u);
    EXPECT_EQ(scene->pools[0].normals.own().capacity(), 800u);
}

TEST(PackedNormal, components_are_ten_signed_bits_from_x_up) {
    EXPECT_EQ(pack_normal({1, 0, -1}), PackedNormal{511u | ((-511u & 0x3ffu) << 20)});
}

TEST(PackedColour, red_is_the_low_byte) {
    EXPECT_EQ(pack_colour({1, 0, 0.5f}), PackedColour{0xff8000ffu});
}

}  // namespace
}  // namespace rhview
