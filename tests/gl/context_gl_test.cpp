// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/context.h"

#include <epoxy/gl.h>

#include <string>

#include "gl_fixture.h"
#include "rhview/base/log.h"
#include "rhview/gl/timer.h"

namespace rhview::gl {
namespace {

std::string logged;

TEST_F(GlTest, headless_context_names_its_device) {
    EXPECT_FALSE(context_->device().renderer.empty());
    EXPECT_FALSE(context_->device().version.empty());
    EXPECT_GE(epoxy_gl_version(), 43);
    EXPECT_EQ(context_->device().clip_control, epoxy_gl_version() >= 45);
}

TEST_F(GlTest, a_reset_of_the_device_would_be_told) {
    EXPECT_TRUE(check_device().ok());
    GLint strategy = 0;
    glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
    EXPECT_EQ(context_->device().tells_loss, strategy == GL_LOSE_CONTEXT_ON_RESET);
    if (context_->device().renderer.find("llvmpipe") != std::string::npos) {
        EXPECT_TRUE(context_->device().box_pass);
    }
    EXPECT_EQ(context_->device().box_pass, executor_->has_box_pass());
}

TEST(ResetStatus, has_a_sentence_for_each_cause) {
    EXPECT_EQ(describe_reset(GL_NO_ERROR), "");
    EXPECT_NE(describe_reset(GL_GUILTY_CONTEXT_RESET).find("what this context drew"), std::string::npos);
    EXPECT_NE(describe_reset(GL_INNOCENT_CONTEXT_RESET).find("another program"), std::string::npos);
    EXPECT_NE(describe_reset(GL_UNKNOWN_CONTEXT_RESET).find("was reset"), std::string::npos);
}

TEST_F(GlTest, drivers_debug_messages_reach_the_log) {
    const LogCallback previous = set_log_callback([](LogLevel level, std::string_view message) {
        if (level == LogLevel::Error) logged = message;
    });
    logged.clear();
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glEnable(GL_TEXTURE_2D + 12345);
    EXPECT_FALSE(logged.empty());
    EXPECT_EQ(take_error(), "invalid enum");
    EXPECT_EQ(take_error(), "");
    set_log_callback(previous);
}

TEST_F(GlTest, a_context_of_the_application_is_described_and_left_alone) {
    {
        const Result<Context> adopted = Context::adopt_current();
        ASSERT_TRUE(adopted.ok()) << adopted.error().message;
        EXPECT_EQ(adopted->device().renderer, context_->device().renderer);
        EXPECT_EQ(adopted->device().clip_control, context_->device().clip_control);
    }
    EXPECT_TRUE(check_device().ok());
    EXPECT_EQ(take_error(), "");
    EXPECT_NE(glGetString(GL_VERSION), nullptr);
}

TEST(Context, that_is_not_current_is_not_adopted) {
    const Result<Context> adopted = Context::adopt_current();
    ASSERT_FALSE(adopted.ok());
    EXPECT_NE(adopted.error().message.find("make the window's context current"), std::string::npos);
}

TEST_F(GlTest, contexts_come_and_go) {
    for (int i = 0; i < 3; ++i) {
        target_.reset();
        executor_.reset();
        context_.reset();
        Result<Context> again = Context::create_headless();
        ASSERT_TRUE(again.ok());
        context_.emplace(std::move(again).value());
        ASSERT_TRUE(Executor::create().ok());
    }
}

TEST_F(GlTest, gpu_timer_of_a_software_renderer_is_not_believed) {
    const Result<TimerCheck> check = check_gpu_timer();
    ASSERT_TRUE(check.ok());
    EXPECT_GE(check->gpu_share, 0.0);
    const bool llvmpipe = context_->device().renderer.find("llvmpipe") != std::string::npos;
    EXPECT_FALSE(llvmpipe && check->gpu_timer_is_whole()) << "llvmpipe's timer leaves vertex work out";
}

TEST(TimerCheck, agrees_only_within_its_bounds) {
    EXPECT_TRUE((TimerCheck{0.97}).gpu_timer_is_whole());
    EXPECT_FALSE((TimerCheck{0.001}).gpu_timer_is_whole());
    EXPECT_FALSE((TimerCheck{1.5}).gpu_timer_is_whole());
}

TEST_F(GlTest, impossible_picture_sizes_are_refused) {
    for (const auto& [width, height] : {std::pair{0, 10}, {10, 0}, {-1, 5}, {1 << 30, 10}}) {
        const Result<RenderTarget> target = RenderTarget::create(width, height);
        ASSERT_FALSE(target.ok());
        EXPECT_NE(target.error().message.find("each side must be from 1 to"), std::string::npos);
    }
    EXPECT_TRUE(RenderTarget::create(1, 1).ok());
}

}  // namespace
}  // namespace rhview::gl
