// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "vertex_error.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "rhview/base/rounding.h"

namespace rhview {
namespace {

using Long3 = glm::vec<3, long double>;
using Long4 = glm::vec<4, long double>;
using LongMatrix3 = glm::mat<3, 3, long double>;
using LongMatrix4 = glm::mat<4, 4, long double>;

bool in_view(const Long4& clip, ClipDepth depth) {
    const long double near = depth == ClipDepth::NegativeOneToOne ? clip.z + clip.w
                             : depth == ClipDepth::ZeroToOne      ? clip.z
                                                                  : clip.w - clip.z;
    return clip.w > 0.0L && near >= 0.0L && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
}

}  // namespace

// The float side is `gl::Executor`'s vertex shader.
double worst_vertex_error_px(const Scene& scene, const View& view, double width, double height) {
    const LongMatrix3 axes{LongMatrix4(view.camera_from_world)};
    const Long3 eye =
        -(glm::inverse(axes) * Long3(LongMatrix4(view.camera_from_world)[3])) - Long3(scene.origin);
    const LongMatrix4 exact_clip = LongMatrix4(view.clip_from_camera) * LongMatrix4(axes);
    const SplitPosition split = split_position(view.eye() - scene.origin);
    const glm::mat4 clip(view.clip_from_eye_relative());
    long double worst = 0.0L;
    for (const SceneBatch& batch : scene.batches)
        for (const std::uint32_t index : batch.indices) {
            const glm::vec3 position = scene.pools[batch.pool].positions[index];
            const Long4 exact = exact_clip * Long4(Long3(position) - eye, 1.0L);
            if (!in_view(exact, view.clip_depth)) continue;
            const Long4 drawn(clip * glm::vec4((position - split.high) - split.low, 1.0f));
            worst = std::max({worst, std::abs(drawn.x / drawn.w - exact.x / exact.w) * 0.5L * width,
                              std::abs(drawn.y / drawn.w - exact.y / exact.w) * 0.5L * height});
        }
    return static_cast<double>(worst);
}

}  // namespace rhview
