// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "../rho_bytes.h"
#include "program.h"

namespace rhview::cli {
namespace {

// Constants are named: a machine's own differ from run to run.
const std::string kCosts = " --set c1=0.25,c3=2000 ";
const std::string kWalk = " --frames 8 --warmup 0 --size 160x90 --check " + kCosts;

class Bake : public ProgramTest {
  protected:
    void bake(const std::string& arguments) {
        const bool costs_named = arguments.find("--set") != std::string::npos;
        const Outcome outcome = run("bake " + arguments + (costs_named ? "" : kCosts));
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
    }
    RhoBytes read_rho(const std::string& name) {
        const std::string text = read_file(folder_ / name);
        RhoBytes file;
        for (const char c : text) file.bytes.push_back(static_cast<std::byte>(c));
        return file;
    }
    void write_rho(const std::string& name, const RhoBytes& file) {
        write_file(folder_ / name,
                   std::string(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()));
    }
    /// Expects exit code 2 and one sentence that names the file and holds `words`.
    void refuse(const std::string& arguments, const std::string& words) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.err;
        EXPECT_EQ(outcome.out, "") << arguments;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err << "lacks " << words;
    }
};

class EveryMethodBaked : public Bake, public testing::WithParamInterface<const char*> {};

TEST_P(EveryMethodBaked, plans_and_draws_as_from_the_source) {
    for (const char* scene :
         {"town:size=96,materials=4", "farm:instances=6,mesh=2000", "indoor:rooms=3,floors=2"}) {
        const std::string method = std::string("--method ") + GetParam();
        const bool has_octree = method != "--method none" && method != "--method frustum";
        bake(std::string(scene) + " -o a.rho --leaf 512 " + (has_octree ? method : ""));
        const nlohmann::json source = walk_json(scene + kWalk + "--leaf 512 " + method);
        const nlohmann::json baked = walk_json("a.rho" + kWalk + method);
        EXPECT_EQ(baked["summary"]["plan_hash"], source["summary"]["plan_hash"]) << scene;
        EXPECT_EQ(baked["summary"]["missing_pixels"]["total"], 0) << scene;
        for (const char* field : {"draw_calls", "indices", "nodes_visited", "visible_objects"})
            EXPECT_EQ(baked["summary"][field], source["summary"][field]) << scene << " " << field;
        EXPECT_EQ(baked["scene"], source["scene"]);
        EXPECT_TRUE(baked["build"]["ms"].is_null());
        EXPECT_TRUE(baked["build"]["load_ms"].is_number());
        EXPECT_TRUE(source["build"]["load_ms"].is_null());
        EXPECT_EQ(baked["leaf"], source["leaf"]);
        EXPECT_EQ(baked["build"]["nodes"], source["build"]["nodes"]);
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethodBaked,
                         testing::Values("none", "frustum", "octree", "rhview-seed", "rhview"),
                         [](const auto& test) {
                             std::string name = test.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

TEST_F(Bake, any_method_draws_all_from_another_ones_octree) {
    bake("city:blocks=3 -o a.rho");
    for (const char* method : {"octree", "rhview-seed", "rhview"}) {
        const nlohmann::json walk = walk_json("a.rho" + kWalk + "--method " + method);
        EXPECT_EQ(walk["summary"]["missing_pixels"]["total"], 0) << method;
        EXPECT_EQ(walk["summary"]["missing_pixels"]["checked_frames"], 8) << method;
        EXPECT_GT(walk["summary"]["indices"]["max"], 0) << method;
    }
}

TEST_F(Bake, pixels_are_those_of_the_source) {
    bake("town:size=96 -o a.rho");
    for (const char* method : {"none", "frustum", "rhview"}) {
        const std::string options =
            " --frames 2 --warmup 0 --size 160x90 --images-every 1 --method " + (method + kCosts);
        ASSERT_EQ(run("walk town:size=96" + options + " --images source").code, 0);
        ASSERT_EQ(run("walk a.rho" + options + " --images baked").code, 0);
        std::size_t pictures = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder_ / "source")) {
            EXPECT_TRUE(read_file(entry.path()) == read_file(folder_ / "baked" / entry.path().filename()))
                << method << " " << entry.path().filename();
            ++pictures;
        }
        EXPECT_EQ(pictures, 2u);
    }
}

TEST_F(Bake, info_tells_the_scene_and_where_it_came_from) {
    bake("town:size=96,materials=3 -o a.rho --leaf 256 --replica-budget 0.5 --set c1=0.5,c3=100");
    ASSERT_EQ(run("info a.rho --json baked.json").code, 0);
    ASSERT_EQ(run("info town:size=96,materials=3 --json source.json").code, 0);
    nlohmann::json baked = nlohmann::json::parse(read_file(folder_ / "baked.json"));
    nlohmann::json source = nlohmann::json::parse(read_file(folder_ / "source.json"));
    EXPECT_EQ(baked["baked"]["source"], "town:size=96,materials=3");
    EXPECT_EQ(baked["baked"]["max_leaf_triangles"], 256);
    EXPECT_EQ(baked["baked"]["replica_budget"], 0.5);
    EXPECT_EQ(baked["baked"]["c1_ns"], 0.5);
    EXPECT_EQ(baked["baked"]["c3_ns"], 100.0);
    EXPECT_TRUE(source["baked"].is_null());
    baked.erase("baked");
    source.erase("baked");
    EXPECT_EQ(baked, source);
}

TEST_F(Bake, equal_scenes_give_equal_files_and_a_baked_one_can_be_baked_again) {
    bake("plant:objects=500 -o a.rho");
    bake("plant:objects=500 -o b.rho");
    EXPECT_TRUE(read_file(folder_ / "a.rho") == read_file(folder_ / "b.rho"));
    bake("a.rho -o c.rho --leaf 64");
    bake("plant:objects=500 -o d.rho --leaf 64");
    EXPECT_TRUE(read_file(folder_ / "c.rho") == read_file(folder_ / "d.rho"));
    // Onto itself, too: the old file stays mapped until the new one is whole.
    bake("a.rho -o a.rho --leaf 64");
    EXPECT_TRUE(read_file(folder_ / "a.rho") == read_file(folder_ / "d.rho"));
    EXPECT_EQ(files_in_folder(), 4u);
}

TEST_F(Bake, a_path_of_the_users_is_baked_in) {
    write_file(folder_ / "path.json", R"({"schema": "rhview.path/1", "far": "infinity", "keys": [
        {"time": 0, "eye": [0, 2, 0], "target": [1, 2, 0]}, {"time": 5, "eye": [9, 2, 0], "target": [9, 2, 1]}]})");
    bake("town:size=96 -o a.rho --path path.json");
    const nlohmann::json source = walk_json("town:size=96 --path path.json" + kWalk);
    const nlohmann::json baked = walk_json("a.rho" + kWalk);
    EXPECT_EQ(baked["summary"]["plan_hash"], source["summary"]["plan_hash"]);
    EXPECT_EQ(baked["summary"]["missing_pixels"]["total"], 0);
}

TEST_F(Bake, bad_usage_is_told_and_leaves_nothing) {
    refuse("bake soup", "--output");
    refuse("bake soup -o soup.bin", "let it end in .rho");
    refuse("bake soup -o no/such/folder/a.rho", "no/such/folder/a.rho");
    refuse("bake twon -o a.rho", "twon");
    refuse("bake soup -o a.rho --leaf 0", "--leaf");
    refuse("bake soup -o a.rho --method none", "--method none: has no octree to bake");
    refuse("bake soup -o a.rho --replica-budget -1", "--replica-budget");
    refuse("bake soup -o a.rho --set c1", "--set");
    refuse("bake gone.rho -o a.rho", "gone.rho: there is no such file");
    std::filesystem::create_directory(folder_ / "folder.rho");
    refuse("bake soup -o folder.rho", "is a folder");
    refuse("walk folder.rho", "is a folder");
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(Bake, a_leaf_size_of_the_users_asks_for_baking_again) {
    bake("soup:triangles=1000 -o a.rho");
    refuse("walk a.rho --leaf 64", "brings its octree, with leaves of at most ");
}

TEST_F(Bake, damaged_files_end_in_one_sentence_and_exit_code_2) {
    bake("soup:triangles=1000 -o a.rho");
    const RhoBytes whole = read_rho("a.rho");
    const auto damaged = [&](const std::string& words, const auto& damage) {
        RhoBytes file = whole;
        damage(file);
        write_rho("b.rho", file);
        refuse("info b.rho", "b.rho: ");
        refuse("info b.rho", words);
    };
    damaged("is empty", [](RhoBytes& file) { file.bytes.clear(); });
    // At each section's beginning and end.
    for (std::size_t i = 0; i < whole.section_count(); ++i) {
        const auto begin = whole.get<std::uint64_t>(RhoBytes::entry(i) + RhoBytes::kEntryOffset);
        const auto size = whole.get<std::uint64_t>(RhoBytes::entry(i) + RhoBytes::kEntrySize);
        for (const std::uint64_t length : {begin, begin + size / 2})
            damaged("is cut short", [&](RhoBytes& file) { file.bytes.resize(length); });
    }
    damaged("not a baked file", [](RhoBytes& file) { file.bytes[1] = std::byte{'X'}; });
    damaged("format version 7", [](RhoBytes& file) { file.set<std::uint32_t>(RhoBytes::kVersion, 7); });
    damaged("big-endian", [](RhoBytes& file) { file.set<std::uint32_t>(RhoBytes::kByteOrder, 0x04030201); });
    damaged("its checksum does not fit", [](RhoBytes& file) { file.bytes.back() ^= std::byte{4}; });
    damaged("its subtree ends before it begins", [](RhoBytes& file) {
        // The root's own end: a node that begins with itself.
        file.set<std::uint32_t>(file.offset_of("ONOD") + 24, 0);
        file.repair();
    });
    damaged("the octree is not the scene's", [](RhoBytes& file) {
        // One vertex more than the scene has.
        const std::size_t place = file.offset_of("OBAT") + 8;
        file.set(place, file.get<std::uint64_t>(place) + 1);
        file.repair();
    });
    // An older program's file: sections it does not know.
    damaged("version 2, and this program reads up to 1", [](RhoBytes& file) {
        file.set<std::uint32_t>(RhoBytes::entry(file.find("ONOD")) + RhoBytes::kEntryVersion, 2);
        file.repair();
    });
}

TEST_F(Bake, an_unreadable_file_is_told) {
    bake("soup:triangles=1000 -o a.rho");
    std::filesystem::permissions(folder_ / "a.rho", std::filesystem::perms::none);
    if (std::ifstream(folder_ / "a.rho")) GTEST_SKIP() << "this user may read everything";
    refuse("walk a.rho", "a.rho: can't be read");
}

}  // namespace
}  // namespace rhview::cli
