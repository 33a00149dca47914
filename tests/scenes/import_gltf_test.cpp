// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <set>

#include "import_test_files.h"
#include "rhview/scenes/static_instances.h"

namespace rhview {
namespace {

nlohmann::json& primitive_of(GltfFile& file) {
    return file.json["meshes"][0]["primitives"][0];
}

/// A unit square in z = 0, seen from +z, as corners 0 … 3 counter-clockwise.
GltfFile square_gltf() {
    GltfFile file;
    file.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, kFloat, "VEC3", 4);
    file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}};
    return file;
}

/// Sum of the triangles' area vectors.
glm::dvec3 area_of(const Scene& scene) {
    glm::dvec3 area(0.0);
    for (const SceneBatch& batch : scene.batches) {
        const auto& p = scene.pools[batch.pool].positions;
        for (std::size_t i = 0; i < batch.indices.size(); i += 3) {
            const glm::dvec3 a(p[batch.indices[i]]), b(p[batch.indices[i + 1]]), c(p[batch.indices[i + 2]]);
            area += 0.5 * glm::cross(b - a, c - a);
        }
    }
    return area;
}

TEST(ImportGltf, cube_has_twelve_triangles_and_eight_vertices) {
    const TestFolder folder;
    const Result<Scene> scene = folder.import("cube.glb", cube_gltf().bytes());
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->name, "cube");
    EXPECT_EQ(scene->static_triangles(), 12u);
    EXPECT_EQ(scene->vertex_count(), 8u);
    EXPECT_EQ(scene->static_objects(), 1u);
    EXPECT_EQ(scene->origin, glm::dvec3(0.0));
    EXPECT_EQ(scene->bounds(), (Aabb{glm::vec3(0), glm::vec3(1)}));
    EXPECT_NEAR(signed_volume(*scene), 1.0, 1e-9);
    EXPECT_TRUE(scene->warnings.empty());
}

TEST(ImportGltf, mirrored_nodes_keep_the_outside_outside) {
    const TestFolder folder;
    const std::vector<nlohmann::json> transforms = {
        {{"scale", {-2, 1, 1}}},
        {{"scale", {-1, -1, -2}}, {"rotation", {0, 0.6, 0, 0.8}}, {"translation", {5, 0, 0}}},
        {{"matrix", {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 2, 0, 7, 8, 9, 1}}}};
    for (const nlohmann::json& transform : transforms) {
        GltfFile file = cube_gltf();
        file.json["nodes"][0].update(transform);
        const Result<Scene> scene = folder.import("mirrored.glb", file.bytes());
        ASSERT_TRUE(scene.ok()) << scene.error().message;
        EXPECT_NEAR(signed_volume(*scene), 2.0, 1e-4) << transform;
    }
}

TEST(ImportGltf, strips_fans_and_missing_indices_keep_the_front_in_front) {
    const TestFolder folder;
    struct Case {
        int mode;
        std::vector<int> corners;  ///< empty: no indices
        std::uint64_t triangles;
        double area;
    };
    const std::vector<Case> cases{{4, {0, 1, 2, 0, 2, 3}, 2, 1.0},
                                  {5, {1, 2, 0, 3}, 2, 1.0},
                                  {6, {}, 2, 1.0},
                                  {4, {}, 1, 0.5},
                                  {5, {1, 2, 0, 0, 0, 3, 0, 0}, 1, 0.5}};
    for (const Case& c : cases) {
        GltfFile file = square_gltf();
        primitive_of(file)["mode"] = c.mode;
        if (!c.corners.empty()) {
            file.json["bufferViews"].push_back(
                {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", c.corners.size()}});
            for (const int corner : c.corners) file.binary += static_cast<char>(corner);
            file.json["accessors"].push_back({{"bufferView", 1},
                                              {"componentType", kUnsignedByte},
                                              {"count", c.corners.size()},
                                              {"type", "SCALAR"}});
            primitive_of(file)["indices"] = 1;
        }
        const Result<Scene> scene = folder.import("modes.glb", file.bytes());
        ASSERT_TRUE(scene.ok()) << scene.error().message;
        EXPECT_EQ(scene->static_triangles(), c.triangles) << c.mode;
        EXPECT_NEAR(area_of(*scene).z, c.area, 1e-9) << c.mode;
        EXPECT_EQ(scene->warnings.size(), c.mode == 4 && c.corners.empty() ? 1u : 0u);
    }
}

TEST(ImportGltf, points_and_lines_are_left_out_with_one_warning) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    for (const int mode : {0, 1, 3}) {
        nlohmann::json primitive = primitive_of(file);
        primitive["mode"] = mode;
        file.json["meshes"][0]["primitives"].push_back(primitive);
    }
    const Result<Scene> scene = folder.import("lines.glb", file.bytes());
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->static_triangles(), 12u);
    ASSERT_EQ(scene->warnings.size(), 1u);
    EXPECT_EQ(scene->warnings[0].rfind("3 primitives", 0), 0u);
}

TEST(ImportGltf, index_types_strides_and_quantised_positions_are_read) {
    const TestFolder folder;
    {
        GltfFile file;
        file.add<float>({0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9}, kFloat, "VEC3", 3, false, 16);
        file.add<std::uint32_t>({0, 1, 2}, kUnsignedInt, "SCALAR", 3);
        file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
        const Result<Scene> scene = folder.import("strided.glb", file.bytes());
        ASSERT_TRUE(scene.ok()) << scene.error().message;
        EXPECT_EQ(scene->bounds(), (Aabb{glm::vec3(0), glm::vec3(1, 1, 0)}));
    }
    {
        GltfFile file;
        file.add<std::int16_t>({-32768, -32767, 0, 0, 32767, 0, 0, 16384, 0, 0, 0, 0}, kShort, "VEC3", 3,
                               true, 8);
        file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}};
        file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
        const Result<Scene> scene = folder.import("quantised.glb", file.bytes());
        ASSERT_TRUE(scene.ok()) << scene.error().message;
        EXPECT_EQ(scene->bounds().min, glm::vec3(-1, -1, 0));
        EXPECT_EQ(scene->pools[0].positions[1], glm::vec3(1, 0, 0));
    }
    {
        GltfFile file;
        file.add<std::uint8_t>({0, 0, 0, 0, 200, 0, 0, 0, 0, 255, 0, 0}, kUnsignedByte, "VEC3", 3, false, 4);
        file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}};
        const Result<Scene> scene = folder.import("bytes.glb", file.bytes());
        ASSERT_TRUE(scene.ok()) << scene.error().message;
        EXPECT_EQ(scene->bounds().max, glm::vec3(200, 255, 0));
    }
}

TEST(ImportGltf, sparse_accessor_replaces_its_base_and_a_missing_base_is_zero) {
    const TestFolder folder;
    for (const bool base : {true, false}) {
        GltfFile file;
        file.add<float>({0, 0, 5, 1, 0, 5, 0, 1, 5}, kFloat, "VEC3", 3);
        const std::size_t at = file.binary.size();
        append<std::uint16_t>(file.binary, {2, 0});
        append<float>(file.binary, {0, 7, 1});
        file.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", 2}});
        file.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at + 4}, {"byteLength", 12}});
        file.json["accessors"][0]["sparse"] = {
            {"count", 1},
            {"indices", {{"bufferView", 1}, {"componentType", kUnsignedShort}}},
            {"values", {{"bufferView", 2}}}};
        if (!base) file.json["accessors"][0].erase("bufferView");
        file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}};
        const Result<Scene> scene = folder.import("sparse.glb", file.bytes());
        ASSERT_TRUE(scene.ok()) << scene.error().message;
        EXPECT_EQ(scene->pools[0].positions[2], glm::vec3(0, 7, 1));
        EXPECT_EQ(scene->pools[0].positions[1], base ? glm::vec3(1, 0, 5) : glm::vec3(0));
    }
}

TEST(ImportGltf, node_transforms_compose_and_every_primitive_becomes_an_object) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    file.json["meshes"][0]["primitives"].push_back(primitive_of(file));
    file.json["nodes"] = {{{"children", {1, 2}}, {"translation", {10, 0, 0}}},
                          {{"mesh", 0}, {"scale", {2, 2, 2}}},
                          {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1}}},
                          {{"mesh", 0}, {"translation", {1000, 0, 0}}}};
    const Result<Scene> scene = folder.import("tree.glb", file.bytes());
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    ASSERT_EQ(scene->static_objects(), 4u);
    EXPECT_EQ(scene->batches[0].objects[0].bounds, (Aabb{glm::vec3(10, 0, 0), glm::vec3(12, 2, 2)}));
    EXPECT_EQ(scene->batches[0].objects[2].bounds, (Aabb{glm::vec3(10, 5, 0), glm::vec3(11, 6, 1)}));
}

TEST(ImportGltf, meshes_placed_repeatedly_are_stored_once_on_request) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    file.json["meshes"].push_back(file.json["meshes"][0]);
    // Twice where it can be drawn from its own space, once mirrored; flat and sheared; the second mesh once.
    file.json["nodes"] = {{{"mesh", 0}, {"translation", {10, 0, 0}}},
                          {{"mesh", 0}, {"scale", {-1, 2, 1}}},
                          {{"mesh", 0}, {"scale", {1, 0, 1}}},
                          {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 9, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}},
                          {{"mesh", 1}, {"translation", {0, 5, 0}}}};
    file.json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4};
    const std::filesystem::path path = folder.write("repeated.glb", file.bytes());
    const Result<Scene> flat = import_scene(path);
    Result<Scene> kept = import_scene(path, RepeatedMeshes::Keep);
    ASSERT_TRUE(flat.ok() && kept.ok());
    expect_sound(kept, path);
    EXPECT_TRUE(flat->static_instances.empty());
    EXPECT_EQ(kept->static_instances.size(), 2u);
    EXPECT_EQ(kept->meshes.size(), 1u);
    EXPECT_EQ(kept->static_triangles(), flat->static_triangles());
    EXPECT_EQ(kept->static_objects(), flat->static_objects());
    EXPECT_EQ(kept->batch_triangles(), 3u * 12);
    EXPECT_EQ(kept->vertex_count(), 4u * 8);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(kept->bounds().min[axis], flat->bounds().min[axis], 1e-5f);
        EXPECT_NEAR(kept->bounds().max[axis], flat->bounds().max[axis], 1e-5f);
    }
    ASSERT_TRUE(settle_instances(*kept, {InstancePolicy::Flatten, {}, 0}).ok());
    EXPECT_NEAR(signed_volume(*kept), signed_volume(*flat), 1e-4);
    EXPECT_NEAR(signed_volume(*kept), 1.0 + 2.0 + 0.0 + 1.0 + 1.0, 1e-4);
    EXPECT_EQ(kept->static_objects(), 5u);
}

TEST(ImportGltf, instances_of_a_mesh_without_a_finite_triangle_are_nothing) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    file.add<float>({nan, 0, 0, 0, nan, 0, 0, 0, nan}, kFloat, "VEC3", 3);
    file.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 2}}}}}}});
    file.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 1}}, {{"mesh", 1}}};
    file.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Result<Scene> scene = import_scene(folder.write("holes.glb", file.bytes()), RepeatedMeshes::Keep);
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_TRUE(scene->static_instances.empty());
    EXPECT_EQ(scene->static_triangles(), 12u);
    EXPECT_EQ(scene->dropped_triangles, 1u);
}

TEST(ImportGltf, default_scene_else_the_first_else_all_roots_are_read) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    file.json["nodes"].push_back({{"mesh", 0}, {"translation", {3, 0, 0}}});
    file.json["nodes"].push_back({{"mesh", 0}, {"translation", {7, 0, 0}}});
    file.json["scenes"] = {{{"nodes", {1}}}, {{"nodes", {2}}}};
    file.json["scene"] = 1;
    EXPECT_EQ(folder.import("scene.glb", file.bytes())->bounds().min.x, 7.0f);
    file.json.erase("scene");
    EXPECT_EQ(folder.import("scene.glb", file.bytes())->bounds().min.x, 3.0f);
    file.json.erase("scenes");
    EXPECT_EQ(folder.import("scene.glb", file.bytes())->static_objects(), 3u);
}

TEST(ImportGltf, materials_keep_name_colour_and_flags) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    file.json["materials"] = {
        {{"name", "brick"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0.125, 1}}}}},
        {{"name", "leaf"}, {"doubleSided", true}, {"alphaMode", "MASK"}},
        {{"name", "glass"}, {"alphaMode", "BLEND"}}};
    nlohmann::json primitive = primitive_of(file);
    for (int material = 0; material < 3; ++material) {
        primitive["material"] = material;
        file.json["meshes"][0]["primitives"].push_back(primitive);
    }
    const Result<Scene> scene = folder.import("materials.glb", file.bytes());
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    ASSERT_EQ(scene->materials.size(), 4u);  // the first primitive names none
    EXPECT_EQ(scene->materials[0].name, "brick");
    EXPECT_EQ(scene->materials[0].colour, glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_FALSE(scene->materials[0].two_sided || scene->materials[0].alpha_tested);
    EXPECT_TRUE(scene->materials[1].two_sided && scene->materials[1].alpha_tested);
    EXPECT_EQ(scene->materials[1].colour, glm::vec3(1.0f));
    EXPECT_TRUE(scene->materials[2].alpha_tested && !scene->materials[2].two_sided);
    EXPECT_EQ(scene->materials[3].name, "default");
    EXPECT_EQ(scene->batches.size(), 4u);
}

TEST(ImportGltf, white_materials_get_distinct_colours_and_a_single_one_stays_white) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    file.json["materials"] = nlohmann::json::array({{{"name", "only"}}});
    primitive_of(file)["material"] = 0;
    EXPECT_EQ(folder.import("one.glb", file.bytes())->materials[0].colour, glm::vec3(1.0f));
    for (int i = 0; i < 31; ++i) file.json["materials"].push_back({{"name", "another"}});
    const Result<Scene> scene = folder.import("many.glb", file.bytes());
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    std::set<std::uint32_t> colours;
    for (const Material& material : scene->materials) {
        colours.insert(static_cast<std::uint32_t>(pack_colour(material.colour)));
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(material.colour[c] > 0.1f && material.colour[c] < 0.7f);
    }
    EXPECT_EQ(colours.size(), 32u);
}

TEST(ImportGltf, normals_and_vertex_colours_are_kept_and_split_the_vertex_format) {
    const TestFolder folder;
    GltfFile file = square_gltf();
    const int normals = file.add<std::int8_t>({0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, kByte,
                                              "VEC3", 4, true, 4);
    const int colours =
        file.add<float>({1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 0.5f, 0.5f, 0.5f, 1}, kFloat, "VEC4", 4);
    nlohmann::json primitive = primitive_of(file);
    primitive["attributes"]["NORMAL"] = normals;
    primitive["attributes"]["COLOR_0"] = colours;
    file.json["meshes"][0]["primitives"].push_back(primitive);
    const Result<Scene> scene = folder.import("formats.glb", file.bytes());
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    ASSERT_EQ(scene->pools.size(), 2u);
    const VertexPool& pool = scene->pools[scene->pools[0].normals.empty() ? 1 : 0];
    ASSERT_EQ(pool.normals.size(), 3u);
    EXPECT_EQ(pool.normals[0], pack_normal({0, 0, 1}));
    EXPECT_EQ(pool.colours[1], pack_colour({0, 1, 0}));
}

TEST(ImportGltf, far_away_scene_gets_an_origin_and_loses_nothing) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    file.json["nodes"][0]["translation"] = {4000000.5, -200.0, 6000000.25};
    const Result<Scene> far = folder.import("far.glb", file.bytes());
    ASSERT_TRUE(far.ok()) << far.error().message;
    EXPECT_EQ(far->origin, glm::dvec3(4000001, -200, 6000001));
    EXPECT_EQ(far->bounds(), (Aabb{glm::vec3(-0.5, 0, -0.75), glm::vec3(0.5, 1, 0.25)}));
    EXPECT_NEAR(signed_volume(*far), 1.0, 1e-6);

    file.json["nodes"][0]["translation"] = {50.0, 0.0, 0.0};
    EXPECT_EQ(folder.import("near.glb", file.bytes())->origin, glm::dvec3(0.0));
    file.json["nodes"][0] = {{"mesh", 0}, {"scale", {70000, 1, 1}}};
    EXPECT_EQ(folder.import("long.glb", file.bytes())->origin, glm::dvec3(35000, 1, 1));
}

TEST(ImportGltf, triangles_under_a_transform_that_is_not_finite_are_dropped_and_counted) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    file.json["nodes"] = {{{"mesh", 0}, {"children", {1}}, {"scale", {1, 1, 1}}},
                          {{"scale", {1e300, 1, 1}}, {"children", {2}}},
                          {{"scale", {1e300, 1, 1}}, {"mesh", 0}}};
    const Result<Scene> scene = folder.import("infinite.glb", file.bytes());
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->static_triangles(), 12u);
    EXPECT_EQ(scene->dropped_triangles, 12u);
    EXPECT_EQ(scene->warnings.size(), 1u);
    EXPECT_EQ(scene->origin, glm::dvec3(0.0));
}

TEST(ImportGltf, nan_vertices_are_dropped_and_counted) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    const std::uint32_t nan = 0x7fc00000u;
    std::memcpy(file.binary.data() + 12, &nan, 4);  // vertex 1, in four triangles
    const Result<Scene> scene = folder.import("nan.glb", file.bytes());
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->static_triangles() + scene->dropped_triangles, 12u);
    EXPECT_EQ(scene->dropped_triangles, 4u);
    EXPECT_EQ(scene->vertex_count(), 7u);
}

TEST(ImportGltf, textures_are_never_needed) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    file.json["images"] = {{{"uri", "missing.png"}},
                           {{"bufferView", 0}, {"mimeType", "image/png"}},
                           {{"uri", "data:image/png;base64,AAAA"}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    primitive_of(file)["material"] = 0;
    const Result<Scene> scene = folder.import("textured.glb", file.bytes());
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->static_triangles(), 12u);
}

TEST(ImportGltf, text_form_reads_external_and_embedded_buffers) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    file.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", "my%20cube.bin"}}};
    static_cast<void>(folder.write("my cube.bin", file.binary));
    const Result<Scene> external = folder.import("cube.GLTF", file.json.dump());
    ASSERT_TRUE(external.ok()) << external.error().message;
    EXPECT_EQ(external->static_triangles(), 12u);

    GltfFile embedded;
    embedded.json["buffers"] = {{{"byteLength", 36},
                                 {"uri",
                                  "data:application/octet-stream;base64,"
                                  "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}};
    embedded.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}};
    embedded.json["accessors"] = {
        {{"bufferView", 0}, {"componentType", kFloat}, {"count", 3}, {"type", "VEC3"}}};
    embedded.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}};
    const Result<Scene> data = folder.import("embedded.gltf", embedded.json.dump());
    ASSERT_TRUE(data.ok()) << data.error().message;
    EXPECT_EQ(data->bounds().max, glm::vec3(1, 1, 0));
}

}  // namespace
}  // namespace rhview
