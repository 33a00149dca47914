// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// `--check` can fail: programs whose planner leaves out a visible node now and then, or rotates its queries'
// answers, are found out by it.

#include "program.h"

namespace rhview::cli {
namespace {

const std::string kWalk =
    "city:blocks=10 --frames 24 --warmup 0 --size 160x90 --check --leaf 128 "
    "--set c1=1,c3=300,query=300,box=30";

class CheckOf : public ProgramTest {
  protected:
    void expect_found_out(const char* program) {
        program_ = program;
        const Outcome outcome = run("walk " + kWalk + " --json walk.json");
        EXPECT_EQ(outcome.code, 1) << outcome.err;
        const nlohmann::json walk = nlohmann::json::parse(read_file(folder_ / "walk.json"));
        EXPECT_GT(walk["summary"]["missing_pixels"]["total"], 0);
    }
};

TEST_F(CheckOf, the_honest_program_passes) {
    EXPECT_EQ(walk_json(kWalk)["summary"]["missing_pixels"]["total"], 0);
}

TEST_F(CheckOf, a_program_that_drops_nodes_fails) {
    expect_found_out(RHVIEW_DROPPING_PROGRAM);
}

TEST_F(CheckOf, a_program_that_rotates_answers_fails) {
    expect_found_out(RHVIEW_ROTATING_PROGRAM);
}

}  // namespace
}  // namespace rhview::cli
