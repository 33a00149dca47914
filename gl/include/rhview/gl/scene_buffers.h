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

/// A part of an index buffer.
struct LevelRange {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
};

/// Coarser levels of a mesh, level 1 first: ranges of `indices`, which name the mesh's own vertices.
struct MeshLevels {
    std::span<const std::uint32_t> indices;
    std::span<const LevelRange> levels;
};

/// What the objects of a mesh share.
struct MeshState {
    DrawState state;
    std::uint32_t instanced_array = 0;  ///< the same vertices, and places of instances
    LevelRange whole;                   ///< full detail
};

/// Owns what the driver holds of one scene; the scene itself may go.
class SceneBuffers {
  public:
    /// Copies the scene. `static_indices` replaces those of the static batches (`RhOctree::indices`: batch
    /// after batch, then replicas); empty keeps the scene's own. `levels` by mesh; a mesh beyond the end has
    /// full detail only. An error when the driver's memory is too small.
    static Result<SceneBuffers> upload(const Scene& scene, std::span<const std::uint32_t> static_indices = {},
                                       std::span<const MeshLevels> levels = {});

    [[nodiscard]] const glm::dvec3& origin() const { return origin_; }
    [[nodiscard]] std::span<const DrawState> batches() const { return batches_; }
    [[nodiscard]] std::span<const MeshState> meshes() const { return meshes_; }
    /// Meshes of the objects, by `ObjectId`, as `Scene` numbers them.
    [[nodiscard]] std::span<const std::uint32_t> object_meshes() const { return object_meshes_; }
    /// Where the objects are at time 0, by `ObjectId`.
    [[nodiscard]] std::span<const glm::dmat4> placements() const { return placements_; }
    /// The indices of a mesh at a level of detail; the coarsest where there is no such level.
    [[nodiscard]] LevelRange level_range(std::uint32_t mesh, std::uint32_t level) const;
    /// The largest `rounding_growth` of `placements`.
    [[nodiscard]] double largest_growth() const { return largest_growth_; }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

  private:
    std::vector<std::uint32_t> write_indices(const Scene& scene,
                                             std::span<const std::uint32_t> static_indices,
                                             std::span<const MeshLevels> levels, std::size_t bytes);
    void make_vertex_arrays(const Scene& scene);
    void list_objects(const Scene& scene, std::span<const std::uint32_t> first_of_mesh);

    Buffer indices_;
    std::vector<Buffer> vertices_;
    std::vector<VertexArray> vertex_arrays_;
    std::vector<VertexArray> instanced_arrays_;  ///< by pool
    std::vector<LevelRange> levels_;             ///< of all meshes, coarser ones
    std::vector<std::uint32_t> first_level_;     ///< by mesh, into `levels_`; one more at the end
    std::vector<DrawState> batches_;
    std::vector<MeshState> meshes_;
    std::vector<std::uint32_t> object_meshes_;
    std::vector<glm::dmat4> placements_;
    glm::dvec3 origin_{0.0};
    double largest_growth_ = 1.0;
    std::uint64_t bytes_ = 0;
};

}  // namespace rhview::gl
