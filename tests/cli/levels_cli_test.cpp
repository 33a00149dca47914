// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Levels of detail through the program: the same picture as drawing everything at the same levels, for every
// method, and what the results say of them.

#include "program.h"

namespace rhview::cli {
namespace {

const std::string kFarm = "farm:instances=30,mesh=30000 --frames 8 --warmup 1 --size 240x136 ";
const std::string kCosts = "--set c1=4,c3=200,query=3000,box=500 ";

class EveryMethodAtLevels : public ProgramTest, public testing::WithParamInterface<const char*> {};

TEST_P(EveryMethodAtLevels, misses_no_pixel_and_draws_less) {
    const std::string method = std::string("--check --method ") + GetParam() + " ";
    const nlohmann::json whole = walk_json(kFarm + kCosts + method + "--lod-error 0");
    const nlohmann::json levels = walk_json(kFarm + kCosts + method + "--lod-error 2");
    for (const nlohmann::json& walk : {whole, levels}) {
        EXPECT_EQ(walk["summary"]["missing_pixels"]["total"], 0);
        EXPECT_EQ(walk["summary"]["missing_pixels"]["checked_frames"], 8);
    }
    EXPECT_EQ(whole["summary"]["lod_error_px"]["max"], 0.0);
    EXPECT_EQ(whole["lod"]["levels"], 0);
    EXPECT_TRUE(whole["lod"]["build_ms"].is_null());
    EXPECT_GT(levels["summary"]["lod_error_px"]["max"], 0.5);
    EXPECT_LE(levels["summary"]["lod_error_px"]["max"], 2.0);
    EXPECT_GE(levels["lod"]["levels"], 5);
    EXPECT_LT(levels["summary"]["indices"]["max"], 0.7 * whole["summary"]["indices"]["max"].get<double>());
    for (const nlohmann::json& frame : levels["per_frame"]) EXPECT_TRUE(frame["budget"].is_null());
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethodAtLevels,
                         testing::Values("none", "frustum", "grid", "octree", "rhview-seed", "rhview",
                                         "rhview --occlusion off", "nested-grid", "chc", "chc++"),
                         [](const auto& test) { return test_name(test.param); });

class Levels : public ProgramTest {};

TEST_F(Levels, all_methods_draw_the_same_levels) {
    std::vector<nlohmann::json> errors;
    for (const char* method : {"none", "frustum", "octree", "rhview", "chc++"}) {
        const nlohmann::json walk = walk_json(kFarm + kCosts + "--lod-error 1.5 --method " + method);
        errors.push_back(walk["summary"]["lod_error_px"]["max"]);
        EXPECT_GT(errors.back(), 0.2) << method;
    }
    // Who culls by boxes or hides more may leave out the one that is most wrong; nobody adds one.
    for (const nlohmann::json& error : errors) EXPECT_LE(error, errors.front());
    EXPECT_EQ(errors[1], errors[2]);
}

TEST_F(Levels, of_moving_objects_behind_walls_stay_exact) {
    for (const char* options : {"", "--occlusion boxes ", "--occlusion hardware "}) {
        const nlohmann::json walk = walk_json(
            "crowd:objects=600,mesh=600 --frames 12 --warmup 0 --size 240x136 --check --lod-error 3 " +
            kCosts + options);
        EXPECT_EQ(walk["summary"]["missing_pixels"]["total"], 0) << options;
        EXPECT_GT(walk["summary"]["queries"]["max"], 0) << options;
        EXPECT_GT(walk["summary"]["lod_error_px"]["max"], 0.0) << options;
    }
}

TEST_F(Levels, a_mesh_at_a_level_takes_one_draw_call) {
    const nlohmann::json walk = walk_json(
        "farm:instances=300,mesh=3000 --frames 40 --rate 60 --excerpts 4 --size 240x136 --lod-error 1 " +
        kCosts);
    for (const nlohmann::json& frame : walk["per_frame"])
        EXPECT_EQ(frame["object_draw_calls"], frame["visible_mesh_levels"]) << frame["frame"];
    const double most_objects = walk["summary"]["visible_objects"]["max"];
    EXPECT_GT(most_objects, 50);
    EXPECT_GE(walk["summary"]["object_draw_calls"]["max"], 2);
    EXPECT_LT(walk["summary"]["object_draw_calls"]["max"], 0.3 * most_objects);
}

TEST_F(Levels, the_visible_set_is_that_of_what_is_drawn) {
    const nlohmann::json walk = walk_json(kFarm + kCosts + "--visible-set --method octree --lod-error 4");
    EXPECT_GT(walk["summary"]["visible_set_indices"]["mean"], 0.0);
}

TEST_F(Levels, baked_ones_are_used_as_they_are) {
    ASSERT_EQ(run("bake farm:instances=30,mesh=6000 -o farm.rho " + kCosts).code, 0);
    const std::string options = " --frames 8 --warmup 1 --size 240x136 --check --lod-error 1 " + kCosts;
    const nlohmann::json source = walk_json("farm:instances=30,mesh=6000" + options);
    const nlohmann::json baked = walk_json("farm.rho" + options);
    EXPECT_EQ(baked["summary"]["plan_hash"], source["summary"]["plan_hash"]);
    EXPECT_EQ(baked["summary"]["missing_pixels"]["total"], 0);
    EXPECT_EQ(baked["lod"]["levels"], source["lod"]["levels"]);
    EXPECT_TRUE(source["lod"]["build_ms"].is_number());
    EXPECT_TRUE(baked["lod"]["build_ms"].is_null());
    // A scene without moving things has none.
    ASSERT_EQ(run("bake town:size=64 -o town.rho " + kCosts).code, 0);
    EXPECT_EQ(walk_json("town.rho --frames 2 --warmup 0 --size 64x48 " + kCosts)["lod"]["levels"], 0);
}

TEST_F(Levels, a_budget_is_judged_frame_by_frame) {
    const std::string walk_options =
        "farm:instances=60,mesh=20000 --frames 16 --warmup 4 --size 160x90 "
        "--lod-error 0 " +
        kCosts;
    const nlohmann::json generous = walk_json(walk_options + "--budget 100000");
    EXPECT_EQ(generous["summary"]["budget"]["can_be_met_frames"], 16);
    EXPECT_EQ(generous["summary"]["budget"]["met_of_those"], 16);
    EXPECT_EQ(generous["summary"]["lod_error_px"]["max"], 0.0);
    const nlohmann::json impossible = walk_json(walk_options + "--budget 0.01");
    EXPECT_EQ(impossible["summary"]["budget"]["can_be_met_frames"], 0);
    EXPECT_LT(impossible["summary"]["indices"]["max"],
              0.5 * generous["summary"]["indices"]["max"].get<double>());
    for (const nlohmann::json& frame : impossible["per_frame"]) {
        EXPECT_EQ(frame["budget"]["can_be_met"], false);
        EXPECT_GE(frame["budget"]["margin"], 1.0);
        EXPECT_GT(frame["budget"]["predicted_ms"], 0.01);
    }
}

TEST_F(Levels, fragments_that_queries_counted_make_them_coarser_and_nothing_is_missed) {
    const std::string options = "--lod-error 0.1 --occlusion hardware --check --set c1=4,c3=200,query=300 ";
    const std::string farm =
        "farm:instances=30,mesh=30000 --frames 45 --rate 30 --excerpts 3 --warmup 1 --size 240x136 ";
    const nlohmann::json by_error = walk_json(farm + options);
    const nlohmann::json by_fragments = walk_json(farm + options + "--lod-policy fragments");
    EXPECT_EQ(by_error["lod"]["policy"], "error");
    EXPECT_EQ(by_fragments["lod"]["policy"], "fragments");
    EXPECT_LE(by_error["summary"]["lod_error_px"]["max"], 0.1);
    EXPECT_GT(by_fragments["summary"]["lod_error_px"]["max"], 0.1);
    EXPECT_LT(by_fragments["summary"]["indices"]["mean"],
              0.9 * by_error["summary"]["indices"]["mean"].get<double>());
    EXPECT_EQ(by_fragments["summary"]["missing_pixels"]["total"], 0);
}

TEST_F(Levels, a_budget_without_a_number_is_that_of_sixty_frames_a_second) {
    const std::string options = "--frames 2 --warmup 0 --size 64x36 " + kCosts;
    const nlohmann::json walk = walk_json("farm:instances=10,mesh=3000 " + options + "--budget");
    EXPECT_EQ(walk["lod"]["budget_ms"], 16.6);
    EXPECT_TRUE(walk_json("farm:instances=10,mesh=3000 " + options)["lod"]["budget_ms"].is_null());
}

TEST_F(Levels, a_comparison_names_a_bound_for_each_method) {
    const Outcome outcome =
        run("compare farm:instances=30,mesh=6000 --methods rhview:lod-error=0,rhview:lod-error=4 --frames 4 "
            "--warmup 1 --size 240x136 --check --lod-error 0 --json c.json " +
            kCosts);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json compare = nlohmann::json::parse(read_file(folder_ / "c.json"));
    ASSERT_EQ(compare["runs"].size(), 2u);
    EXPECT_EQ(compare["runs"][0]["lod"]["error_bound_px"], 0.0);
    EXPECT_EQ(compare["runs"][1]["lod"]["error_bound_px"], 4.0);
    EXPECT_LT(compare["runs"][1]["summary"]["indices"]["mean"],
              compare["runs"][0]["summary"]["indices"]["mean"]);
    for (const nlohmann::json& walk : compare["runs"])
        EXPECT_EQ(walk["summary"]["missing_pixels"]["total"], 0);
}

TEST_F(Levels, what_makes_no_sense_is_refused_in_a_sentence) {
    for (const std::string arguments :
         {"walk farm --lod-error -1", "walk farm --budget 0", "walk farm --budget 5 --method chc",
          "walk farm --lod-error x", "compare farm --methods rhview:lod-error=x", "walk farm --lod-policy x",
          "walk farm --lod-policy fragments --occlusion off"}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
        const bool names_it = outcome.err.find("lod-") != std::string::npos ||
                              outcome.err.find("--budget") != std::string::npos;
        EXPECT_TRUE(names_it) << outcome.err;
    }
}

}  // namespace
}  // namespace rhview::cli
