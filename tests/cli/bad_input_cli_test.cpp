// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Bad input ends with exit code 2, one sentence on standard error that names the culprit, and no file left
// behind.

#include "program.h"

namespace rhview::cli {
namespace {

class BadInput : public ProgramTest {
  protected:
    /// Runs and expects a refusal whose sentence holds each of `words`, and `files` files in the folder.
    void refuse(const std::string& arguments, const std::vector<std::string>& words, std::size_t files,
                const std::string& environment = "") {
        const Outcome outcome = run(arguments, environment);
        EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.err;
        EXPECT_EQ(outcome.out, "") << arguments;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << arguments << "\n" << outcome.err;
        EXPECT_EQ(outcome.err.rfind("rhview: ", 0), 0u) << outcome.err;
        for (const std::string& word : words)
            EXPECT_NE(outcome.err.find(word), std::string::npos) << arguments << "\n"
                                                                 << outcome.err << "lacks " << word;
        EXPECT_EQ(files_in_folder(), files) << arguments;
    }
    void refuse_path(const std::string& json, const std::vector<std::string>& words) {
        write_file(folder_ / "path.json", json);
        refuse("walk soup --path path.json --json out.json", words, 1);
    }
};

TEST_F(BadInput, unknown_verbs_options_methods_and_modes) {
    refuse("", {"scenes, info, calibrate, bake, walk"}, 0);
    refuse("wlak town", {"wlak", "scenes, info, calibrate, bake, walk"}, 0);
    refuse("walk town --colour red", {"--colour", "rhview walk --help"}, 0);
    refuse("walk", {"SCENE"}, 0);
    refuse("--verison", {"--verison", "scenes, info, calibrate, bake, walk"}, 0);
    refuse("walk town --method fastest",
           {"--method fastest", "none, frustum, octree, nested-grid, chc, chc++, rhview-seed, rhview"}, 0);
    refuse("walk town --mode guess", {"--mode guess"}, 0);
    refuse("walk town --mode latent --method octree", {"--mode latent", "rhview"}, 0);
    refuse("walk town --occlusion never", {"--occlusion never", "auto, hardware, boxes, off"}, 0);
    refuse("walk soup --occlusion boxes --method rhview-seed", {"--occlusion boxes", "rhview-seed"}, 0);
    refuse("walk soup --occlusion boxes --method octree", {"--occlusion boxes", "octree"}, 0);
    refuse("walk soup --set c1=1,c3=2 --mode latent", {"--mode latent", "query=…"}, 0);
    refuse("walk soup --set c1=1,c3=2,query=3 --occlusion boxes", {"--occlusion boxes", "box"}, 0);
    refuse("walk town --visible-set --method none", {"--visible-set", "none"}, 0);
    refuse("walk soup --visible-set --method chc++", {"--visible-set", "chc++"}, 0);
    refuse("walk soup --occlusion hardware --method chc", {"--occlusion hardware", "chc"}, 0);
    refuse("walk soup --hierarchy grid --method chc", {"--hierarchy grid", "bvh or octree"}, 0);
    refuse("walk soup --hierarchy bvh --method rhview", {"--hierarchy", "rhview"}, 0);
    refuse("walk soup --tune batch=5 --method chc", {"--tune", "chc"}, 0);
    refuse("walk soup --tune batch --method chc++", {"--tune batch", "KEY=VALUE"}, 0);
    refuse("walk soup --tune batch=0 --method chc++", {"--tune batch=0", "1"}, 0);
    refuse("walk soup --tune batch=5x --method chc++", {"--tune batch=5x"}, 0);
    refuse("walk soup --tune colour=5 --method chc++", {"--tune colour", "tight-area"}, 0);
    refuse("walk soup --tune visible-query=eye --method chc++", {"visible-query=eye", "geometry or box"}, 0);
    refuse("walk town --submission bulk", {"--submission bulk"}, 0);
}

TEST_F(BadInput, numbers_out_of_range) {
    refuse("walk town --frames 0", {"--frames"}, 0);
    refuse("walk town --frames many", {"--frames"}, 0);
    refuse("walk town --warmup -1", {"--warmup"}, 0);
    refuse("walk town --leaf 0", {"--leaf"}, 0);
    refuse("walk town --check-every 0", {"--check-every"}, 0);
    for (const char* size : {"0x0", "0x90", "160", "160x", "x90", "160x90x3", "-160x90", "1e3x10", "160X90"})
        refuse(std::string("walk town --size ") + size, {std::string("--size ") + size, "1280x720"}, 0);
    refuse("walk soup --size 2000000x10", {"--size", "2000000x10", "each side"}, 0);
}

TEST_F(BadInput, scenes_that_are_not_there) {
    refuse("walk twon", {"twon", "town"}, 0);
    refuse("walk town:size=abc", {"size", "abc"}, 0);
    refuse("walk town:size=3", {"size", "3"}, 0);
    refuse("walk town:colour=3", {"colour"}, 0);
    refuse("walk town:materials=85", {"materials", "84"}, 0);
    refuse("walk missing.glb", {"missing.glb"}, 0);
    refuse("info missing.obj", {"missing.obj"}, 0);
    refuse("info .", {"this is a directory"}, 0);
    refuse("walk /dev", {"/dev: this is a directory"}, 0);
}

TEST_F(BadInput, broken_files) {
    write_file(folder_ / "empty.glb", "");
    refuse("walk empty.glb --json out.json", {"empty.glb"}, 1);
    write_file(folder_ / "noise.gltf", "{\"asset\": ");
    refuse("walk noise.gltf --csv out.csv", {"noise.gltf"}, 2);
    write_file(folder_ / "range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    refuse("walk range.obj", {"range.obj"}, 3);
    write_file(folder_ / "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    refuse("walk points.obj", {"points.obj", "triangle"}, 4);
    write_file(folder_ / "cut.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n0 0 0\n1 0 0\n");
    refuse("walk cut.ply", {"cut.ply"}, 5);
    write_file(folder_ / "picture.jpg", "x");
    refuse("walk picture.jpg", {"picture.jpg", ".glb"}, 6);
}

TEST_F(BadInput, triangles_that_are_not_finite_are_dropped_and_told) {
    write_file(folder_ / "nan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\n");
    const Outcome outcome = run("info nan.obj --json info.json");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json json = nlohmann::json::parse(read_file(folder_ / "info.json"));
    EXPECT_EQ(json["triangles"], 1);
    EXPECT_EQ(json["dropped_triangles"], 1);
    EXPECT_NE(outcome.out.find("left out"), std::string::npos);
}

TEST_F(BadInput, scene_larger_than_memory_is_refused_before_it_is_built) {
    refuse("walk town:size=60000", {"GiB"}, 0);
}

TEST_F(BadInput, camera_paths) {
    const std::string head =
        R"({"schema": "rhview.path/1", "fov_y_deg": 60, "near": 0.1, "far": 100, "keys": [)";
    const std::string first = R"({"time": 0, "eye": [0, 0, 0], "target": [1, 0, 0]})";
    const std::string second = R"({"time": 1, "eye": [0, 0, 0], "target": [1, 0, 0]})";
    refuse_path(head + "]}", {"path.json", "two"});
    refuse_path(head + first + "]}", {"path.json", "two"});
    refuse_path(head + first + "," + first + "]}", {"path.json", "key 1", "time"});
    refuse_path(head + first + R"(,{"time": 1, "eye": [0, 1e999, 0], "target": [1, 0, 0]}]})", {"path.json"});
    refuse_path(head + first + R"(,{"time": 1, "eye": [0, 0, 0], "target": [0, 0, 0]}]})",
                {"path.json", "key 1"});
    refuse_path(head + first + R"(,{"time": 1, "eye": [0, 0, 0], "target": [0, 5, 0]}]})",
                {"path.json", "key 1", "up"});
    refuse_path(head + first + "," + second, {"path.json"});
    refuse_path(R"({"schema": "rhview.path/2", "keys": []})", {"path.json", "rhview.path/1"});
    refuse("walk soup --path nowhere.json", {"nowhere.json"}, 1);
}

TEST_F(BadInput, timing_constants) {
    for (const char* set :
         {"c1", "c1=", "c1=fast", "c1=-1,c3=2", "c1=nan,c3=2", "c1=1e999,c3=1", "c1=1,c3=2x"})
        refuse(std::string("walk soup --set ") + set, {"--set", "name=value"}, 0);
    refuse("walk soup --set c1=1,c2=3", {"--set c2=3", "c0, c1, c3, query and box"}, 0);
    refuse("walk soup --set c1=1,c1=2,c3=1", {"twice"}, 0);
    refuse("walk soup --profile nowhere.json", {"nowhere.json"}, 0);
    write_file(folder_ / "profile.json", R"({"schema": "rhview.profile/1", "c1_ns": -1})");
    refuse("walk soup --profile profile.json --json out.json", {"profile.json"}, 1);
}

TEST_F(BadInput, unwritable_outputs_are_told_before_the_walk) {
    refuse("walk town --json no/such/folder/walk.json", {"no/such/folder/walk.json"}, 0);
    refuse("walk town --csv /proc/walk.csv", {"/proc/walk.csv"}, 0);
    refuse("info town --json .", {"is a folder"}, 0);
    write_file(folder_ / "file", "");
    refuse("walk town --images file", {"file"}, 1);
    refuse("walk town --images /proc/pictures", {"/proc/pictures"}, 1);
}

TEST_F(BadInput, outputs_spare_what_is_not_a_plain_file_of_theirs) {
    refuse("walk soup --json a.out --csv ./a.out", {"--json and --csv name the same file"}, 0);
    refuse("info soup --json ''", {"needs a name"}, 0);
    // Through a link to its target, and no temporary file stays.
    write_file(folder_ / "target", "old");
    std::filesystem::create_symlink("target", folder_ / "link");
    ASSERT_EQ(run("info soup --json link").code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link"));
    EXPECT_EQ(nlohmann::json::parse(read_file(folder_ / "target"))["schema"], "rhview.info/1");
    EXPECT_EQ(files_in_folder(), 2u);
    // A device is written to, not replaced; a full one is told.
    const Outcome full = run("info soup --json /dev/full");
    EXPECT_EQ(full.code, 2);
    EXPECT_NE(full.err.find("/dev/full"), std::string::npos);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(BadInput, full_standard_output_is_told) {
    const int status = std::system("'" RHVIEW_PROGRAM "' scenes >/dev/full 2>/dev/null");
    EXPECT_EQ(WEXITSTATUS(status), 2);
}

TEST_F(BadInput, machine_without_a_device_or_with_an_old_one) {
    refuse("walk soup", {"OpenGL 4.3"}, 0, "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent.json");
    refuse("walk soup", {"OpenGL 4.3", "3.3"}, 0, "MESA_GL_VERSION_OVERRIDE=3.3");
}

}  // namespace
}  // namespace rhview::cli
