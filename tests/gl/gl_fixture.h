// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "rhview/gl/context.h"
#include "rhview/gl/executor.h"
#include "rhview/gl/render_target.h"
#include "rhview/scenes/scene_builder.h"

namespace rhview::gl {

/// A debug context, an executor and a small picture; the driver must have reported no error at the end.
class GlTest : public testing::Test {
  protected:
    void SetUp() override {
        Result<Context> context = Context::create_headless({.debug = true});
        ASSERT_TRUE(context.ok()) << context.error().message;
        context_.emplace(std::move(context).value());
        executor_.emplace(Executor::create().value());
        target_.emplace(RenderTarget::create(160, 120).value());
    }
    void TearDown() override {
        EXPECT_EQ(take_error(), "");
        target_.reset();
        executor_.reset();
    }

    std::vector<float> depths_of(const FramePlan& plan, const SceneBuffers& buffers, const View& view,
                                 const DrawOptions& options = {}) {
        target_->begin(view.clip_depth, glm::vec3(0.0f));
        counters_ = executor_->draw(plan, buffers, view, options);
        std::vector<float> depths;
        target_->read_depth(depths);
        return depths;
    }

    std::optional<Context> context_;
    std::optional<Executor> executor_;
    std::optional<RenderTarget> target_;
    FrameCounters counters_;
};

inline View view_at(const glm::dvec3& eye, const glm::dvec3& forward,
                    ClipDepth depth = ClipDepth::NegativeOneToOne, double far = 1000.0) {
    return {look_along(eye, forward, {0.0, 1.0, 0.0}), perspective(1.0, 4.0 / 3.0, 0.1, far, depth), depth};
}

/// Number of pixels that something was drawn to.
inline std::size_t covered_pixels(const std::vector<float>& depths,
                                  ClipDepth depth = ClipDepth::NegativeOneToOne) {
    const float farthest = depth == ClipDepth::ReversedZeroToOne ? 0.0f : 1.0f;
    std::size_t covered = 0;
    for (const float d : depths) covered += d != farthest;
    return covered;
}

/// A triangle 5 m ahead of the origin along -z, facing it.
inline const std::vector<glm::vec3> kTrianglePositions{{-1, -1, -5}, {1, -1, -5}, {0, 1, -5}};
inline const std::vector<std::uint32_t> kTriangleIndices{0, 1, 2};
inline MeshPiece triangle_piece() {
    return {kTrianglePositions, {}, {}, kTriangleIndices};
}

}  // namespace rhview::gl
