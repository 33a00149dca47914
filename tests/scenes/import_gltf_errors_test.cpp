// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <functional>
#include <random>

#include "import_test_files.h"
#include "rhview/scenes/memory.h"

namespace rhview {
namespace {

using Json = nlohmann::json;

/// A small file that has something of everything the importer reads.
std::string rich_glb() {
    GltfFile file = cube_gltf();
    file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloat, "VEC3",
                    8);
    file.add<std::uint8_t>(
        {9, 9, 9, 9, 8, 8, 8, 8, 7, 7, 7, 7, 6, 6, 6, 6, 5, 5, 5, 5, 4, 4, 4, 4, 3, 3, 3, 3, 2, 2, 2, 2},
        kUnsignedByte, "VEC4", 8, true, 4);
    file.add<std::uint16_t>({1, 0}, kUnsignedShort, "SCALAR", 1);
    file.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", 4}, {"componentType", kUnsignedShort}}},
        {"values", {{"bufferView", 2}}}};
    file.json["materials"] = {{{"name", "a"}, {"alphaMode", "MASK"}, {"doubleSided", true}}, {{"name", "b"}}};
    file.json["meshes"][0]["primitives"] = {
        {{"attributes", {{"POSITION", 0}, {"NORMAL", 2}, {"COLOR_0", 3}}}, {"indices", 1}, {"material", 0}},
        {{"attributes", {{"POSITION", 0}}}, {"mode", 5}, {"material", 1}}};
    file.json["nodes"] = {{{"children", {1}}, {"rotation", {0, 0, 0, 1}}},
                          {{"mesh", 0}, {"scale", {-1, 1, 1}}}};
    return file.bytes();
}

TEST(ImportGltfErrors, what_is_wrong_in_the_json_is_named_with_its_place) {
    const TestFolder folder;
    struct Case {
        std::function<void(Json&)> spoil;
        const char* sentence;
    };
    const std::vector<Case> cases{
        {[](Json& j) { j["accessors"][0]["count"] = 6; },
         "mesh 0 primitive 0: index 7 is out of range (the primitive has 6 vertices); re-export the file"},
        {[](Json& j) { j["accessors"][0]["count"] = 9; },
         "POSITION: 9 elements of 12 bytes from byte 0 do not fit"},
        {[](Json& j) { j["accessors"][0]["byteOffset"] = 100; }, "do not fit in buffer view 0"},
        {[](Json& j) { j["accessors"][0]["byteOffset"] = 18446744073709551600u; },
         "do not fit in buffer view 0"},
        {[](Json& j) { j["accessors"][1]["count"] = 18446744073709551615u; }, "do not fit in buffer view 1"},
        {[](Json& j) { j["accessors"][0]["bufferView"] = 12; }, "buffer view 12 does not exist"},
        {[](Json& j) { j["accessors"][0]["bufferView"] = -7; }, "buffer view -7 does not exist"},
        {[](Json& j) { j["accessors"][0]["type"] = "VEC2"; }, "POSITION: must have three components"},
        {[](Json& j) { j["accessors"][0]["type"] = "MAT4"; }, "none of glTF's for vertices"},
        {[](Json& j) { j["accessors"][0]["componentType"] = 5128; }, "component type 5128"},
        {[](Json& j) { j["accessors"][1]["componentType"] = 5122; }, "indices must be unsigned"},
        {[](Json& j) { j["bufferViews"][0]["byteOffset"] = 4000; }, "buffer view 0 ends at byte 4000+96"},
        {[](Json& j) { j["bufferViews"][0]["byteLength"] = 18446744073709551615u; },
         "buffer view 0 ends at byte"},
        {[](Json& j) { j["bufferViews"][0]["buffer"] = 3; }, "buffer 3 does not exist"},
        {[](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 5; },
         "accessor 5 does not exist"},
        {[](Json& j) { j["meshes"][0]["primitives"][0]["attributes"] = 5; }, "not valid glTF"},
        {[](Json& j) { j["meshes"][0]["primitives"][0]["material"] = 0; }, "material 0 does not exist"},
        {[](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1; },
         "another length than POSITION"},
        {[](Json& j) { j["nodes"][0]["mesh"] = 1; }, "node 0: mesh 1 does not exist"},
        {[](Json& j) { j["nodes"][0]["children"] = {4}; }, "node 0: child 4 does not exist"},
        {[](Json& j) { j["nodes"][0]["children"] = {0}; }, "node 0 is below itself"},
        {[](Json& j) {
             j["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
         },
         "node 2 is a child of node 0 and of node 1"},
        {[](Json& j) {
             j["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}};
         },
         "below itself"},
        {[](Json& j) {
             j["nodes"][0]["matrix"] = {1, 2, 3};
         },
         "node 0: its transform has a wrong number of values"},
        {[](Json& j) {
             j["nodes"][0]["rotation"] = {1, 2, 3};
         },
         "node 0: its transform has a wrong number of values"},
        {[](Json& j) {
             j["scenes"][0]["nodes"] = {0, 0};
         },
         "scene 0: node 0 is listed twice"},
        {[](Json& j) { j["scenes"][0]["nodes"] = {3}; }, "scene 0: node 3 does not exist"},
        {[](Json& j) { j["scene"] = 2; }, "scene 2 does not exist"},
        {[](Json& j) { j["nodes"] = {Json::object()}; }, "no triangle to draw"},
        {[](Json& j) { j["asset"]["version"] = "1.0"; }, "this is glTF 1.0"},
        {[](Json& j) { j.erase("asset"); }, "not valid glTF"},
        {[](Json& j) { j["extensionsRequired"] = {"EXT_mesh_gpu_instancing"}; },
         "requires the extension EXT_mesh_gpu_instancing"},
        {[](Json& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
         "requires the extension KHR_draco_mesh_compression"},
        {[](Json& j) { j["extensionsRequired"] = {"EXT_meshopt_compression"}; },
         "requires the extension EXT_meshopt_compression"},
        {[](Json& j) {
             j["accessors"][0]["sparse"] = {{"count", 1},
                                            {"indices", {{"bufferView", 0}, {"componentType", kUnsignedInt}}},
                                            {"values", {{"bufferView", 1}, {"byteOffset", 70}}}};
         },
         "sparse values"},
    };
    for (const Case& c : cases) {
        GltfFile file = cube_gltf();
        c.spoil(file.json);
        const Result<Scene> scene = folder.import("castle.glb", file.bytes());
        expect_error(scene, c.sentence);
        if (!scene.ok()) expect_sound(scene, folder.path() / "castle.glb");
    }
}

TEST(ImportGltfErrors, extension_that_is_used_but_not_required_is_a_warning) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 0;
    const Result<Scene> scene = folder.import("instanced.glb", file.bytes());
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene->warnings.size(), 1u);
}

TEST(ImportGltfErrors, container_that_contradicts_itself_is_refused) {
    const TestFolder folder;
    const std::string whole = cube_gltf().bytes();
    const auto with_u32 = [&](std::size_t at, std::uint32_t value) {
        std::string bytes = whole;
        std::memcpy(bytes.data() + at, &value, 4);
        return bytes;
    };
    std::uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, whole.data() + 12, 4);
    const std::size_t second = 20 + json_bytes;
    expect_error(folder.import("a.glb", with_u32(4, 1)), "this is glTF 1");
    expect_error(folder.import("a.glb", with_u32(8, 100000)), "truncated (its header says 100000 bytes");
    expect_error(folder.import("a.glb", with_u32(8, 40)), "chunk 0 at byte 12 is longer than the file");
    expect_error(folder.import("a.glb", with_u32(12, 0xffffffffu)),
                 "chunk 0 at byte 12 is longer than the file");
    expect_error(folder.import("a.glb", with_u32(16, 7)), "the first chunk is not JSON");
    expect_error(folder.import("a.glb", with_u32(second, 0xfffffffcu)), "chunk 1 at byte");
    expect_error(folder.import("a.glb", with_u32(second, 64)), "is longer than the file");
    std::string broken = whole;
    broken[30] = '\n';
    broken[31] = '}';
    expect_error(folder.import("a.glb", broken), "not valid glTF (parse error");
    expect_error(folder.import("a.glb", "PK\3\4 this is no scene at all"), "not valid glTF");
}

TEST(ImportGltfErrors, deep_nesting_does_not_reach_the_end_of_the_stack) {
    const TestFolder folder;
    constexpr std::size_t kDepth = 200000;
    const std::string text = "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(kDepth, '[') +
                             std::string(kDepth, ']') + "}";
    expect_error(folder.import("deep.gltf", text), "nested too deeply");
    // Brackets in strings are no nesting.
    GltfFile file = cube_gltf();
    file.json["asset"]["generator"] = "\"\\" + std::string(500, '[');
    EXPECT_TRUE(folder.import("string.glb", file.bytes()).ok());
}

TEST(ImportGltfErrors, buffer_file_that_is_missing_or_short_is_named) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    file.json["buffers"] = {{{"byteLength", file.binary.size()}, {"uri", "cube.bin"}}};
    expect_error(folder.import("cube.gltf", file.json.dump()), "cube.bin is missing");
    static_cast<void>(folder.write("cube.bin", file.binary.substr(1)));
    expect_error(folder.import("cube.gltf", file.json.dump()), "cube.bin");
    file.json["buffers"] = {{{"byteLength", 1000000}}};
    expect_error(folder.import("short.glb", glb(file.json.dump(), file.binary)), "not valid glTF");
}

TEST(ImportGltfErrors, scene_larger_than_the_free_memory_is_refused_before_it_is_allocated) {
    const TestFolder folder;
    GltfFile file = cube_gltf();
    file.json["accessors"][0] = {
        {"componentType", kFloat}, {"count", std::uint64_t{1} << 40}, {"type", "VEC3"}};
    file.json["meshes"][0]["primitives"][0].erase("indices");
    expect_error(folder.import("zeros.glb", file.bytes()), "GiB of memory");

    constexpr std::uint64_t kVertices = 300000;
    file.json["accessors"][0]["count"] = kVertices;
    file.json["nodes"] = Json::array();
    file.json.erase("scenes");
    file.json.erase("scene");
    const std::uint64_t copies =
        2 * available_memory_bytes() / estimated_scene_bytes(kVertices / 3, kVertices, 12);
    for (std::uint64_t i = 0; i < copies; ++i) file.json["nodes"].push_back({{"mesh", 0}});
    expect_error(folder.import("copies.glb", file.bytes()), "GiB of memory");
}

TEST(ImportGltfErrors, every_truncation_gives_an_error) {
    const TestFolder folder;
    const std::string whole = rich_glb();
    ASSERT_TRUE(folder.import("whole.glb", whole).ok()) << folder.import("whole.glb", whole).error().message;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const Result<Scene> scene = folder.import("cut.glb", std::string_view(whole).substr(0, length));
        ASSERT_FALSE(scene.ok()) << length;
        expect_sound(scene, folder.path() / "cut.glb");
    }
}

TEST(ImportGltfErrors, random_bytes_give_an_error_or_a_sound_scene) {
    const TestFolder folder;
    const std::string whole = rich_glb();
    std::mt19937 random(20260801);
    int scenes = 0;
    for (int round = 0; round < 6000; ++round) {
        std::string bytes = whole;
        // Half of the rounds spoil the binary chunk and the header, where the JSON parser does not stop them.
        const std::size_t json_end = whole.find("BIN") - 4;
        for (auto flips = 1 + random() % 4; flips > 0; --flips) {
            std::size_t at = random() % bytes.size();
            if (round % 2 == 0) at = at % 2 == 0 ? at % 20 : json_end + at % (bytes.size() - json_end);
            bytes[at] = static_cast<char>(round % 3 == 0 ? '0' + random() % 10 : random());
        }
        const Result<Scene> scene = folder.import("flipped.glb", bytes);
        scenes += scene.ok() ? 1 : 0;
        expect_sound(scene, folder.path() / "flipped.glb");
        if (HasFatalFailure()) FAIL() << "round " << round;
    }
    EXPECT_GT(scenes, 100);
    EXPECT_LT(scenes, 5900);
}

TEST(ImportGltfErrors, spoiled_json_numbers_give_an_error_or_a_sound_scene) {
    const TestFolder folder;
    const std::string whole = rich_glb();
    std::uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, whole.data() + 12, 4);
    std::vector<std::size_t> digits;
    for (std::size_t at = 20; at < 20 + json_bytes; ++at)
        if (whole[at] >= '0' && whole[at] <= '9') digits.push_back(at);
    ASSERT_GT(digits.size(), 80u);
    for (const std::size_t at : digits) {
        for (const char c : {'0', '1', '4', '9', '-'}) {
            std::string bytes = whole;
            bytes[at] = c;
            expect_sound(folder.import("number.glb", bytes), folder.path() / "number.glb");
            if (HasFatalFailure()) FAIL() << "byte " << at << " is " << c;
        }
    }
}

TEST(ImportFile, files_that_cannot_be_read_are_named_with_the_mend) {
    const TestFolder folder;
    expect_error(import_scene(folder.path() / "none.glb"), "none.glb: there is no such file");
    std::filesystem::create_directory(folder.path() / "folder.obj");
    expect_error(import_scene(folder.path() / "folder.obj"), "folder.obj: this is a directory");
    expect_error(folder.import("scene.fbx", "x"),
                 "scene.fbx: unknown scene format '.fbx'; use one of .glb, .gltf, .obj and .ply");
    expect_error(folder.import("scene", "x"), "use one of");
    for (const char* name : {"empty.glb", "empty.gltf", "empty.obj", "empty.ply"})
        expect_error(folder.import(name, ""), "the file is empty");
    std::error_code code;
    std::filesystem::create_symlink("/dev/null", folder.path() / "device.ply", code);
    if (!code) expect_error(import_scene(folder.path() / "device.ply"), "not a regular file");
}

TEST(ImportFile, file_larger_than_the_free_memory_is_refused_before_it_is_read) {
    const TestFolder folder;
    const std::filesystem::path file = folder.write("huge.ply", "ply\n");
    std::error_code code;
    std::filesystem::resize_file(file, 2 * available_memory_bytes(), code);
    if (code) GTEST_SKIP() << "the file system holds no sparse file of that size: " << code.message();
    expect_error(import_scene(file), "GiB of memory");
}

TEST(ImportFile, name_with_a_line_break_stays_one_line) {
    const TestFolder folder;
    const Result<Scene> scene = import_scene(folder.path() / "two\nlines.glb");
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace rhview
