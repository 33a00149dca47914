// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Each case of the catalogue, drawn by every method in every mode and convention of depth: no pixel may
// differ from drawing everything. Latent mode is promised that only once the camera stands.
//
// A few views of each case, and the largest scenes small. RHVIEW_CATALOGUE=40 runs 40 views of each and the
// scenes whole: the table in docs/numerics.md.

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "case_run.h"
#include "rhview/gl/context.h"

namespace rhview {
namespace {

int views_wanted() {
    const char* text = std::getenv("RHVIEW_CATALOGUE");
    return text != nullptr ? std::atoi(text) : 0;
}

class Catalogue : public testing::TestWithParam<std::size_t> {};

TEST_P(Catalogue, every_pixel_is_shown) {
    const HardCase& hard_case = hard_cases()[GetParam()];
    const bool whole = views_wanted() > 0;
    const int views = hard_case.is_large ? 1 : whole ? views_wanted() : 2;
    Result<gl::Context> context = gl::Context::create_headless({.debug = true});
    ASSERT_TRUE(context.ok()) << context.error().message;
    const Tally tally = run_case(hard_case, views, whole ? Amount::Whole : Amount::Sample);
    EXPECT_EQ(tally.missing, 0u) << tally.first_missing;
    EXPECT_GT(tally.covered, 1000u) << "hardly anything was in view";
    EXPECT_LE(tally.undecided + tally.doubtful, tally.covered / 1000) << "the driver decides too much";
    if (GetParam() == 0) {
        EXPECT_EQ(tally.undecided + tally.doubtful, 0u);
    }
    if (hard_case.cameras == nullptr) {
        EXPECT_LT(tally.worst_error_px, 0.02);
    }
    EXPECT_EQ(gl::take_error(), "");
    std::cout << "| " << hard_case.name << " | " << tally.static_triangles << " + " << tally.objects << " | "
              << tally.views << " | " << tally.frames << " | " << tally.covered << " | " << tally.missing
              << " | " << tally.undecided << " | " << tally.doubtful << " | " << tally.late << " | "
              << tally.hidden << " | "
              << static_cast<double>(tally.indices) / static_cast<double>(tally.all_indices) << " | "
              << tally.worst_error_px << " |\n";
}

INSTANTIATE_TEST_SUITE_P(Case, Catalogue, testing::Range(std::size_t{0}, hard_cases().size()),
                         [](const auto& test) { return hard_cases()[test.param].name; });

}  // namespace
}  // namespace rhview
