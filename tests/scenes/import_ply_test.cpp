// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <random>

#include "import_test_files.h"

namespace rhview {
namespace {

std::string header(const std::string& format, const std::string& body) {
    return "ply\nformat " + format + " 1.0\ncomment made for a test\n" + body + "end_header\n";
}

/// Writes values in a format: text, or bytes in either order.
struct Values {
    explicit Values(std::string format_name) : format(std::move(format_name)) {}

    template <class T>
    Values& add(T value) {
        if (format == "ascii") {
            bytes += std::to_string(value) + " ";
            return *this;
        }
        std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
        if (format == "binary_big_endian") std::reverse(raw.begin(), raw.end());
        bytes += raw;
        return *this;
    }

    std::string format, bytes;
};

const std::vector<std::string> kFormats{"ascii", "binary_little_endian", "binary_big_endian"};

/// A cube of quads with every kind of element and property that a reader must get past.
std::string cube_ply(const std::string& format) {
    Values values(format);
    for (int i = 0; i < 2; ++i)
        values.add<std::uint8_t>(2).add<std::int16_t>(-4).add<std::int16_t>(5).add(1.5);
    for (int i = 0; i < 8; ++i) {
        const int x = i == 1 || i == 2 || i == 5 || i == 6, y = i % 4 >= 2, z = i >= 4;
        values.add(float(x)).add(double(y)).add(std::int32_t(z)).add<std::uint16_t>(77);
        values.add<std::uint8_t>(255).add<std::uint8_t>(0).add<std::uint8_t>(51);
        values.add(0.0f).add(0.0f).add(1.0f);
    }
    const int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                             {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    for (const auto& face : faces) {
        values.add<std::uint8_t>(9).add<std::uint8_t>(4);
        for (const int corner : face) values.add<std::int32_t>(corner);
    }
    return header(format,
                  "element camera 2\nproperty list uchar short tags\nproperty double focal\n"
                  "element vertex 8\nproperty float x\nproperty float64 y\nproperty int z\nproperty ushort "
                  "quality\n"
                  "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                  "property float nx\nproperty float ny\nproperty float nz\n"
                  "element face 6\nproperty uint8 flags\nproperty list uint8 int32 vertex_indices\n") +
           values.bytes;
}

std::string triangle_ply(const std::string& faces,
                         const std::string& vertices = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n") {
    return header("ascii",
                  "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                  "element face 2\nproperty list uchar int vertex_index\n") +
           vertices + faces;
}

TEST(ImportPly, cube_is_the_same_in_every_format) {
    const TestFolder folder;
    for (const std::string& format : kFormats) {
        const Result<Scene> scene = folder.import("cube.ply", cube_ply(format));
        ASSERT_TRUE(scene.ok()) << scene.error().message;
        EXPECT_EQ(scene->static_triangles(), 12u);
        EXPECT_EQ(scene->vertex_count(), 8u);
        EXPECT_NEAR(signed_volume(*scene), 1.0, 1e-9) << format;
        EXPECT_EQ(scene->pools[0].colours[5], pack_colour({1.0f, 0.0f, 0.2f}));
        EXPECT_EQ(scene->pools[0].normals[5], pack_normal({0, 0, 1}));
    }
}

TEST(ImportPly, far_away_doubles_lose_nothing) {
    const TestFolder folder;
    Values values("binary_little_endian");
    for (const glm::dvec3& p : {glm::dvec3(0, 0, 0), glm::dvec3(0.125, 0, 0), glm::dvec3(0, 0.125, 0)})
        values.add(5e8 + p.x).add(p.y).add(-7e8 + p.z);
    values.add<std::uint8_t>(3).add<std::int32_t>(0).add<std::int32_t>(1).add<std::int32_t>(2);
    const Result<Scene> scene = folder.import(
        "far.ply", header(values.format,
                          "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                          "element face 1\nproperty list uchar int vertex_indices\n") +
                       values.bytes);
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->origin, glm::dvec3(5e8, 0, -7e8));
    EXPECT_EQ(scene->bounds(), (Aabb{glm::vec3(0), glm::vec3(0.125f, 0.125f, 0)}));
}

TEST(ImportPly, vertices_that_are_not_finite_drop_their_triangles) {
    const TestFolder folder;
    for (const char* bad : {"nan 0 0\n", "0 -inf 0\n", "0 0 1e999\n"}) {
        const Result<Scene> scene = folder.import(
            "nan.ply", triangle_ply("3 0 1 2\n3 1 3 2\n", std::string("0 0 0\n1 0 0\n0 1 0\n") + bad));
        ASSERT_TRUE(scene.ok()) << scene.error().message;
        EXPECT_EQ(scene->static_triangles(), 1u) << bad;
        EXPECT_EQ(scene->dropped_triangles, 1u) << bad;
    }
}

TEST(ImportPly, bad_faces_and_values_are_named) {
    const TestFolder folder;
    expect_error(folder.import("a.ply", triangle_ply("3 0 1 2\n3 0 1 4\n")),
                 "a.ply: face 1: index 4 is out of range (there are 4 vertices); export it again");
    expect_error(folder.import("a.ply", triangle_ply("3 0 1 -2\n3 0 1 2\n")), "face 0: index -2");
    expect_error(folder.import("a.ply", triangle_ply("3 0 1 0.5\n3 0 1 2\n")), "face 0: index 0.5");
    expect_error(folder.import("a.ply", triangle_ply("3 0 1 2\n")), "face 1 of 2: the data end");
    expect_error(folder.import("a.ply", triangle_ply("3 0 1 2\n-3 0 1 2\n")), "face 1 of 2");
    expect_error(folder.import("a.ply", triangle_ply("3 0 1 2\n2000000000 0 1 2\n")), "face 1 of 2");
    expect_error(folder.import("a.ply", triangle_ply("3 0 1 2\n3 0 1 two\n")), "face 1 of 2");
    expect_error(folder.import("a.ply", triangle_ply("2 0 1\n1 0      \n")), "no triangle to draw");
    const Result<Scene> scene = folder.import("a.ply", triangle_ply("3 0 1 2\n2 0 1\n"));
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->warnings.size(), 1u);
}

TEST(ImportPly, bad_headers_are_named) {
    const TestFolder folder;
    const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
    const std::vector<std::pair<std::string, const char*>> cases{
        {"plyx\n", "does not begin with 'ply'"},
        {"ply\nformat ascii 1.0\nelement vertex 3\n", "the header does not end"},
        {"ply\nelement vertex 3\nend_header\n", "the header names no format"},
        {header("binary_middle_endian", ""), "header line 2 ('format binary_middle_endian 1.0') is not PLY"},
        {header("ascii", "element vertex -3\n"), "header line 4"},
        {header("ascii", "property float x\n"), "header line 4"},
        {header("ascii", "element vertex 3\nproperty half x\n"), "header line 5"},
        {header("ascii", "element vertex 3\nproperty list float int x\n"), "header line 5"},
        {header("ascii", "element vertex 18446744073709551615\n" + xyz + faces), "the file has room for"},
        {header("binary_little_endian", "element vertex 4000000000\n" + xyz + faces),
         "the file has room for"},
        {header("ascii", "element vertex 1\n" + xyz) + "0 0 0\n", "export it as a mesh, not as points"},
        {header("ascii", "element vertex 1\nproperty float x\n" + faces) + "0\n1 0 \n",
         "vertices have no x, y and z"},
        {header("ascii", "element vertex 1\n" + xyz + "element face 0\nproperty int a\n") + "0 0 0\n",
         "no list 'vertex_indices'"},
        {header("ascii",
                "element vertex 0\n" + xyz + "element face 0\nproperty list uchar int vertex_indices\n"),
         "no triangle to draw"},
    };
    for (const auto& [bytes, sentence] : cases) expect_error(folder.import("a.ply", bytes), sentence);
}

TEST(ImportPly, every_truncation_gives_an_error_except_within_the_last_number) {
    const TestFolder folder;
    for (const std::string& format : kFormats) {
        const std::string whole = cube_ply(format);
        // Text ends in "7 ": without the blank the file is whole.
        const std::size_t complete = whole.size() - (format == "ascii" ? 1 : 0);
        for (std::size_t length = 1; length < complete; ++length) {
            const Result<Scene> scene = folder.import("cut.ply", std::string_view(whole).substr(0, length));
            ASSERT_FALSE(scene.ok()) << format << " " << length;
            expect_sound(scene, folder.path() / "cut.ply");
        }
    }
}

TEST(ImportPly, random_bytes_give_an_error_or_a_sound_scene) {
    const TestFolder folder;
    std::mt19937 random(4242);
    int scenes = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string bytes = cube_ply(kFormats[static_cast<std::size_t>(round) % 3]);
        for (auto flips = 1 + random() % 3; flips > 0; --flips)
            bytes[random() % bytes.size()] =
                static_cast<char>(round % 2 == 0 ? '0' + random() % 10 : random());
        const Result<Scene> scene = folder.import("flipped.ply", bytes);
        scenes += scene.ok() ? 1 : 0;
        expect_sound(scene, folder.path() / "flipped.ply");
        if (HasFatalFailure()) FAIL() << "round " << round;
    }
    EXPECT_GT(scenes, 100);
    EXPECT_LT(scenes, 2900);
}

}  // namespace
}  // namespace rhview
