// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Collects placed triangles into static batches, one per material and vertex format, and meshes with their
/// places.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/scenes/scene.h"

namespace rhview {

/// Triangles in their own space, owned by the caller. `normals` and `colours` are empty or one per position.
/// `indices.size()` is a multiple of three, every index is below `positions.size()`.
struct MeshPiece {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals;  ///< unit; a zero or non-finite one is replaced by +y
    std::span<const PackedColour> colours;
    std::span<const std::uint32_t> indices;
};

/// Add materials first, then what they draw, then `finish`.
class SceneBuilder {
  public:
    /// Positions are stored relative to `origin`.
    explicit SceneBuilder(const glm::dvec3& origin = glm::dvec3(0.0));

    /// Numbered from 0; equal ones are not joined.
    MaterialId add_material(Material material);

    /// Adds one static object: only the vertices that its triangles use are stored, in order of first use.
    /// Triangles with a non-finite corner are dropped and counted. A mirroring transform swaps each
    /// triangle's last two indices, so that the outside stays outside. An object without triangles adds
    /// nothing.
    void add_static(MaterialId material, const MeshPiece& piece,
                    const glm::dmat4& world_from_piece = glm::dmat4(1.0));

    /// Adds a mesh for dynamic objects and instances, in its own space; nothing if no finite triangle is
    /// left.
    std::optional<MeshId> add_mesh(MaterialId material, const MeshPiece& piece);
    /// An object that the application may move; here it stands still.
    void add_dynamic(MeshId mesh, const glm::dmat4& world_from_mesh);
    /// One that moves, from there.
    void add_dynamic(MeshId mesh, const glm::dmat4& world_from_mesh, ObjectMotion motion);
    /// Places a mesh that does not move, without copying it. False, and nothing is added, where it can't be
    /// drawn through that map (flat, strongly sheared, not affine, out of float's range): `add_static` it
    /// then.
    bool add_instance(MeshId mesh, const glm::dmat4& world_from_mesh);

    /// For `Scene::warnings`: what was wrong with the source, and what was done about it.
    void add_warning(std::string sentence);

    /// Room for what is about to be added to the pool and batch of this material and format.
    void reserve(MaterialId material, bool normals, bool colours, std::size_t vertices, std::size_t indices);

    /// The scene, or an error when nothing drawable was added or a pool has more than 2^32 - 1 vertices or
    /// indices. The builder is empty afterwards.
    Result<Scene> finish(std::string name);

  private:
    std::uint32_t pool_for(bool normals, bool colours);
    SceneBatch& batch_for(MaterialId material, std::uint32_t pool);
    void append(const MeshPiece& piece, const glm::dmat4& target_from_piece, std::uint32_t pool,
                std::vector<std::uint32_t>& indices, Aabb& bounds);

    Scene scene_;
    std::vector<std::pair<std::size_t, std::size_t>> mesh_vertices_;  ///< first and end in the mesh's pool
    std::vector<std::uint32_t> pool_of_format_;                       ///< [normals + 2 * colours]
    std::vector<std::uint32_t> batch_of_;                             ///< [material * 4 + format]
    std::vector<std::uint32_t> new_index_;  ///< scratch, all unset between calls: piece vertex -> pool vertex
    std::array<std::size_t, 4> reserved_vertices_{};  ///< by format
    bool too_large_ = false;
};

}  // namespace rhview
