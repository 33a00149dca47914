// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Every method in every mode, made ready to draw a scene.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rhview/baselines/interactive_method.h"
#include "rhview/gl/stepped_executor.h"
#include "rhview/scenes/scene.h"

namespace rhview {

/// Leaves of few triangles, so that small scenes have many nodes.
RhOctree catalogue_octree(const Scene& scene);

/// What methods draw with: one of each for all.
struct CatalogueDevice {
    gl::Executor& executor;
    gl::SteppedExecutor& stepped;
};

class CatalogueMethod {
  public:
    std::string name;
    /// Frames that the camera has to stand until every pixel is promised: 1, but in latent mode.
    int frames_to_promise = 1;

    std::unique_ptr<RhOctree> octree;
    std::unique_ptr<FramePlanner> planner;
    std::unique_ptr<InteractiveMethod> interactive;  ///< instead of a planner
    gl::SceneBuffers buffers;
    std::vector<std::uint32_t> object_indices;  ///< that its occlusion culling reads

    /// Draws a frame into the bound target; its answers, if it asked, come before the next.
    gl::FrameCounters draw(const FrameInput& input, CatalogueDevice& device, gl::Submission submission);

    /// What draws the last frame's picture again.
    [[nodiscard]] FramePlan last_plan() const;

    std::uint64_t hidden = 0;  ///< answers that nothing was seen

  private:
    FramePlan plan_;
    DrawnFrame drawn_;
    std::vector<QueryAnswer> answers_;
};

/// `is_large`: those whose draws are few whatever the scene has.
std::vector<CatalogueMethod> catalogue_methods(const Scene& scene, bool is_large);

/// The scene whole, from buffers in its own order.
FramePlan everything_of(const Scene& scene, const FrameInput& input);

}  // namespace rhview
