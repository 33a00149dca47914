// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "rhview/timing_model/profile.h"
#include "synthetic.h"

namespace rhview {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, removed afterwards.
class ProfileFile : public testing::Test {
  protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::path(testing::TempDir()) / (std::string("rhview_profile_") + info->name());
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] std::ptrdiff_t files() const {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    }

    fs::path folder_;
};

constexpr const char* kSmallest =
    R"({"schema": "rhview.profile/1", "device": {"renderer": "r", "version": "v"}, "c0_ns": 1, "c1_ns": 0.5, "c3_ns": 2})";

TimingProfile full_profile(std::uint32_t seed) {
    test::Random random(seed);
    TimingProfile profile;
    profile.renderer = "llvmpipe \"LLVM\" 15, 256 bits\n";
    profile.version = "4.5 (Core) Mésa";
    profile.timer_name = "wall";
    profile.timer_why = "the GPU timer disagrees";
    profile.date = "2026-02-03";
    profile.note = "a note";
    for (const Term term : kAllTerms) {
        profile.set_constant(term, random.spread(1e-12, 1e9));
        profile.standard_errors_ns[index_of(term)] = random.spread(1e-300, 1e3);
    }
    profile.combination = seed % 2 == 0 ? Combination::Sum : Combination::MaxOfCpuAndGpu;
    const auto answer = [&] {
        return AnswerCosts{random.spread(1e-3, 1e6), random.spread(1e-3, 1e6), random.spread(1e-3, 1e6),
                           random.spread(1e-3, 1e6), random.spread(1e-3, 1e6)};
    };
    profile.answer_costs = QueryCosts{answer(), answer()};
    profile.residuals =
        ResidualPercentiles{-random.uniform(), random.normal(), 0.1, 1.0 / 3.0, random.uniform()};
    profile.hold_out_error = random.uniform();
    profile.r_squared = random.normal();
    profile.samples = std::numeric_limits<std::uint64_t>::max() - seed;
    return profile;
}

void expect_equal(const TimingProfile& a, const TimingProfile& b) {
    EXPECT_EQ(a.renderer, b.renderer);
    EXPECT_EQ(a.version, b.version);
    EXPECT_EQ(a.timer_name, b.timer_name);
    EXPECT_EQ(a.timer_why, b.timer_why);
    EXPECT_EQ(a.date, b.date);
    EXPECT_EQ(a.note, b.note);
    for (const Term term : kAllTerms) EXPECT_EQ(a.constant(term), b.constant(term)) << name_of(term);
    EXPECT_EQ(a.combination, b.combination);
    EXPECT_EQ(a.answer_costs, b.answer_costs);
    EXPECT_EQ(a.standard_errors_ns, b.standard_errors_ns);
    ASSERT_EQ(a.residuals.has_value(), b.residuals.has_value());
    if (a.residuals) {
        EXPECT_EQ(a.residuals->p5, b.residuals->p5);
        EXPECT_EQ(a.residuals->p50, b.residuals->p50);
        EXPECT_EQ(a.residuals->p95, b.residuals->p95);
        EXPECT_EQ(a.residuals->absolute_p50, b.residuals->absolute_p50);
        EXPECT_EQ(a.residuals->absolute_p95, b.residuals->absolute_p95);
    }
    EXPECT_EQ(a.hold_out_error, b.hold_out_error);
    EXPECT_EQ(a.r_squared, b.r_squared);
    EXPECT_EQ(a.samples, b.samples);
}

TEST_F(ProfileFile, keeps_every_bit) {
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        const TimingProfile profile = full_profile(seed);
        ASSERT_TRUE(save_profile(profile, folder_ / "p.json").ok());
        const Result<TimingProfile> again = load_profile(folder_ / "p.json");
        ASSERT_TRUE(again.ok()) << again.error().message;
        expect_equal(profile, *again);
    }
    EXPECT_EQ(files(), 1) << "the file of another name was left behind";
}

TEST_F(ProfileFile, what_was_not_measured_stays_absent) {
    TimingProfile profile;
    profile.c1_ns = 0.25;
    const Result<TimingProfile> again = parse_profile(profile_text(profile), "p");
    ASSERT_TRUE(again.ok()) << again.error().message;
    expect_equal(profile, *again);
    EXPECT_FALSE(again->query_ns.has_value());
}

TEST_F(ProfileFile, the_smallest_file_is_read_and_unknown_fields_are_ignored) {
    ASSERT_TRUE(parse_profile(kSmallest, "p").ok()) << parse_profile(kSmallest, "p").error().message;
    std::string text = kSmallest;
    text.insert(1, R"("colour": {"of": [1, 2]}, )");
    const Result<TimingProfile> profile = parse_profile(text, "p");
    ASSERT_TRUE(profile.ok()) << profile.error().message;
    EXPECT_EQ(profile->c1_ns, 0.5);
    EXPECT_EQ(profile->renderer, "r");
}

struct Spoiled {
    const char* name;
    const char* from;
    const char* to;
    const char* sentence;
};

class ProfileText : public testing::TestWithParam<Spoiled> {};

TEST_P(ProfileText, that_is_wrong_is_told_in_one_sentence) {
    std::string text = kSmallest;
    const std::string from = GetParam().from;
    text.replace(text.find(from), from.size(), GetParam().to);
    const Result<TimingProfile> profile = parse_profile(text, "m.json");
    ASSERT_FALSE(profile.ok());
    EXPECT_EQ(profile.error().message, GetParam().sentence);
}

INSTANTIATE_TEST_SUITE_P(
    Cases, ProfileText,
    testing::Values(
        Spoiled{"another_schema", "profile/1", "profile/2",
                "m.json: the profile has the schema \"rhview.profile/2\", this program reads "
                "\"rhview.profile/1\"; calibrate again"},
        Spoiled{"no_schema", "\"schema\"", "\"scheme\"",
                "m.json: the profile has no field \"schema\"; calibrate again"},
        Spoiled{"no_c1", "\"c1_ns\"", "\"c2_ns\"",
                "m.json: the profile has no field \"c1_ns\"; calibrate again"},
        Spoiled{"null_c3", "\"c3_ns\": 2", "\"c3_ns\": null",
                "m.json: the profile has no field \"c3_ns\"; calibrate again"},
        Spoiled{"text_for_a_number", "\"c0_ns\": 1", "\"c0_ns\": \"1\"",
                "m.json: the profile does not hold a number in \"c0_ns\"; calibrate again"},
        Spoiled{"negative", "\"c0_ns\": 1", "\"c0_ns\": -1",
                "m.json: \"c0_ns\" is negative; it must be finite and not negative, so calibrate again"},
        Spoiled{"negative_optional", "\"c0_ns\": 1", "\"c0_ns\": 1, \"query_ns\": -4",
                "m.json: \"query_ns\" is negative; it must be finite and not negative, so calibrate again"},
        Spoiled{"nan", "\"c0_ns\": 1", "\"c0_ns\": NaN",
                "m.json: not JSON at line 1, column 86; mend the text there or calibrate again"},
        Spoiled{"too_large", "\"c0_ns\": 1", "\"c0_ns\": 1e999",
                "m.json: it holds a number too large for double precision; calibrate again"},
        Spoiled{"device_is_text", "{\"renderer\": \"r\", \"version\": \"v\"}", "\"r\"",
                "m.json: the profile does not hold an object in \"device\"; write { … } with named fields"},
        Spoiled{"no_renderer", "\"renderer\"", "\"render\"",
                "m.json: the profile: \"device\" has no field \"renderer\"; calibrate again"},
        Spoiled{"combination", "\"c0_ns\": 1", "\"c0_ns\": 1, \"combination\": \"min\"",
                "m.json: the profile has the combination \"min\"; it must be \"sum\" or \"max\""},
        Spoiled{"half_of_the_residuals", "\"c0_ns\": 1", "\"c0_ns\": 1, \"residuals\": {\"p5\": 0}",
                "m.json: the profile: \"residuals\" has no field \"p50\"; calibrate again"},
        Spoiled{"one_way_of_asking", "\"c0_ns\": 1", "\"c0_ns\": 1, \"answer_costs\": {\"box_pass\": {}}",
                "m.json: the profile: \"answer_costs\" has no field \"hardware_query\"; calibrate again"},
        Spoiled{
            "negative_answer", "\"c0_ns\": 1",
            "\"c0_ns\": 1, \"answer_costs\": {\"hardware_query\": {\"frame_ns\": 1, \"query_ns\": 1, "
            "\"box_ns\": -1, \"pixel_ns\": 0, \"draw_ns\": 0}, \"box_pass\": {\"frame_ns\": 1, "
            "\"query_ns\": 1, \"box_ns\": 1, \"pixel_ns\": 0, \"draw_ns\": 0}}",
            "m.json: \"box_ns\" of \"hardware_query\" is negative; it must be finite and not negative, so "
            "calibrate again"},
        Spoiled{"standard_error", "\"c0_ns\": 1", "\"c0_ns\": 1, \"standard_errors\": {\"c1_ns\": -1}",
                "m.json: the standard error of \"c1_ns\" is negative; it must be finite and not negative, so "
                "calibrate again"},
        Spoiled{
            "samples", "\"c0_ns\": 1", "\"c0_ns\": 1, \"samples\": 2.5",
            "m.json: the profile does not hold a whole number, 0 or more, in \"samples\"; calibrate again"}),
    [](const auto& test) { return test.param.name; });

TEST_F(ProfileFile, every_truncation_is_refused) {
    std::string text = profile_text(full_profile(1));
    text.pop_back();  // the newline at the end may be missing
    for (std::size_t length = 0; length < text.size(); ++length) {
        const Result<TimingProfile> profile = parse_profile(text.substr(0, length), "t.json");
        ASSERT_FALSE(profile.ok()) << length;
        ASSERT_TRUE(profile.error().message.starts_with("t.json: ")) << profile.error().message;
    }
    EXPECT_EQ(parse_profile(text.substr(0, 40), "t.json").error().message,
              "t.json: the file is truncated (it ends at line 3, column 7); calibrate again");
}

TEST_F(ProfileFile, a_document_that_is_no_object_is_refused) {
    EXPECT_EQ(parse_profile("[1]", "a.json").error().message,
              "a.json: the profile is not a JSON object; write { … } with named fields");
}

TEST_F(ProfileFile, files_that_cannot_be_read_are_named) {
    EXPECT_EQ(load_profile(folder_ / "none.json").error().message,
              (folder_ / "none.json").string() + ": there is no such file; check the path");
    EXPECT_EQ(load_profile(folder_).error().message,
              folder_.string() + ": this is a folder; name a profile file");
    std::ofstream(folder_ / "large.json") << std::string(2 << 20, ' ');
    EXPECT_NE(load_profile(folder_ / "large.json").error().message.find("too large for a timing profile"),
              std::string::npos);
}

TEST_F(ProfileFile, a_failed_save_leaves_the_old_file_and_nothing_else) {
    const fs::path file = folder_ / "p.json";
    ASSERT_TRUE(save_profile(full_profile(3), file).ok());
    TimingProfile broken = full_profile(4);
    broken.c1_ns = -1.0;
    const Status status = save_profile(broken, file);
    ASSERT_FALSE(status.ok());
    EXPECT_TRUE(status.error().message.starts_with(file.string() + ": \"c1_ns\" is negative"));
    expect_equal(full_profile(3), *load_profile(file));

    fs::create_directories(folder_ / "taken" / "inside");
    EXPECT_NE(save_profile(full_profile(3), folder_ / "taken").error().message.find("is a folder"),
              std::string::npos);
    EXPECT_NE(
        save_profile(full_profile(3), folder_ / "none" / "p.json").error().message.find("can't be written"),
        std::string::npos);
    EXPECT_EQ(files(), 2) << "the profile and the folder, nothing half-written";
}

TEST_F(ProfileFile, broken_utf8_of_a_driver_is_written_as_a_replacement_character) {
    TimingProfile profile = full_profile(1);
    profile.renderer = "bad\xff";
    const Result<TimingProfile> again = parse_profile(profile_text(profile), "p");
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(again->renderer, "bad\xef\xbf\xbd");
}

TEST_F(ProfileFile, the_seeds_table_gives_its_own_predictions) {
    const Result<TimingProfile> seed = load_profile(fs::path(RHVIEW_PROFILES_DIR) / "seed-table1.json");
    ASSERT_TRUE(seed.ok()) << seed.error().message;
    EXPECT_EQ(seed->c1_ns, 0.318);
    EXPECT_EQ(seed->c3_ns, 433.0);
    EXPECT_FALSE(seed->query_ns.has_value());
    EXPECT_TRUE(seed->note.starts_with("An inference"));
    Work rungholt;  // RHView's row: measured 1.7 ms
    rungholt.indices = 4012393.0;
    rungholt.draw_calls = 98.46;
    EXPECT_NEAR(seed->predict_ns(rungholt), 1.32e6, 0.01e6);
    EXPECT_NEAR(seed->c3_ns / seed->c1_ns, 1360.0, 5.0);
}

}  // namespace
}  // namespace rhview
