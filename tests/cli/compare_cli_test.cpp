// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "program.h"

namespace rhview::cli {
namespace {

const std::string kCity = "compare city:blocks=4 --frames 12 --warmup 1 --size 160x90 --set c1=1,c3=500";

class Compare : public ProgramTest {
  protected:
    nlohmann::json compare_json(const std::string& arguments) {
        const Outcome outcome = run(arguments + " --json compare.json");
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return nlohmann::json::parse(read_file(folder_ / "compare.json"));
    }
    void refuse(const std::string& arguments, const std::string& word) {
        const Outcome outcome = run(arguments + " --json compare.json");
        EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.err;
        EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err << "lacks " << word;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
        EXPECT_EQ(files_in_folder(), 0u) << arguments;
    }
};

TEST_F(Compare, counts_what_the_walk_of_each_method_counts) {
    const std::string methods = "frustum,grid,octree:leaf=500,rhview:occlusion=off";
    for (const std::string order : {"frame", "run"}) {
        const nlohmann::json compared =
            compare_json(kCity + " --check --methods " + methods + " --order " + order);
        EXPECT_EQ(compared["schema"], "rhview.compare/1");
        EXPECT_EQ(compared["order"], order);
        EXPECT_EQ(compared["reference"], "rhview:occlusion=off");
        ASSERT_EQ(compared["runs"].size(), 4u);
        const std::vector<std::string> walks{"frustum", "grid", "octree --leaf 500",
                                             "rhview --occlusion off"};
        for (std::size_t i = 0; i < walks.size(); ++i) {
            const nlohmann::json walk = walk_json(
                "city:blocks=4 --frames 12 --warmup 1 --size 160x90 --set "
                "c1=1,c3=500 --check --method " +
                walks[i]);
            const nlohmann::json& run = compared["runs"][i];
            EXPECT_EQ(run["schema"], "rhview.walk/1");
            EXPECT_EQ(run["summary"]["plan_hash"], walk["summary"]["plan_hash"]) << walks[i];
            EXPECT_EQ(run["summary"]["draw_calls"], walk["summary"]["draw_calls"]) << walks[i];
            EXPECT_EQ(run["summary"]["missing_pixels"]["total"], 0) << walks[i];
        }
    }
}

TEST_F(Compare, names_a_winner_only_if_its_ratio_to_each_other_method_is_below_one_for_certain) {
    const nlohmann::json compared = compare_json(kCity + " --methods octree:leaf=4096,frustum,rhview,none");
    std::vector<std::vector<double>> ms;
    for (const nlohmann::json& run : compared["runs"]) {
        ms.emplace_back();
        for (const nlohmann::json& frame : run["per_frame"]) ms.back().push_back(frame["frame_ms"]);
    }
    // Of 12 values, the third and the third last bound the median with 96 %.
    nlohmann::json winner;
    for (std::size_t i = 0; i < ms.size(); ++i) {
        bool wins = true;
        for (std::size_t other = 0; other < ms.size(); ++other) {
            if (other == i) continue;
            std::vector<double> ratios;
            for (std::size_t f = 0; f < ms[i].size(); ++f) ratios.push_back(ms[i][f] / ms[other][f]);
            std::ranges::sort(ratios);
            wins = wins && ratios[9] < 1.0;
        }
        if (wins) winner = compared["runs"][i]["label"];
    }
    EXPECT_EQ(compared["winner"], winner);
}

TEST_F(Compare, tells_no_winner_of_fewer_than_six_frames) {
    const Outcome five =
        run("compare city:blocks=4 --frames 5 --size 160x90 --set c1=1,c3=500 --methods none,rhview");
    EXPECT_EQ(five.code, 0) << five.err;
    EXPECT_NE(five.out.find("fewer than 6 frames prove nothing"), std::string::npos) << five.out;
}

TEST_F(Compare, csv_has_a_line_per_method_and_frame) {
    const Outcome outcome = run(kCity + " --methods frustum,rhview --csv compare.csv");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string csv = read_file(folder_ / "compare.csv");
    EXPECT_EQ(csv.rfind("method,frame,", 0), 0u);
    EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 2 * 12);
}

TEST_F(Compare, pareto_walks_every_choice_and_its_fronts_hold_what_nothing_beats) {
    const nlohmann::json compared = compare_json(
        "compare city:blocks=4 --frames 20 --warmup 1 --size 160x90 --set c1=1,c3=500,query=2000 --pareto "
        "--methods frustum");
    std::vector<std::string> labels;
    std::vector<double> errors;
    for (const nlohmann::json& run : compared["runs"]) {
        labels.push_back(run["label"]);
        const nlohmann::json& error = run["summary"]["image_error"];
        EXPECT_EQ(error["frames"], 20);
        errors.push_back(1.0 - error["ssim"].get<double>());
        // Exact methods show the picture of everything, pixel by pixel.
        if (run["mode"] == "exact") {
            EXPECT_EQ(error["missing_pixels"], 0) << labels.back();
            EXPECT_EQ(error["depth_max"], 0.0) << labels.back();
            EXPECT_EQ(error["colour_mse"], 0.0) << labels.back();
            EXPECT_TRUE(error["psnr_db"].is_null()) << labels.back();
            EXPECT_NEAR(errors.back(), 0.0, 1e-12) << labels.back();
        }
    }
    EXPECT_EQ(labels,
              (std::vector<std::string>{
                  "frustum", "rhview:mode=exact", "rhview:mode=latent", "rhview:mode=latent:visible-pixels=4",
                  "rhview:mode=latent:visible-pixels=16", "rhview:mode=latent:visible-pixels=64"}));
    // So fast a walk outruns latent mode: its picture lacks something, and then every measure says so.
    const nlohmann::json& latent = compared["runs"][2]["summary"]["image_error"];
    EXPECT_GT(latent["missing_pixels"], 0);
    EXPECT_GT(latent["depth_mean"], 0.0);
    EXPECT_GT(latent["colour_mse"], 0.0);
    EXPECT_LT(latent["ssim_min"], 0.9999);
    for (const char* cost : {"frame_ms", "draw_calls", "indices"}) {
        const auto cost_of = [&](std::size_t i) {
            return compared["runs"][i]["summary"][cost]["median"].get<double>();
        };
        for (std::size_t i = 0; i < labels.size(); ++i) {
            bool beaten = false;
            for (std::size_t k = 0; k < labels.size(); ++k)
                beaten = beaten || (cost_of(k) <= cost_of(i) && errors[k] <= errors[i] &&
                                    (cost_of(k) < cost_of(i) || errors[k] < errors[i]));
            const auto front = compared["pareto"][cost].get<std::vector<std::string>>();
            EXPECT_EQ(std::ranges::find(front, labels[i]) != front.end(), !beaten)
                << cost << " " << labels[i];
        }
    }
}

TEST_F(Compare, pareto_walks_each_bound_of_the_levels_errors_where_things_move) {
    const nlohmann::json compared = compare_json(
        "compare swarm:objects=40,mesh=8000 --frames 6 --warmup 1 --size 160x90 --set "
        "c1=1,c3=500,query=2000 "
        "--pareto");
    ASSERT_EQ(compared["runs"].size(), 30u);
    EXPECT_EQ(compared["reference"], "rhview:mode=exact:lod-error=0");
    std::vector<double> indices, loss;
    for (std::size_t i = 0; i < 6; ++i) {
        const nlohmann::json& summary = compared["runs"][i]["summary"];
        indices.push_back(summary["indices"]["mean"]);
        loss.push_back(1.0 - summary["image_error"]["ssim"].get<double>());
    }
    EXPECT_EQ(compared["runs"][5]["label"], "rhview:mode=exact:lod-error=8");
    EXPECT_EQ(compared["runs"][29]["label"], "rhview:mode=latent:visible-pixels=64:lod-error=8");
    EXPECT_EQ(compared["runs"][0]["summary"]["image_error"]["missing_pixels"], 0);
    EXPECT_NEAR(loss[0], 0.0, 1e-12);
    EXPECT_GT(loss[5], loss[1]);
    for (std::size_t i = 1; i < 6; ++i) EXPECT_LE(indices[i], indices[i - 1]) << i;
    EXPECT_LT(indices[5], 0.9 * indices[0]);
}

TEST_F(Compare, each_method_has_its_own_parameters) {
    const nlohmann::json compared = compare_json(
        "compare spheres:spheres=1200,moving=60,sides=8 --frames 12 --warmup 1 --size 160x90 --check --set "
        "c1=1,c3=500 --tune batch=20 --hierarchy octree --methods frustum,grid,grid:cells=2000,chc:leaf=300,"
        "chc++:batch=5,nested-grid:levels=2:top-cells=4");
    const auto of = [&](std::size_t run, const char* what) {
        return compared["runs"][run]["summary"][what]["mean"].get<double>();
    };
    for (const nlohmann::json& run : compared["runs"])
        EXPECT_EQ(run["summary"]["missing_pixels"]["total"], 0) << run["label"];
    EXPECT_LT(of(1, "indices"), of(2, "indices"));
    EXPECT_LT(of(2, "indices"), of(0, "indices"));
    EXPECT_EQ(compared["runs"][3]["leaf"], 300);
    EXPECT_EQ(compared["runs"][3]["build"]["hierarchy"], "octree");
}

TEST_F(Compare, modelled_price_is_that_of_8000_indices_a_draw) {
    const nlohmann::json compared = compare_json(kCity + " --methods frustum,chc,rhview");
    EXPECT_TRUE(compared["pareto"].is_null());
    for (const nlohmann::json& run : compared["runs"]) {
        double most = 0.0;
        for (const nlohmann::json& frame : run["per_frame"])
            most =
                std::max(most, frame["indices"].get<double>() + 8000.0 * frame["draw_calls"].get<double>());
        EXPECT_EQ(run["summary"]["modelled_indices"]["max"], most) << run["label"];
        EXPECT_TRUE(run["summary"]["image_error"].is_null());
        EXPECT_TRUE(run["per_frame"][0]["image_error"].is_null());
    }
    // What hangs on queries, and what a model decided, is not of methods that ask and wait in their own way.
    const nlohmann::json& occlusion = compared["runs"][1]["per_frame"][0]["occlusion"];
    EXPECT_TRUE(occlusion["waits"].is_number());
    for (const char* field :
         {"box_pass_queries", "conditional_draws", "skipped_indices", "query_ms", "saved_ms"})
        EXPECT_TRUE(occlusion[field].is_null()) << field;
    EXPECT_TRUE(compared["runs"][0]["per_frame"][0]["occlusion"].is_null());
}

TEST_F(Compare, refuses_what_it_does_not_know_in_a_sentence) {
    refuse(kCity + " --methods frustum,fastest", "unknown method 'fastest'");
    refuse(kCity + " --methods frustum,,rhview", "unknown method ''");
    refuse(kCity + " --methods rhview,rhview", "listed twice");
    refuse(kCity + " --methods octree:leaf=0", "leaf=0");
    refuse(kCity + " --methods octree:leaf=12x", "leaf=12x");
    refuse(kCity + " --methods octree:colour=red", "colour");
    refuse(kCity + " --methods grid:cells=none", "cells=none");
    refuse(kCity + " --methods octree:cells=2000", "has no such choice");
    refuse(kCity + " --methods rhview:mode=vague", "vague");
    refuse(kCity + " --methods rhview:visible-pixels=4", "needs --mode latent");
    refuse(kCity + " --methods rhview:mode=latent:visible-pixels=few", "whole number of pixels");
    refuse(kCity + " --pareto --methods rhview:mode=latent", "listed twice");
    refuse(kCity + " --order random", "--order random");
}

TEST_F(Compare, report_is_one_page_and_one_json) {
    const Outcome outcome = run(kCity + " --methods frustum,rhview --report page");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string page = read_file(folder_ / "page" / "report.html");
    for (const char* part : {"plot-frame_ms", "plot-draw_calls", "plot-indices", "plot-queries",
                             "plot-prediction", "data:image/png", "rhview compare city:blocks=4"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    EXPECT_EQ(nlohmann::json::parse(read_file(folder_ / "page" / "compare.json"))["runs"].size(), 2u);
}

TEST_F(Compare, report_without_python_leaves_the_json_and_says_so) {
    const Outcome outcome = run(kCity + " --methods frustum,rhview --report page", "PATH=/nowhere");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("needs python3"), std::string::npos) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "page" / "compare.json"));
}

}  // namespace
}  // namespace rhview::cli
