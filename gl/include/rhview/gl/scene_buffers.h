// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A scene in the driver's memory: one vertex buffer per vertex format, one index buffer, a vertex array per
/// format.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/gl/handle.h"
#include "rhview/scenes/scene.h"

namespace rhview::gl {

/// What one batch or object needs to be drawn.
struct DrawState {
    std::uint32_t vertex_array = 0;
    glm::vec3 colour{1.0f};
    bool vertex_colours = false;
    bool two_sided = false;
};

struct ObjectInstance {
    DrawState state;
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    glm::dmat4 scene_from_mesh{1.0};
};

class SceneBuffers {
  public:
    /// Copies the scene. `static_indices` replaces those of the static batches (`RhOctree::indices`: batch
    /// after batch, then replicas); empty keeps the scene's own. An error when the driver's memory is too
    /// small.
    static Result<SceneBuffers> upload(const Scene& scene,
                                       std::span<const std::uint32_t> static_indices = {});

    [[nodiscard]] const glm::dvec3& origin() const { return origin_; }
    [[nodiscard]] std::span<const DrawState> batches() const { return batches_; }
    /// By `ObjectId`, as `Scene` numbers them.
    [[nodiscard]] std::span<const ObjectInstance> objects() const { return objects_; }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

  private:
    Buffer indices_;
    std::vector<Buffer> vertices_;
    std::vector<VertexArray> vertex_arrays_;
    std::vector<DrawState> batches_;
    std::vector<ObjectInstance> objects_;
    glm::dvec3 origin_{0.0};
    std::uint64_t bytes_ = 0;
};

}  // namespace rhview::gl
