// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// RHVIEW_PROPERTY_CASES=n runs n cases instead of a few, RHVIEW_PROPERTY_SEED=s begins with another seed,
// RHVIEW_PROPERTY_REPLAY=file runs the case of a file
// instead of a committed one. A case that fails is made simpler and written to
// rhview-property-<seed>.txt in the working directory.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include "ray_picture.h"
#include "run_property.h"

namespace rhview {
namespace {

std::uint32_t number_from(const char* variable, std::uint32_t otherwise) {
    const char* text = std::getenv(variable);
    return text != nullptr ? static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10)) : otherwise;
}

std::string save_simplest(const PropertyCase& failing) {
    const std::string file = "rhview-property-" + std::to_string(failing.seed) + ".txt";
    std::ofstream(file) << text_of(shrink(failing));
    return "simplest case in " + file + "; replay it with RHVIEW_PROPERTY_REPLAY=" + file;
}

TEST(Properties, what_is_promised_of_a_plan_holds_in_random_cases) {
    const std::uint32_t first = number_from("RHVIEW_PROPERTY_SEED", 1);
    const std::uint32_t count = number_from("RHVIEW_PROPERTY_CASES", 60);
    PropertyOutcome sum;
    for (std::uint32_t seed = first; seed < first + count; ++seed) {
        const PropertyCase property = random_property_case(seed);
        const PropertyOutcome outcome = run_property(property);
        ASSERT_EQ(outcome.failure, "") << "seed " << seed << ": " << save_simplest(property);
        sum.frames += outcome.frames;
        sum.pixels += outcome.pixels;
        sum.conditional_ranges += outcome.conditional_ranges;
        sum.hidden_answers += outcome.hidden_answers;
        sum.lists += outcome.lists;
    }
    std::cout << count << " cases: " << sum.frames << " frames, " << sum.pixels << " covered pixels, "
              << sum.conditional_ranges << " ranges on queries, " << sum.hidden_answers << " hidden answers, "
              << sum.lists << " other lists\n";
    EXPECT_GE(sum.frames, count);
    EXPECT_GT(sum.pixels, count);
    if (count < 60) return;
    EXPECT_GT(sum.conditional_ranges, count);
    EXPECT_GT(sum.hidden_answers, count / 2);
    EXPECT_GT(sum.lists, count);
}

TEST(Properties, the_case_of_a_file_holds) {
    const char* named = std::getenv("RHVIEW_PROPERTY_REPLAY");
    const char* file = named != nullptr ? named : RHVIEW_PROPERTY_CASE;
    std::ifstream stream(file);
    std::stringstream text;
    text << stream.rdbuf();
    const std::optional<PropertyCase> property = read_property_case(text.str());
    ASSERT_TRUE(stream && property) << file << " holds no case";
    EXPECT_EQ(run_property(*property).failure, "");
}

TEST(Properties, a_case_comes_back_from_its_file_as_it_was) {
    for (std::uint32_t seed = 1; seed < 200; ++seed) {
        const PropertyCase property = random_property_case(seed);
        const std::optional<PropertyCase> back = read_property_case(text_of(property));
        ASSERT_TRUE(back.has_value());
        EXPECT_EQ(*back, property);
    }
    EXPECT_FALSE(read_property_case("triangles 0\n"));
    EXPECT_FALSE(read_property_case("triangles many\n"));
    EXPECT_FALSE(read_property_case("triangle 3\n"));
}

TEST(Properties, rays_see_the_front_of_a_triangle_where_it_is) {
    SingleTriangle triangle{{{0, 0, -5}, {10, 0, -5}, {0, 10, -5}}};
    const View view{look_along({0, 0, 0}, {0, 0, -1}, {0, 1, 0}),
                    perspective(1.0, 1.5, 0.1, 10.0, ClipDepth::ZeroToOne), ClipDepth::ZeroToOne};
    const RayPicture front(view, glm::dvec3(0.0), {triangle});
    for (std::size_t pixel = 0; pixel < front.pixels(); ++pixel) {
        const std::size_t column = pixel % RayPicture::kWidth, row = pixel / RayPicture::kWidth;
        const bool seen = column >= RayPicture::kWidth / 2 && row >= RayPicture::kHeight / 2;
        ASSERT_EQ(front.hits(pixel).size(), seen ? 1u : 0u) << column << ' ' << row;
        const double enters = front.enters(pixel, {glm::vec3(0, 0, -5), glm::vec3(10, 10, -4)});
        EXPECT_EQ(enters < RayPicture::kNothing, seen);
        if (seen) {
            EXPECT_LT(enters, front.hits(pixel)[0].distance);
        }
    }
    std::swap(triangle.corners[0], triangle.corners[1]);
    const RayPicture back(view, glm::dvec3(0.0), {triangle});
    for (std::size_t pixel = 0; pixel < back.pixels(); ++pixel) EXPECT_TRUE(back.hits(pixel).empty());
}

std::uint64_t hash_of_cases() {
    std::uint64_t hash = 0;
    for (std::uint32_t seed = 1; seed <= 12; ++seed)
        hash = hash * 0x100000001b3ull ^ run_property(random_property_case(seed)).hash;
    return hash;
}

TEST(Properties, plans_are_those_recorded_with_every_instruction_set) {
    constexpr std::uint64_t kRecorded = 8459752979222320838u;
    const std::int64_t supported = hwy::SupportedTargets() & HWY_TARGETS;
    std::size_t sets = 0;
    for (std::int64_t left = supported; left != 0; left &= left - 1, ++sets) {
        const std::int64_t set = left & -left;
        hwy::SetSupportedTargetsForTest(set);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        EXPECT_EQ(hash_of_cases(), kRecorded) << hwy::TargetName(set);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GE(sets, 1u);
}

}  // namespace
}  // namespace rhview
