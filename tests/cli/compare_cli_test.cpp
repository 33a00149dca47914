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

TEST_F(Compare, refuses_what_it_does_not_know_in_a_sentence) {
    refuse(kCity + " --methods frustum,fastest", "unknown method 'fastest'");
    refuse(kCity + " --methods frustum,,rhview", "unknown method ''");
    refuse(kCity + " --methods rhview,rhview", "listed twice");
    refuse(kCity + " --methods octree:leaf=0", "leaf=0");
    refuse(kCity + " --methods octree:leaf=12x", "leaf=12x");
    refuse(kCity + " --methods octree:colour=red", "colour");
    refuse(kCity + " --methods rhview:mode=vague", "vague");
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
