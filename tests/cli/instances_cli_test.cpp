// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "../rho_bytes.h"
#include "../scenes/import_test_files.h"
#include "program.h"

namespace rhview::cli {
namespace {

constexpr int kPlaces = 60;

/// A ring of cubes, every other one mirrored and as many two-sided, on one slab of its own mesh.
std::string village() {
    GltfFile file = cube_gltf();
    file.json["materials"] = {{{"name", "wall"}}, {{"name", "leaf"}, {"doubleSided", true}}};
    for (const int material : {0, 1}) {
        file.json["meshes"][material] = file.json["meshes"][0];
        file.json["meshes"][material]["primitives"][0]["material"] = material;
    }
    file.json["meshes"][2] = file.json["meshes"][0];
    file.json["nodes"] = {{{"mesh", 2}, {"translation", {-30, -1, -30}}, {"scale", {60, 1, 60}}}};
    for (int i = 0; i < kPlaces; ++i) {
        const double angle = 6.28318 * i / kPlaces;
        file.json["nodes"].push_back({{"mesh", i % 2},
                                      {"translation", {25 * std::cos(angle), 0, 25 * std::sin(angle)}},
                                      {"scale", {i % 4 < 2 ? 1 : -1, 1 + i % 3, 1}}});
    }
    std::vector<int> all(kPlaces + 1);
    for (int i = 0; i <= kPlaces; ++i) all[static_cast<std::size_t>(i)] = i;
    file.json["scenes"][0]["nodes"] = all;
    return file.bytes();
}

const std::string kWalk = " --frames 8 --warmup 0 --size 160x90 --check --set c1=0.25,c3=2000 ";

class Instances : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        write_file(folder_ / "village.glb", village());
        // Eyes among the cubes, so that many are outside.
        write_file(folder_ / "path.json", R"({"schema": "rhview.path/1", "far": 200, "keys": [
            {"time": 0, "eye": [0, 2, 0], "target": [9, 1, 0]},
            {"time": 5, "eye": [4, 2, 9], "target": [-9, 1, 20]}]})");
    }
    nlohmann::json walk_village(const std::string& options) {
        return walk_json("village.glb --path path.json" + kWalk + options);
    }
    void refuse(const std::string& arguments, const std::string& words) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.err;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err << "lacks " << words;
    }
};

TEST_F(Instances, every_method_draws_all_that_is_seen_kept_or_flattened) {
    for (const std::string method : {"none", "frustum", "octree", "rhview-seed", "rhview"}) {
        for (const std::string how : {"flatten", "keep"}) {
            const nlohmann::json walk = walk_village("--method " + method + " --instances " + how);
            const bool kept = how == "keep";
            EXPECT_EQ(walk["summary"]["missing_pixels"]["total"], 0) << method << how;
            EXPECT_EQ(walk["summary"]["missing_pixels"]["checked_frames"], 8);
            EXPECT_EQ(walk["scene"]["triangles"], 12 * (kPlaces + 1));
            EXPECT_EQ(walk["scene"]["static_triangles"], 12 * (kPlaces + 1));
            EXPECT_EQ(walk["scene"]["dynamic_objects"], 0);
            EXPECT_EQ(walk["scene"]["static_instances"], kept ? kPlaces : 0);
            EXPECT_EQ(walk["scene"]["instance_triangles"], kept ? 12 * kPlaces : 0);
            const nlohmann::json& instances = walk["summary"]["visible_instances"];
            EXPECT_EQ(instances.is_null(), !kept);
            if (!kept) continue;
            EXPECT_GT(instances["mean"], 0) << method;
            if (method == "none") {
                EXPECT_EQ(instances["mean"], kPlaces);
                EXPECT_EQ(walk["summary"]["indices"]["mean"], 36 * (kPlaces + 1));
            } else {
                EXPECT_LT(instances["max"], kPlaces / 2) << method;
            }
            for (const nlohmann::json& frame : walk["per_frame"])
                EXPECT_LE(frame["indices"], 36 * (kPlaces + 1));
        }
    }
}

TEST_F(Instances, what_was_chosen_and_what_it_costs_is_in_build) {
    const nlohmann::json flat = walk_village("--instances flatten")["build"]["instancing"];
    const nlohmann::json kept = walk_village("--instances keep")["build"]["instancing"];
    const nlohmann::json by_model = walk_village("")["build"]["instancing"];
    // 8 vertices of 12 bytes, 12 triangles.
    constexpr int kBytes = 8 * 12 + 12 * 12;
    EXPECT_EQ(flat["flattened_meshes"], 2);
    EXPECT_EQ(flat["flattened_placements"], kPlaces);
    EXPECT_EQ(flat["flattened_bytes"], kPlaces * kBytes);
    EXPECT_EQ(flat["kept_meshes"], 0);
    EXPECT_EQ(kept["kept_meshes"], 2);
    EXPECT_EQ(kept["kept_placements"], kPlaces);
    EXPECT_EQ(kept["kept_bytes"], 2 * kBytes);
    EXPECT_EQ(kept["flattened_bytes"], 0);
    for (const nlohmann::json& report : {flat, kept, by_model}) {
        EXPECT_EQ(report["all_flattened_bytes"], kPlaces * kBytes);
        EXPECT_EQ(report["all_kept_ns"], flat["all_kept_ns"]);
        EXPECT_EQ(report["all_flattened_ns"], flat["all_flattened_ns"]);
        EXPECT_LT(report["all_flattened_ns"], report["all_kept_ns"]);
        EXPECT_GE(report["ms"], 0.0);
    }
    EXPECT_EQ(flat["chosen_ns"], flat["all_flattened_ns"]);
    EXPECT_EQ(kept["chosen_ns"], flat["all_kept_ns"]);
    // A call for the price of 8,000 indices: all of them.
    EXPECT_EQ(by_model["flattened_meshes"], 2);
    EXPECT_EQ(by_model["budget_bytes"], 1 << 30);
    // Room for one of two alike.
    const nlohmann::json some = walk_village("--instance-budget 0.007")["build"]["instancing"];
    EXPECT_EQ(some["flattened_placements"], kPlaces / 2);
    EXPECT_EQ(some["kept_placements"], kPlaces / 2);
    EXPECT_LE(some["flattened_bytes"], some["budget_bytes"]);
    EXPECT_EQ(walk_village("--instance-budget 0")["build"]["instancing"]["flattened_meshes"], 0);
    const nlohmann::json none = walk_json("soup:triangles=1000" + kWalk)["build"]["instancing"];
    EXPECT_EQ(none["all_flattened_bytes"], 0);
    EXPECT_EQ(none["all_kept_ns"], 0.0);
}

TEST_F(Instances, baked_files_keep_them_and_what_was_chosen) {
    for (const std::string options : {"--instances keep", "--instances flatten", "--instance-budget 0.007"}) {
        const Outcome bake =
            run("bake village.glb --path path.json -o a.rho --set c1=0.25,c3=2000 " + options);
        ASSERT_EQ(bake.code, 0) << bake.err;
        EXPECT_NE(bake.out.find("instances"), std::string::npos) << bake.out;
        for (const std::string method : {"none", "frustum", "rhview"}) {
            const nlohmann::json source = walk_village(options + " --method " + method);
            const nlohmann::json baked = walk_json("a.rho" + kWalk + "--method " + method);
            EXPECT_EQ(baked["summary"]["missing_pixels"]["total"], 0) << options << method;
            EXPECT_EQ(baked["summary"]["plan_hash"], source["summary"]["plan_hash"]) << options << method;
            EXPECT_EQ(baked["summary"]["visible_instances"], source["summary"]["visible_instances"]);
            EXPECT_EQ(baked["scene"], source["scene"]);
            nlohmann::json report = source["build"]["instancing"];
            report["ms"] = nullptr;
            EXPECT_EQ(baked["build"]["instancing"], report);
        }
        ASSERT_EQ(run("bake a.rho -o b.rho --set c1=0.25,c3=2000").code, 0);
        EXPECT_TRUE(read_file(folder_ / "a.rho") == read_file(folder_ / "b.rho")) << options;
    }
    refuse("walk a.rho --instances keep" + kWalk, "--instances: a.rho was baked with its instances settled");
    refuse("walk a.rho --instance-budget 4" + kWalk, "--instance-budget: a.rho was baked");
    std::string text = read_file(folder_ / "a.rho");
    RhoBytes file;
    for (const char c : text) file.bytes.push_back(static_cast<std::byte>(c));
    file.set<std::uint32_t>(RhoBytes::entry(file.find("SCNE")) + RhoBytes::kEntryVersion, 1);
    file.repair();
    text.assign(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
    write_file(folder_ / "old.rho", text);
    refuse("walk old.rho" + kWalk, "section SCNE is of version 1, and this program reads none before 2");
}

TEST_F(Instances, info_tells_what_the_file_stores_and_places) {
    const Outcome info = run("info village.glb --json info.json");
    ASSERT_EQ(info.code, 0) << info.err;
    EXPECT_NE(info.out.find("60 of the objects place 2 meshes"), std::string::npos) << info.out;
    const nlohmann::json json = nlohmann::json::parse(read_file(folder_ / "info.json"));
    EXPECT_EQ(json["triangles"], 12 * (kPlaces + 1));
    EXPECT_EQ(json["static_objects"], kPlaces + 1);
    EXPECT_EQ(json["static_instances"], kPlaces);
    EXPECT_EQ(json["stored_triangles"], 3 * 12);
    EXPECT_EQ(json["vertices"], 3 * 8);
}

TEST_F(Instances, bad_usage_is_told) {
    refuse("walk village.glb --instances some" + kWalk, "--instances some: unknown; write auto, flatten or");
    refuse("bake village.glb -o a.rho --instances 7", "--instances 7: unknown; write auto, flatten or keep");
    refuse("walk village.glb --instance-budget -1" + kWalk, "--instance-budget");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.rho"));
}

TEST_F(Instances, without_constants_a_quick_calibration_measures_the_scene_with_them) {
    const nlohmann::json walk = walk_json("village.glb --frames 2 --warmup 0 --size 160x90 --check");
    EXPECT_EQ(walk["summary"]["missing_pixels"]["total"], 0);
    EXPECT_EQ(walk["build"]["instancing"]["all_flattened_bytes"], kPlaces * (8 * 12 + 12 * 12));
}

}  // namespace
}  // namespace rhview::cli
