// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "program.h"

namespace rhview::cli {
namespace {

const std::string kScene = "indoor:rooms=2,floors=1";
const std::string kWalk = "walk " + kScene + " --frames 4 --warmup 0 --size 160x90 --json walk.json";

class Calibrate : public ProgramTest {
  protected:
    nlohmann::json json_of(const std::filesystem::path& file) {
        return nlohmann::json::parse(read_file(folder_ / file));
    }
    /// The only saved profile.
    [[nodiscard]] std::filesystem::path saved() const {
        const std::filesystem::directory_iterator files(cache_ / "rhview");
        return files == end(files) ? std::filesystem::path() : files->path();
    }
};

TEST_F(Calibrate, writes_a_profile_with_errors_and_says_what_was_tried) {
    const Outcome outcome = run("calibrate " + kScene + " --size 160x90 -o machine.json --csv frames.csv");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const char* text : {"c1, an index", "c3, a draw call", "±", "indices", "R²", "hold-out error",
                             "wall clock", "the paper's form", "models tried", "machine.json"})
        EXPECT_NE(outcome.out.find(text), std::string::npos) << text << "\n" << outcome.out;
    EXPECT_EQ(outcome.err, "");
    const nlohmann::json profile = json_of("machine.json");
    EXPECT_EQ(profile["schema"], "rhview.profile/1");
    EXPECT_FALSE(profile["device"]["renderer"].get<std::string>().empty());
    EXPECT_EQ(profile["timer"]["name"], "wall");
    EXPECT_EQ(profile["date"].get<std::string>().size(), 10u);
    EXPECT_EQ(profile["samples"], 150);
    EXPECT_GT(profile["hold_out_error"], 0.0);
    EXPECT_GT(profile["standard_errors"]["c1_ns"], 0.0);
    EXPECT_FALSE(profile["residuals"].is_null());
    const std::string csv = read_file(folder_ / "frames.csv");
    EXPECT_EQ(std::ranges::count(csv, '\n'), 151);
    EXPECT_EQ(files_in_folder(), 2u);
    EXPECT_FALSE(std::filesystem::exists(cache_ / "rhview"));

    const nlohmann::json walk =
        walk_json(kScene + " --frames 4 --warmup 0 --size 160x90 --profile machine.json");
    EXPECT_EQ(walk["profile"]["source"], "file");
    EXPECT_EQ(walk["profile"]["c1_ns"], profile["c1_ns"]);
}

TEST_F(Calibrate, walk_uses_what_was_saved_and_else_measures_quickly_and_says_so) {
    const Outcome quick = run(kWalk);
    ASSERT_EQ(quick.code, 0) << quick.err;
    EXPECT_NE(quick.out.find("calibrated quickly"), std::string::npos) << quick.out;
    EXPECT_EQ(json_of("walk.json")["profile"]["source"], "quick");
    EXPECT_FALSE(std::filesystem::exists(cache_ / "rhview"));

    ASSERT_EQ(run("calibrate " + kScene + " --size 160x90").code, 0);
    ASSERT_TRUE(std::filesystem::exists(saved()));
    const Outcome known = run(kWalk);
    EXPECT_NE(known.out.find(saved().string()), std::string::npos) << known.out;
    EXPECT_EQ(json_of("walk.json")["profile"]["source"], "file");
    EXPECT_EQ(known.err, "");

    // Another scene has no profile of its own, nor is there one of the machine.
    ASSERT_EQ(run("walk soup --frames 2 --warmup 0 --size 160x90 --json walk.json").code, 0);
    EXPECT_EQ(json_of("walk.json")["profile"]["source"], "quick");
}

TEST_F(Calibrate, a_profile_of_another_device_is_refused_unless_it_is_named) {
    ASSERT_EQ(run("calibrate " + kScene + " --size 160x90").code, 0);
    nlohmann::json profile = nlohmann::json::parse(read_file(saved()));
    profile["device"]["renderer"] = "a card from elsewhere";
    write_file(saved(), profile.dump());
    const Outcome refused = run(kWalk);
    EXPECT_EQ(refused.code, 0);
    EXPECT_NE(refused.err.find("warning: "), std::string::npos);
    EXPECT_NE(refused.err.find("a card from elsewhere"), std::string::npos);
    EXPECT_EQ(json_of("walk.json")["profile"]["source"], "quick");

    const Outcome named = run(kWalk + " --profile '" + saved().string() + "'");
    EXPECT_EQ(named.code, 0);
    EXPECT_NE(named.err.find("warning: "), std::string::npos);
    EXPECT_EQ(json_of("walk.json")["profile"]["source"], "file");
    EXPECT_EQ(json_of("walk.json")["profile"]["c1_ns"], profile["c1_ns"]);
}

TEST_F(Calibrate, a_damaged_saved_profile_is_told_and_not_used) {
    ASSERT_EQ(run("calibrate " + kScene + " --size 160x90").code, 0);
    const std::string text = read_file(saved());
    write_file(saved(), text.substr(0, text.size() / 2));
    const Outcome outcome = run(kWalk);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("truncated"), std::string::npos) << outcome.err;
    EXPECT_EQ(json_of("walk.json")["profile"]["source"], "quick");
}

TEST_F(Calibrate, repeats_report_the_median_of_each_frame) {
    const nlohmann::json walk =
        walk_json("soup --frames 3 --warmup 0 --size 160x90 --repeats 5 --set c1=1,c3=1 --method octree");
    const nlohmann::json once =
        walk_json("soup --frames 3 --warmup 0 --size 160x90 --set c1=1,c3=1 --method octree");
    EXPECT_EQ(walk["summary"]["plan_hash"], once["summary"]["plan_hash"]);
    EXPECT_EQ(walk["summary"]["indices"], once["summary"]["indices"]);
    EXPECT_EQ(walk["per_frame"].size(), 3u);
}

TEST_F(Calibrate, bad_input_is_one_sentence_and_leaves_nothing) {
    for (const std::string& arguments :
         {std::string("calibrate nowhere.glb -o p.json"), std::string("calibrate --size 0x0 -o p.json"),
          std::string("calibrate soup -o missing/p.json"), std::string("calibrate soup -o .")}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
        EXPECT_EQ(files_in_folder(), 0u) << arguments;
    }
    const Outcome homeless = run("calibrate soup", "XDG_CACHE_HOME= HOME=");
    EXPECT_EQ(homeless.code, 2);
    EXPECT_NE(homeless.err.find("-o"), std::string::npos) << homeless.err;
}

}  // namespace
}  // namespace rhview::cli
