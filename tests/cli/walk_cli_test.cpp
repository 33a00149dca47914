// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "program.h"

namespace rhview::cli {
namespace {

const std::string kSmallTown = "town:size=96 --frames 12 --warmup 1 --size 160x90";

class EveryMethod : public ProgramTest, public testing::WithParamInterface<const char*> {};

TEST_P(EveryMethod, misses_no_pixel_on_small_scenes) {
    for (const char* scene : {"town:size=96,materials=5", "indoor:rooms=4,floors=2", "city:blocks=3", "soup",
                              "plant:objects=3000", "farm:instances=12,mesh=3000"}) {
        const nlohmann::json walk = walk_json(
            std::string(scene) + " --frames 10 --warmup 0 --size 200x120 --check --method " + GetParam());
        const nlohmann::json& missing = walk["summary"]["missing_pixels"];
        EXPECT_EQ(missing["total"], 0) << scene;
        EXPECT_EQ(missing["frames"], 0) << scene;
        EXPECT_EQ(missing["checked_frames"], 10) << scene;
        EXPECT_GT(walk["summary"]["indices"]["max"], 0) << scene;
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod,
                         testing::Values("none", "frustum", "grid", "octree", "rhview-seed", "rhview",
                                         "nested-grid", "nested-grid --leaf 100 --tune levels=2,top-cells=16",
                                         "chc", "chc --hierarchy octree --leaf 100", "chc++",
                                         "chc++ --hierarchy octree --leaf 100 --tune "
                                         "batch=5,visible-frames=2,visible-query=box,tight-depth=1"),
                         [](const auto& test) { return test_name(test.param); });

class Walk : public ProgramTest {};

class DrawsAndAsks : public ProgramTest, public testing::WithParamInterface<const char*> {};

TEST_P(DrawsAndAsks, in_turns_and_reports_queries_and_waits) {
    const nlohmann::json walk =
        walk_json(std::string("city:blocks=4 --frames 12 --warmup 2 --size 200x120 --method ") + GetParam());
    const nlohmann::json& summary = walk["summary"];
    EXPECT_GT(summary["queries"]["mean"], 1.0);
    EXPECT_GT(summary["query_boxes"]["mean"], 1.0);
    EXPECT_GT(summary["hidden_fraction"]["mean"], 0.0);
    // A frame whose answers nobody waits for draws nothing of what was hidden.
    EXPECT_GE(summary["waits"]["mean"], 1.0);
    EXPECT_GE(summary["blocking_reads"], 12);
    EXPECT_EQ(summary["lost_queries"], 0);
    EXPECT_GT(summary["cull_ms"]["mean"], 0.0);
    EXPECT_GT(walk["build"]["leaves"], 10);
    EXPECT_TRUE(walk["build"]["hierarchy"].is_string());
    // No model knows what waiting costs, and nothing hangs on a query.
    for (const char* field : {"predicted_ms", "prediction_error", "running_prediction_error",
                              "query_predicted_ms", "conditional_draws", "skipped_indices"})
        EXPECT_TRUE(summary[field].is_null()) << field;
    for (const nlohmann::json& frame : walk["per_frame"]) {
        EXPECT_TRUE(frame["predicted_ms"].is_null());
        EXPECT_TRUE(frame["fragments"].is_null());
        EXPECT_LE(frame["occlusion"]["waits"], frame["queries"]);
        EXPECT_GE(frame["frame_ms"], frame["cull_ms"]);
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, DrawsAndAsks, testing::Values("nested-grid", "chc", "chc++"),
                         [](const auto& test) {
                             return test.index == 0   ? "nested_grid"
                                    : test.index == 1 ? "chc"
                                                      : "chc_plus_plus";
                         });

TEST_F(Walk, chc_plus_plus_culls_the_hierarchy_that_is_asked_for) {
    const std::string city = "city:blocks=4 --frames 2 --warmup 0 --size 160x90 --method chc++ --hierarchy ";
    const nlohmann::json bvh = walk_json(city + "bvh"), octree = walk_json(city + "octree");
    EXPECT_EQ(bvh["build"]["hierarchy"], "bvh");
    EXPECT_EQ(octree["build"]["hierarchy"], "octree");
    EXPECT_NE(bvh["build"]["leaves"], octree["build"]["leaves"]);
}

/// Prices at which asking pays on a small scene.
const std::string kPrices = " --set c1=5,c3=200,query=4000,box=800";

TEST_F(Walk, hidden_things_are_left_out_by_either_way_and_no_pixel_is_missing) {
    const std::string city =
        "city:blocks=6 --frames 20 --warmup 4 --size 200x120 --check --visible-set" + kPrices;
    const double plain = walk_json(city + " --occlusion off")["summary"]["indices"]["mean"];
    for (const char* way : {"auto", "hardware", "boxes"}) {
        const nlohmann::json walk = walk_json(city + " --occlusion " + way);
        const nlohmann::json& summary = walk["summary"];
        EXPECT_EQ(walk["occlusion"], way);
        EXPECT_EQ(summary["missing_pixels"]["total"], 0) << way;
        EXPECT_EQ(summary["blocking_reads"], 0) << way;
        EXPECT_EQ(summary["lost_queries"], 0) << way;
        EXPECT_LT(summary["indices"]["mean"], 0.5 * plain) << way;
        EXPECT_GT(summary["queries"]["mean"], 1.0) << way;
        EXPECT_GT(summary["hidden_fraction"]["mean"], 0.3) << way;
        EXPECT_GT(summary["visible_set_indices"]["mean"], 0.0) << way;
        const double by_boxes = summary["box_pass_queries"]["mean"];
        EXPECT_TRUE(std::string(way) != "boxes" || summary["queries"]["mean"] == by_boxes);
        EXPECT_TRUE(std::string(way) != "hardware" || by_boxes == 0.0);
        for (const nlohmann::json& frame : walk["per_frame"])
            EXPECT_LE(frame["occlusion"]["executed_ranges"], frame["occlusion"]["conditional_ranges"]);
    }
}

TEST_F(Walk, equal_prices_and_answers_give_equal_plans) {
    const std::string city = "city:blocks=4 --frames 12 --warmup 2 --size 160x90" + kPrices;
    EXPECT_EQ(walk_json(city)["summary"]["plan_hash"], walk_json(city)["summary"]["plan_hash"]);
}

TEST_F(Walk, latent_mode_tells_what_it_misses_and_is_no_failed_check) {
    const nlohmann::json walk =
        walk_json("city:blocks=6 --frames 12 --warmup 4 --size 200x120 --check --mode latent" + kPrices);
    EXPECT_EQ(walk["mode"], "latent");
    EXPECT_TRUE(walk["summary"]["missing_pixels"]["total"].is_number());
    // Whoever lacked a pixel in some frame is told by the frames for which it did.
    double late_frames = 0.0;
    for (const nlohmann::json& frame : walk["per_frame"]) {
        EXPECT_EQ(frame["late_items"] > 0, frame["missing_pixels"] > 0);
        late_frames += frame["late_items"].get<double>();
    }
    EXPECT_GT(late_frames, 0.0);
    const nlohmann::json& reveals = walk["summary"]["reveal_frames"];
    EXPECT_NEAR(reveals["mean"].get<double>() * reveals["items"].get<double>(), late_frames, 1e-6);
}

TEST_F(Walk, without_a_price_of_a_query_nothing_is_asked) {
    const nlohmann::json walk =
        walk_json("city:blocks=3 --frames 3 --warmup 0 --size 160x90 --set c1=5,c3=200");
    EXPECT_TRUE(walk["summary"]["hidden_fraction"].is_null());
    EXPECT_TRUE(walk["summary"]["blocking_reads"].is_null());
    EXPECT_EQ(walk["summary"]["queries"]["max"], 0);
}

TEST_F(Walk, json_keeps_the_contract) {
    const nlohmann::json walk = walk_json(kSmallTown + " --method octree --leaf 64");
    EXPECT_EQ(walk["schema"], "rhview.walk/1");
    EXPECT_EQ(walk["scene"]["name"], "town:size=96");
    EXPECT_GT(walk["scene"]["triangles"], 10000);
    EXPECT_EQ(walk["scene"]["triangles"], walk["scene"]["static_triangles"]);
    EXPECT_EQ(walk["scene"]["dynamic_objects"], 0);
    EXPECT_EQ(walk["scene"]["materials"], 1);
    for (const char* field : {"renderer", "version", "timer"}) EXPECT_TRUE(walk["device"][field].is_string());
    EXPECT_TRUE(walk["profile"]["c1_ns"].is_number());
    EXPECT_EQ(walk["profile"]["source"], "quick");
    EXPECT_TRUE(walk["summary"]["predicted_ms"]["median"].is_number());
    for (const char* field : {"prediction_error", "running_prediction_error"})
        for (const char* statistic : {"median", "p95"})
            EXPECT_TRUE(walk["summary"][field][statistic].is_number()) << field;
    EXPECT_EQ(walk["method"], "octree");
    EXPECT_EQ(walk["mode"], "exact");
    EXPECT_EQ(walk["frames"], 12);
    EXPECT_EQ(walk["size"], (nlohmann::json{160, 90}));
    for (const char* field : {"ms", "nodes", "replica_bytes", "index_bytes", "vertex_bytes"})
        EXPECT_TRUE(walk["build"][field].is_number()) << field;
    for (const char* field :
         {"draw_calls", "sub_draws", "indices", "queries", "nodes_visited", "cull_ms", "frame_ms"})
        for (const char* statistic : {"mean", "median", "p95", "max"})
            EXPECT_TRUE(walk["summary"][field][statistic].is_number()) << field;
    // What was not measured is null, never 0.
    for (const char* field : {"visible_objects", "lod_error_px", "missing_pixels"})
        EXPECT_TRUE(walk["summary"][field].is_null()) << field;
    const std::string hash = walk["summary"]["plan_hash"];
    EXPECT_EQ(hash.size(), 16u);
    EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
    ASSERT_EQ(walk["per_frame"].size(), 12u);
    double sum = 0.0;
    for (const nlohmann::json& frame : walk["per_frame"]) {
        for (const char* field : {"frame", "draw_calls", "indices", "queries", "cull_ms", "frame_ms"})
            EXPECT_TRUE(frame[field].is_number()) << field;
        EXPECT_TRUE(frame["missing_pixels"].is_null());
        EXPECT_GE(frame["frame_ms"], frame["cull_ms"]);
        sum += frame["draw_calls"].get<double>();
    }
    EXPECT_NEAR(walk["summary"]["draw_calls"]["mean"].get<double>(), sum / 12.0, 1e-9);
}

TEST_F(Walk, methods_without_an_octree_report_no_build) {
    const nlohmann::json walk = walk_json(kSmallTown + " --method frustum");
    EXPECT_TRUE(walk["build"]["ms"].is_null());
    EXPECT_TRUE(walk["build"]["nodes"].is_null());
}

TEST_F(Walk, equal_walks_have_equal_plans_and_other_methods_others) {
    const auto hash = [&](const std::string& options) {
        return walk_json(kSmallTown + " --set c1=0.25,c3=2000" + options)["summary"]["plan_hash"];
    };
    const nlohmann::json seed = hash(" --method rhview-seed");
    EXPECT_EQ(seed, hash(" --method rhview-seed --check --submission multi"));
    EXPECT_NE(seed, hash(" --method rhview"));
    EXPECT_EQ(hash(""), hash(" --method rhview --submission multi"));
    EXPECT_NE(seed, hash(" --method octree --leaf 64"));
}

TEST_F(Walk, seeds_rule_draws_the_triangles_of_the_leaves_with_fewer_calls) {
    const nlohmann::json octree = walk_json(kSmallTown + " --leaf 64 --method octree")["summary"];
    const nlohmann::json seed = walk_json(kSmallTown + " --leaf 64 --method rhview-seed")["summary"];
    EXPECT_EQ(octree["indices"], seed["indices"]);
    EXPECT_LT(seed["draw_calls"]["mean"].get<double>(), 0.5 * octree["draw_calls"]["mean"].get<double>());
}

TEST_F(Walk, rhview_costs_less_than_the_seeds_rule_by_the_constants_it_is_given) {
    for (const char* constants : {" --set c1=0.25,c3=2000", " --set c1=1,c3=10"}) {
        const nlohmann::json seed = walk_json(kSmallTown + constants + " --method rhview-seed")["summary"];
        const nlohmann::json walk = walk_json(kSmallTown + constants + " --check");
        EXPECT_LT(walk["summary"]["predicted_ms"]["mean"], seed["predicted_ms"]["mean"]);
        EXPECT_LE(walk["build"]["replica_bytes"], walk["build"]["index_bytes"]);
        EXPECT_EQ(walk["summary"]["missing_pixels"]["total"], 0);
        const nlohmann::json none = walk_json(kSmallTown + constants + " --replica-budget 0");
        EXPECT_EQ(none["build"]["replica_bytes"], 0);
        EXPECT_EQ(none["build"]["replicas"], 0);
    }
}

TEST_F(Walk, multi_draw_makes_one_call_per_batch) {
    const nlohmann::json plain = walk_json(kSmallTown + " --leaf 64 --set c1=0.25,c3=2000")["summary"];
    const nlohmann::json multi =
        walk_json(kSmallTown + " --leaf 64 --set c1=0.25,c3=2000 --submission multi")["summary"];
    EXPECT_EQ(multi["draw_calls"]["max"], 1);
    EXPECT_EQ(multi["sub_draws"], plain["draw_calls"]);
    EXPECT_EQ(multi["indices"], plain["indices"]);
}

TEST_F(Walk, frames_are_predicted_with_the_constants_that_are_named) {
    const nlohmann::json walk = walk_json(kSmallTown + " --set c1=0.25,c3=2000");
    EXPECT_EQ(walk["profile"]["source"], "set");
    EXPECT_EQ(walk["profile"]["c3_ns"], 2000);
    EXPECT_TRUE(walk["profile"]["query_ns"].is_null());
    for (const nlohmann::json& frame : walk["per_frame"]) {
        const double expected_ns =
            0.25 * frame["indices"].get<double>() + 2000.0 * frame["draw_calls"].get<double>();
        EXPECT_NEAR(frame["predicted_ms"].get<double>(), 1e-6 * expected_ns, 1e-9);
    }
    const nlohmann::json& error = walk["summary"]["prediction_error"];
    EXPECT_GT(error["median"], 0.0);
    EXPECT_GE(error["p95"], error["median"]);

    const std::string profile = (std::filesystem::path(RHVIEW_PROFILES_DIR) / "seed-table1.json").string();
    const nlohmann::json seed = walk_json(kSmallTown + " --profile '" + profile + "'");
    EXPECT_EQ(seed["profile"]["source"], "file");
    EXPECT_EQ(seed["profile"]["c1_ns"], 0.318);
    const nlohmann::json both = walk_json(kSmallTown + " --set c3=9 --profile '" + profile + "'");
    EXPECT_EQ(both["profile"]["c1_ns"], 0.318);
    EXPECT_EQ(both["profile"]["c3_ns"], 9);
}

TEST_F(Walk, dynamic_objects_are_counted_and_culled) {
    const nlohmann::json walk =
        walk_json("farm:instances=30,mesh=2000 --frames 8 --size 160x90 --warmup 0 --check");
    EXPECT_EQ(walk["scene"]["dynamic_objects"], 30);
    EXPECT_GT(walk["scene"]["dynamic_triangles"], 30 * 1000);
    EXPECT_LT(walk["summary"]["visible_objects"]["mean"], 30);
    EXPECT_EQ(walk["summary"]["missing_pixels"]["total"], 0);
}

TEST_F(Walk, csv_has_a_line_per_frame_and_table_names_what_was_counted) {
    const Outcome outcome = run("walk " + kSmallTown + " --csv walk.csv");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string csv = read_file(folder_ / "walk.csv");
    EXPECT_EQ(std::ranges::count(csv, '\n'), 13);
    EXPECT_EQ(csv.rfind("frame,draw_calls,", 0), 0u);
    for (const char* word : {"draw calls", "indices", "frame ms", "median", "town:size=96"})
        EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
    EXPECT_TRUE(outcome.err.empty()) << outcome.err;
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(Walk, images_are_written_at_their_interval) {
    const Outcome outcome = run("walk " + kSmallTown + " --images pictures --images-every 5");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const char* name : {"frame_0000.png", "frame_0005.png", "frame_0010.png"})
        EXPECT_GT(std::filesystem::file_size(folder_ / "pictures" / name), 1000u);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "pictures"), {}), 3);
}

TEST_F(Walk, check_that_fails_exits_with_one_and_still_writes_the_results) {
    // Culling for the first frame's camera while the picture's moves on leaves visible triangles out.
    const Outcome outcome =
        run("walk " + kSmallTown + " --leaf 64 --check --freeze-culling 0 --json walk.json");
    EXPECT_EQ(outcome.code, 1);
    const nlohmann::json missing =
        nlohmann::json::parse(read_file(folder_ / "walk.json"))["summary"]["missing_pixels"];
    EXPECT_GT(missing["total"], 0);
    EXPECT_GE(missing["total"], missing["max"]);
    EXPECT_GT(missing["frames"], 0);
    EXPECT_LT(missing["frames"], 12);
}

TEST_F(Walk, check_every_nth_frame_checks_those_only) {
    const nlohmann::json walk = walk_json(kSmallTown + " --check-every 5");
    EXPECT_EQ(walk["summary"]["missing_pixels"]["checked_frames"], 3);
    EXPECT_TRUE(walk["per_frame"][1]["missing_pixels"].is_null());
    EXPECT_EQ(walk["per_frame"][5]["missing_pixels"], 0);
}

TEST_F(Walk, path_file_replaces_the_scenes_own) {
    write_file(
        folder_ / "sky.json",
        R"({"schema": "rhview.path/1", "fov_y_deg": 60, "near": 0.1, "far": 1000, "up": [0, 0, 1], "keys": [
                   {"time": 0, "eye": [0, 500, 0], "target": [0, 600, 0]},
                   {"time": 1, "eye": [0, 501, 0], "target": [0, 601, 0]}]})");
    const nlohmann::json walk = walk_json(kSmallTown + " --path sky.json --check");
    EXPECT_EQ(walk["summary"]["draw_calls"]["max"], 0);
    EXPECT_EQ(walk["summary"]["missing_pixels"]["total"], 0);
}

/// The path takes a second.
TEST_F(Walk, at_a_rate_the_frames_are_excerpts_of_the_path_at_its_own_pace) {
    write_file(folder_ / "way.json", R"({"schema": "rhview.path/1", "keys": [
                   {"time": 0, "eye": [0, 40, 0], "target": [10, 0, 0]},
                   {"time": 1, "eye": [200, 40, 0], "target": [210, 0, 0]}]})");
    const std::string walk =
        "town:size=96 --warmup 1 --size 160x90 --path way.json --method frustum --set c1=1,c3=1";
    const nlohmann::json all = walk_json(walk + " --frames 61");
    const nlohmann::json parts = walk_json(walk + " --frames 6 --rate 60 --excerpts 2");
    for (const auto& [part, whole] : {std::pair{0, 0}, {1, 1}, {2, 2}, {3, 58}, {4, 59}, {5, 60}})
        EXPECT_EQ(parts["per_frame"][part]["indices"], all["per_frame"][whole]["indices"]) << part;
    EXPECT_NE(all["per_frame"][0]["indices"], all["per_frame"][60]["indices"]);
    EXPECT_TRUE(all["rate_hz"].is_null());
    EXPECT_EQ(parts["rate_hz"], 60.0);
    EXPECT_EQ(parts["excerpts"], 2);
    EXPECT_EQ(run("walk " + walk + " --frames 61 --rate 60 --excerpts 2").code, 2);
    EXPECT_EQ(run("walk " + walk + " --frames 6 --excerpts 2").code, 2);
    EXPECT_EQ(run("walk " + walk + " --frames 2 --rate 60 --excerpts 3").code, 2);
}

TEST_F(Walk, info_and_scenes_tell_what_there_is) {
    const Outcome scenes = run("scenes");
    EXPECT_EQ(scenes.code, 0);
    for (const char* name : {"town", "plant", "indoor", "farm", "city", "soup", "materials"})
        EXPECT_NE(scenes.out.find(name), std::string::npos) << name;
    const Outcome info = run("info soup --json info.json");
    ASSERT_EQ(info.code, 0) << info.err;
    const nlohmann::json json = nlohmann::json::parse(read_file(folder_ / "info.json"));
    EXPECT_EQ(json["schema"], "rhview.info/1");
    EXPECT_GT(json["triangles"], 0);
    EXPECT_GT(json["dropped_triangles"], 0);
    EXPECT_FALSE(json["warnings"].empty());
    EXPECT_EQ(run("--version").code, 0);
    EXPECT_EQ(run("walk --help").code, 0);
}

}  // namespace
}  // namespace rhview::cli
