// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <sstream>

#include "import_test_files.h"

namespace rhview {
namespace {

const std::string kCubeVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
const std::string kCubeObj =
    "# a cube\n" + kCubeVertices + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST(ImportObj, cube_of_quads_is_closed_and_shares_its_vertices) {
    const TestFolder folder;
    const Result<Scene> scene = folder.import("cube.obj", kCubeObj);
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->name, "cube");
    EXPECT_EQ(scene->static_triangles(), 12u);
    EXPECT_EQ(scene->vertex_count(), 8u);
    EXPECT_NEAR(signed_volume(*scene), 1.0, 1e-9);
}

TEST(ImportObj, concave_polygon_keeps_its_area_from_any_first_corner) {
    const TestFolder folder;
    // An L of area 3, counter-clockwise, in each coordinate plane.
    const std::vector<glm::ivec2> corners{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t first = 0; first < corners.size(); ++first) {
            std::ostringstream vertices, face;
            face << "f";
            for (std::size_t i = 0; i < corners.size(); ++i) {
                glm::ivec3 v(0);
                v[(axis + 1) % 3] = corners[(first + i) % 6].x;
                v[(axis + 2) % 3] = corners[(first + i) % 6].y;
                vertices << "v " << v.x << " " << v.y << " " << v.z << "\n";
                face << " " << i + 1;
            }
            const Result<Scene> scene = folder.import("l.obj", vertices.str() + face.str() + "\n");
            ASSERT_TRUE(scene.ok()) << scene.error().message;
            ASSERT_EQ(scene->static_triangles(), 4u);
            const auto& p = scene->pools[0].positions;
            const auto& indices = scene->batches[0].indices;
            float area = 0.0f;
            for (std::size_t i = 0; i < indices.size(); i += 3) {
                const float part = 0.5f * glm::cross(p[indices[i + 1]] - p[indices[i]],
                                                     p[indices[i + 2]] - p[indices[i]])[axis];
                EXPECT_GT(part, 0.0f);
                area += part;
            }
            EXPECT_NEAR(area, 3.0f, 1e-6f);
        }
    }
}

TEST(ImportObj, normals_make_vertices_of_their_own_and_groups_make_objects) {
    const TestFolder folder;
    const Result<Scene> scene = folder.import("groups.obj",
                                              "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 -1\n"
                                              "g front\nf 1//1 2//1 3//1\nf 1/7/1 2/8/1 3/9/1\n"
                                              "g back\nf 1//2 3//2 2//2\no bare\nf -3 -2 -1\n");
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->static_objects(), 3u);
    EXPECT_EQ(scene->static_triangles(), 4u);
    ASSERT_EQ(scene->pools.size(), 2u);
    EXPECT_EQ(scene->pools[0].positions.size(), 6u);
    EXPECT_EQ(scene->pools[0].normals[3], pack_normal({0, 0, -1}));
    EXPECT_TRUE(scene->pools[1].normals.empty());
}

TEST(ImportObj, materials_come_from_the_mtl_file) {
    const TestFolder folder;
    static_cast<void>(
        folder.write("my.mtl",
                     "newmtl brick\nKd 0.5 0.25 0.125\nnewmtl leaf\nmap_Kd leaf.png\nmap_d leaf_a.png\n"
                     "newmtl glass\nKd 0 0 1\nd 0.5\n"));
    const Result<Scene> scene = folder.import(
        "m.obj",
        "mtllib my.mtl\n" + kCubeVertices +
            "usemtl leaf\nf 1 2 3\nusemtl brick\nf 1 2 3\nusemtl leaf\nf 1 2 4\nusemtl glass \nf 1 2 5\n");
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    ASSERT_EQ(scene->materials.size(), 3u);
    EXPECT_EQ(scene->materials[0].name, "brick");
    EXPECT_EQ(scene->materials[0].colour, glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_FALSE(scene->materials[0].alpha_tested);
    EXPECT_EQ(scene->materials[1].colour, glm::vec3(1.0f));
    EXPECT_TRUE(scene->materials[1].alpha_tested);
    EXPECT_TRUE(scene->materials[2].alpha_tested);
    EXPECT_EQ(scene->batches.size(), 3u);
    EXPECT_EQ(scene->static_objects(), 3u);
    EXPECT_TRUE(scene->warnings.empty());
}

TEST(ImportObj, missing_mtl_file_is_a_warning_and_its_materials_stay_apart) {
    const TestFolder folder;
    const Result<Scene> scene = folder.import(
        "m.obj", "mtllib gone.mtl\n" + kCubeVertices + "usemtl stone\nf 1 2 3\nusemtl wood\nf 1 2 4\n");
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    ASSERT_EQ(scene->materials.size(), 2u);
    EXPECT_EQ(scene->materials[1].name, "wood");
    EXPECT_NE(scene->materials[0].colour, scene->materials[1].colour);
    ASSERT_EQ(scene->warnings.size(), 1u);
    EXPECT_NE(scene->warnings[0].find("gone.mtl"), std::string::npos);
}

TEST(ImportObj, coordinates_that_are_no_numbers_drop_their_triangles) {
    const TestFolder folder;
    for (const char* bad : {"v 1 nan 0", "v inf 0 0", "v 1 0", "v one 0 0", "v 1e999 0 0"}) {
        const Result<Scene> scene = folder.import(
            "bad.obj", std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\n") + bad + "\nf 1 2 3\nf 1 2 4\n");
        ASSERT_TRUE(scene.ok()) << scene.error().message;
        EXPECT_EQ(scene->static_triangles(), 1u) << bad;
        EXPECT_EQ(scene->dropped_triangles, 1u) << bad;
    }
}

TEST(ImportObj, far_away_scene_gets_an_origin) {
    const TestFolder folder;
    const Result<Scene> scene =
        folder.import("far.obj", "v 1000000 0 0\nv 1000002 0 0\nv 1000000 2 0\nf 1 2 3\n");
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->origin, glm::dvec3(1000001, 1, 0));
    EXPECT_EQ(scene->bounds(), (Aabb{glm::vec3(-1, -1, 0), glm::vec3(1, 1, 0)}));
}

TEST(ImportObj, bad_faces_are_named) {
    const TestFolder folder;
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1 2 3\n";
    expect_error(folder.import("a.obj", triangle + "f 1 2 4\n"),
                 "a.obj: face 2: vertex index 4 is out of range (there are 3 so far); re-export the file");
    expect_error(folder.import("a.obj", triangle + "f 1 2 3 9\n"), "face 2: vertex index 9");
    expect_error(folder.import("a.obj", triangle + "f -1 -2 -4\n"), "face 2: vertex index -4");
    expect_error(folder.import("a.obj", triangle + "f 0 1 2\n"), "face 2: vertex index 0");
    expect_error(folder.import("a.obj", triangle + "f x y z\n"), "face 2: vertex index 0");
    expect_error(folder.import("a.obj", triangle + "f 1//1 2//2 3//1\n"), "face 2: normal index 2");
    expect_error(folder.import("a.obj", "v 0 0 0\n"), "no triangle to draw");
    expect_error(folder.import("a.obj", std::string("v 0 0 0\n\0\0\0", 11)), "the file is not text");
    const Result<Scene> scene = folder.import("a.obj", triangle + "f 1 2\n");
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    ASSERT_EQ(scene->warnings.size(), 1u);
    EXPECT_EQ(scene->warnings[0].rfind("1 faces", 0), 0u);
}

TEST(ImportObj, every_truncation_gives_an_error_or_a_sound_scene) {
    const TestFolder folder;
    const std::string whole =
        "v 0 0 0 1 0 0\nv 1.5e0 -0.25 +3\nv 0 1 0\nv 1 1 1\nvn 0 0 1\nvt 0 0\nusemtl a b\ng one two\n"
        "f 1/1/1 2/1/1 3/1/1\ns off\nf -4 -3 -2 -1\nl 1 2\np 1\n";
    for (std::size_t length = 1; length <= whole.size(); ++length)
        expect_sound(folder.import("cut.obj", std::string_view(whole).substr(0, length)),
                     folder.path() / "cut.obj");
    EXPECT_EQ(folder.import("whole.obj", whole)->static_triangles(), 3u);
}

}  // namespace
}  // namespace rhview
