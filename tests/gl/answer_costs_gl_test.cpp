// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/answer_costs.h"

#include <cmath>

#include "gl_fixture.h"
#include "rhview/gl/timer.h"
#include "uniform.h"

namespace rhview::gl {
namespace {

double predicted(const AnswerCosts& c, const AskedFrame& f) {
    return c.frame_ns + c.query_ns * f.queries + c.box_ns * f.boxes + c.pixel_ns * f.pixels +
           c.draw_ns * f.draws;
}

TEST(AnswerCostsFit, finds_the_costs_that_made_the_times) {
    const AnswerCosts truth{40'000, 3'000, 700, 1.5, 900};
    Uniform uniform(5);
    std::vector<AskedFrame> frames;
    for (int i = 0; i < 20; ++i) {
        AskedFrame f;
        f.queries = std::round(uniform.log(1, 500));
        f.boxes = f.queries * std::round(uniform.log(1, 20));
        f.pixels = f.boxes * uniform.log(4, 5000);
        f.draws = std::round(uniform(0, 3) * f.queries);
        f.ns = predicted(truth, f);
        frames.push_back(f);
    }
    const AnswerCosts fit = fit_answer_costs(frames);
    EXPECT_NEAR(fit.frame_ns / truth.frame_ns, 1.0, 0.02);
    EXPECT_NEAR(fit.query_ns / truth.query_ns, 1.0, 0.02);
    EXPECT_NEAR(fit.box_ns / truth.box_ns, 1.0, 0.02);
    EXPECT_NEAR(fit.pixel_ns / truth.pixel_ns, 1.0, 0.02);
    EXPECT_NEAR(fit.draw_ns / truth.draw_ns, 1.0, 0.02);
}

TEST(AnswerCostsFit, no_cost_is_negative_and_what_never_varied_is_free) {
    std::vector<AskedFrame> frames;
    for (const double q : {10.0, 100.0, 300.0}) {
        AskedFrame f;
        f.queries = q;
        f.boxes = q * q;
        f.ns = 5'000.0 * q - 2.0 * q * q;
        frames.push_back(f);
    }
    const AnswerCosts fit = fit_answer_costs(frames);
    EXPECT_EQ(fit.box_ns, 0.0);
    EXPECT_EQ(fit.draw_ns, 0.0);
    EXPECT_EQ(fit.pixel_ns, 0.0);
    EXPECT_GT(fit.query_ns, 3'000.0);
    EXPECT_GE(fit.frame_ns, 0.0);
}

TEST_F(GlTest, answers_have_a_price_by_either_way) {
    RenderTarget large = RenderTarget::create(640, 360).value();
    const WallTimer clock;
    const Result<MeasuredAnswerCosts> measured = measure_answer_costs(large, {.longest_s = 0.3, .rounds = 5});
    ASSERT_TRUE(measured.ok()) << measured.error().message;
    EXPECT_LT(clock.elapsed_ms(), 20'000.0);
    for (const AnswerCosts& costs : {measured->costs.hardware, measured->costs.box_pass}) {
        EXPECT_GE(costs.frame_ns, 0.0);
        EXPECT_GE(costs.pixel_ns, 0.0);
        EXPECT_GE(costs.draw_ns, 0.0);
        EXPECT_GT(costs.query_ns + costs.box_ns, 0.0);
        EXPECT_LT(costs.query_ns + costs.box_ns, 1e7);
    }
    EXPECT_EQ(measured->frames.size() % 2, 0u);
}

}  // namespace
}  // namespace rhview::gl
