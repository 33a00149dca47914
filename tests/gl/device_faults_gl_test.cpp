// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// A device without memory, and a context that was lost: told in a sentence, nothing crashes, nothing is left
// behind. libepoxy's entries are pointers, which these tests bend.

#include <epoxy/gl.h>

#include <map>
#include <string>
#include <utility>

#include "occlusion_fixture.h"
#include "rhview/gl/item_buffer.h"
#include "soak/device_objects.h"

namespace rhview::gl {
namespace {

/// Puts an entry back when it goes.
template <class Function>
class BentEntry {
  public:
    BentEntry(Function& entry, Function instead) : entry_(entry), honest_(entry) { entry = instead; }
    ~BentEntry() { entry_ = honest_; }
    BentEntry(const BentEntry&) = delete;
    BentEntry& operator=(const BentEntry&) = delete;

  private:
    Function& entry_;
    Function honest_;
};

/// What stands in for the driver: one at a time.
struct Bent {
    PFNGLBUFFERDATAPROC buffer_data;
    PFNGLBUFFERSTORAGEPROC buffer_storage;
    PFNGLRENDERBUFFERSTORAGEPROC renderbuffer_storage;
    PFNGLGETERRORPROC get_error;
    int until_failure = 0;  ///< allocations that still succeed
    int failures = 0;
    bool flagged = false;
};
Bent bent;

bool allocates() {
    if (bent.until_failure-- != 0) return true;
    ++bent.failures;
    bent.flagged = true;
    return false;
}

/// One allocation of the device fails while it lives: the object stays as it was, without storage.
class DeviceShortage {
  public:
    explicit DeviceShortage(int after) : honest_(keep_honest(after)) {}
    [[nodiscard]] static bool struck() { return bent.failures > 0; }

  private:
    static bool keep_honest(int after) {
        bent = {epoxy_glBufferData,
                epoxy_glBufferStorage,
                epoxy_glRenderbufferStorage,
                epoxy_glGetError,
                after,
                0,
                false};
        return true;
    }

    bool honest_;  // before any entry is bent
    BentEntry<PFNGLBUFFERDATAPROC> buffer_data_{
        epoxy_glBufferData, [](GLenum target, GLsizeiptr size, const void* data, GLenum usage) {
            if (allocates()) bent.buffer_data(target, size, data, usage);
        }};
    BentEntry<PFNGLBUFFERSTORAGEPROC> buffer_storage_{
        epoxy_glBufferStorage, [](GLenum target, GLsizeiptr size, const void* data, GLbitfield flags) {
            if (allocates()) bent.buffer_storage(target, size, data, flags);
        }};
    BentEntry<PFNGLRENDERBUFFERSTORAGEPROC> renderbuffer_storage_{
        epoxy_glRenderbufferStorage, [](GLenum target, GLenum format, GLsizei width, GLsizei height) {
            if (allocates()) bent.renderbuffer_storage(target, format, width, height);
        }};
    BentEntry<PFNGLGETERRORPROC> get_error_{epoxy_glGetError, []() -> GLenum {
                                                const GLenum error = bent.get_error();
                                                if (!std::exchange(bent.flagged, false)) return error;
                                                return GL_OUT_OF_MEMORY;
                                            }};
};

class DeviceFaults : public OcclusionTest {
  protected:
    void SetUp() override {
        OcclusionTest::SetUp();
        // libepoxy finds an entry at its first call: so that it does not find it while it is bent.
        cells_ = CellMaker(7).make(60, 12.0);
        QueryPlanner planner;
        const SceneBuffers buffers = SceneBuffers::upload(cells_.scene).value();
        depths_of(planner.plan(cells_.cells), buffers, view_);
        answers();
        EXPECT_TRUE(check_device().ok());
        EXPECT_EQ(take_error(), "");
    }

    CellScene cells_;
    View view_ = view_at({0, 0, 14}, {0, 0, -1});
};

/// Runs `make` with the first, second… allocation failing, until none does.
template <class Make>
int fail_each(const Make& make) {
    int failed = 0;
    for (bool struck = true; struck; ++failed) {
        const DeviceObjects before = count_device_objects();
        {
            const DeviceShortage shortage(failed);
            auto result = make();
            struck = DeviceShortage::struck();
            EXPECT_EQ(result.ok(), !struck) << failed;
            if (!result.ok()) {
                EXPECT_GT(result.error().message.size(), 20u);
            }
        }
        take_error();
        EXPECT_EQ(count_device_objects(), before) << failed;
    }
    return failed - 1;
}

TEST_F(DeviceFaults, a_scene_that_the_device_has_no_memory_for_is_an_error_and_leaves_nothing) {
    EXPECT_GE(fail_each([&] { return SceneBuffers::upload(cells_.scene); }), 2);
    const DeviceShortage shortage(0);
    const Result<SceneBuffers> refused = SceneBuffers::upload(cells_.scene);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message.find("out of memory"), std::string::npos) << refused.error().message;
}

TEST_F(DeviceFaults, pictures_that_the_device_has_no_memory_for_are_errors_and_leave_nothing) {
    EXPECT_EQ(fail_each([] { return RenderTarget::create(64, 48); }), 2);
    EXPECT_EQ(fail_each([] { return ItemBuffer::create(64, 48); }), 2);
}

TEST_F(DeviceFaults, frames_after_one_without_memory_are_whole) {
    const SceneBuffers buffers = SceneBuffers::upload(cells_.scene).value();
    const std::vector<float> whole = depths_of(everything(cells_.cells), buffers, view_);
    int failed = 0;
    for (bool struck = true; struck; ++failed) {
        Executor fresh = Executor::create().value();
        std::swap(*executor_, fresh);  // its buffers are made in the frame that fails
        QueryPlanner planner;
        const FramePlan plan = planner.plan(cells_.cells);
        {
            const DeviceShortage shortage(failed);
            depths_of(plan, buffers, view_);
            struck = DeviceShortage::struck();
            EXPECT_EQ(take_error(), struck ? "out of memory" : "") << failed;
        }
        finish();
        std::vector<QueryAnswer> of_failed;
        executor_->poll_answers(of_failed);
        EXPECT_EQ(count_missing_pixels(depths_of(planner.plan(cells_.cells), buffers, view_), whole), 0u)
            << failed;
        answers();
        EXPECT_EQ(take_error(), "");
    }
    EXPECT_GE(failed, 3);
}

// A context that was lost says that every result is there, and gives none; its errors never end.
TEST_F(DeviceFaults, a_lost_context_is_told_and_says_of_nothing_that_it_is_hidden) {
    const SceneBuffers buffers = SceneBuffers::upload(cells_.scene).value();
    QueryPlanner planner{.box_pass = false};
    const FramePlan plan = planner.plan(cells_.cells);
    depths_of(plan, buffers, view_);
    {
        const BentEntry<PFNGLGETGRAPHICSRESETSTATUSPROC> status(
            epoxy_glGetGraphicsResetStatus, []() -> GLenum { return GL_INNOCENT_CONTEXT_RESET; });
        const BentEntry<PFNGLGETERRORPROC> error(epoxy_glGetError,
                                                 []() -> GLenum { return GL_CONTEXT_LOST; });
        const BentEntry<PFNGLGETQUERYOBJECTUIVPROC> available(
            epoxy_glGetQueryObjectuiv, [](GLuint, GLenum, GLuint* value) { *value = GL_TRUE; });
        const BentEntry<PFNGLGETQUERYOBJECTUI64VPROC> result(epoxy_glGetQueryObjectui64v,
                                                             [](GLuint, GLenum, GLuint64*) {});
        const Status lost = check_device();
        ASSERT_FALSE(lost.ok());
        EXPECT_NE(lost.error().message.find("make the context and everything in it anew"), std::string::npos);
        EXPECT_EQ(take_error(), "context lost");
        const Result<SceneBuffers> refused = SceneBuffers::upload(cells_.scene);
        ASSERT_FALSE(refused.ok());
        EXPECT_NE(refused.error().message.find("context lost"), std::string::npos);
        std::vector<QueryAnswer> answers;
        executor_->poll_answers(answers);
        EXPECT_EQ(answers.size(), plan.queries.size());
        for (const QueryAnswer& answer : answers) EXPECT_TRUE(answer.visible) << answer.ticket;
    }
    EXPECT_TRUE(check_device().ok());
    take_error();
}

// The other way to lose one: nothing is ever answered, and nothing waits for it.
TEST_F(DeviceFaults, queries_that_are_never_answered_count_as_visible_after_their_time) {
    const SceneBuffers buffers = SceneBuffers::upload(cells_.scene).value();
    executor_.emplace(Executor::create({.lost_after_frames = 5}).value());
    QueryPlanner planner;
    std::size_t asked = 0, visible = 0;
    {
        const BentEntry<PFNGLGETQUERYOBJECTUIVPROC> available(
            epoxy_glGetQueryObjectuiv, [](GLuint, GLenum, GLuint* value) { *value = GL_FALSE; });
        const BentEntry<PFNGLGETSYNCIVPROC> fence(epoxy_glGetSynciv,
                                                  [](GLsync, GLenum, GLsizei, GLsizei* length, GLint* value) {
                                                      if (length != nullptr) *length = 1;
                                                      *value = GL_UNSIGNALED;
                                                  });
        const BentEntry<PFNGLCLIENTWAITSYNCPROC> wait(
            epoxy_glClientWaitSync,
            [](GLsync, GLbitfield, GLuint64) -> GLenum { return GL_TIMEOUT_EXPIRED; });
        for (int frame = 0; frame < 30; ++frame) {
            const FramePlan plan = planner.plan(cells_.cells);
            if (frame < 10) asked += plan.queries.size();
            depths_of(frame < 10 ? plan : everything(cells_.cells), buffers, view_);
            std::vector<QueryAnswer> answers;
            executor_->poll_answers(answers);
            for (const QueryAnswer& answer : answers) visible += answer.visible ? 1 : 0;
        }
    }
    EXPECT_EQ(visible, asked);
    EXPECT_EQ(executor_->answer_counters().lost, asked);
    EXPECT_EQ(executor_->answer_counters().blocking_reads, 0u);
}

}  // namespace
}  // namespace rhview::gl
