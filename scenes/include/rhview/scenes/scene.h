// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// A scene as the program and the tests hold it: materials, static batches, meshes and the objects that place
/// them.
///
/// Conventions: positions are `float`, relative to `Scene::origin`; metres; front faces counter-clockwise.
/// Every vertex is stored once: batches and meshes hold indices into a pool.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/ids.h"
#include "rhview/base/mappable_array.h"
#include "rhview/base/triangle_batch.h"

namespace rhview {

/// What the program's own renderer knows of a surface; rhview needs `two_sided` alone.
struct Material {
    std::string name;
    glm::vec3 colour{0.8f};     ///< linear RGB
    bool two_sided = false;     ///< both sides are drawn: no back-face culling
    bool alpha_tested = false;  ///< has holes: never an occluder
};

/// Unit normal, three signed 10-bit components (x in the low bits): OpenGL's GL_INT_2_10_10_10_REV.
enum class PackedNormal : std::uint32_t {};
/// Nearest that fits, of a unit vector.
PackedNormal pack_normal(const glm::vec3& unit_normal);
/// About unit length.
glm::vec3 unpack_normal(PackedNormal normal);

/// Linear RGBA, 8 bits each, red in the low byte.
enum class PackedColour : std::uint32_t {};
/// Nearest that fits, opaque; clamped to 0 … 1.
PackedColour pack_colour(const glm::vec3& colour);

/// The vertices of one vertex format. `normals` and `colours` are empty or as long as `positions`; without
/// normals a surface is shaded flat, without colours it takes its material's.
struct VertexPool {
    MappableArray<glm::vec3> positions;
    MappableArray<PackedNormal> normals;
    MappableArray<PackedColour> colours;

    /// Of its vertices, as stored.
    [[nodiscard]] std::size_t bytes() const;
};

/// What the scene's author placed as one thing: a contiguous part of its batch's indices.
using SceneObject = BatchObject;

/// Static triangles of one material in one vertex format; its objects cover `indices` in order, without gaps.
struct SceneBatch {
    MaterialId material{};
    std::uint32_t pool = 0;
    MappableArray<std::uint32_t> indices;
    MappableArray<SceneObject> objects;
};

/// A mesh that several objects or static instances share, in its own space.
struct SceneMesh {
    MaterialId material{};
    std::uint32_t pool = 0;
    MappableArray<std::uint32_t> indices;
    Aabb bounds;
};

/// A place on the way of a moving object, relative to where it starts.
struct MotionKey {
    double time_s = 0.0;
    glm::dvec3 offset{0.0};  ///< of its origin
    double turns = 0.0;      ///< about +y through its origin, whole turns
};

/// A closed way: between keys offset and turns change linearly, after the last one it begins again. The first
/// key is the start (time, offset and turns 0); times rise; the last has the offset of the first, and has
/// turned a whole number of times.
struct ObjectMotion {
    std::vector<MotionKey> keys;
};

/// A placed mesh that is not merged into the static batches.
struct DynamicObject {
    static constexpr std::uint32_t kStill = 0xffffffffu;

    MeshId mesh{};
    glm::dmat4 scene_from_mesh{1.0};  ///< affine, relative to `Scene::origin`, at time 0
    std::uint32_t motion = kStill;    ///< into `Scene::motions`
};

/// A mesh where the scene's author placed it, kept apart from the batches: stored once, culled by its box and
/// drawn whole.
struct StaticInstance {
    MeshId mesh{};
    glm::dmat4 scene_from_mesh{1.0};  ///< affine and invertible, relative to `Scene::origin`
    Aabb bounds;                      ///< of its vertices as placed, rounded outwards
};

/// What became of the meshes that a scene's author placed more than once, and what either way takes. Bytes
/// are those of vertices and indices; times those of `InstanceCosts`' model, a frame.
struct InstancingReport {
    std::uint64_t flattened_meshes = 0;
    std::uint64_t flattened_placements = 0;
    std::uint64_t flattened_bytes = 0;  ///< what their placements take in the batches
    std::uint64_t kept_meshes = 0;
    std::uint64_t kept_placements = 0;
    std::uint64_t kept_bytes = 0;           ///< stored once each
    std::uint64_t all_flattened_bytes = 0;  ///< had every placement been flattened
    std::uint64_t budget_bytes = 0;         ///< what `flattened_bytes` was allowed to be
    double all_kept_ns = 0.0;
    double all_flattened_ns = 0.0;
    double chosen_ns = 0.0;

    friend bool operator==(const InstancingReport&, const InstancingReport&) = default;
};

/// All of it, as importers and named scenes give it.
struct Scene {
    std::string name;
    glm::dvec3 origin{0.0};  ///< world position of the scene's zero
    std::vector<Material> materials;
    std::vector<VertexPool> pools;
    std::vector<SceneBatch> batches;
    std::vector<SceneMesh> meshes;
    std::vector<DynamicObject> dynamic_objects;
    std::vector<ObjectMotion> motions;  ///< where dynamic objects go: see `object_motion.h`
    std::vector<StaticInstance> static_instances;
    InstancingReport instancing;
    std::uint64_t dropped_triangles = 0;  ///< not finite, left out by the import
    std::vector<std::string> warnings;    ///< one sentence each

    /// Of the static batches, without instances.
    [[nodiscard]] std::uint64_t batch_triangles() const;
    [[nodiscard]] std::uint64_t instance_triangles() const;  ///< of the static instances, as placed
    [[nodiscard]] std::uint64_t static_triangles() const;    ///< both
    [[nodiscard]] std::uint64_t dynamic_triangles() const;   ///< as placed
    [[nodiscard]] std::uint64_t static_objects() const;      ///< in batches and as instances
    [[nodiscard]] std::uint64_t vertex_count() const;        ///< as stored
    /// Of all pools.
    [[nodiscard]] std::uint64_t vertex_bytes() const;
    [[nodiscard]] std::uint64_t index_bytes() const;  ///< of batches and meshes, as stored
    /// What is drawn object by object has an `ObjectId`: the dynamic objects first, then the static
    /// instances.
    [[nodiscard]] std::size_t object_count() const;
    /// Which mesh an object draws.
    [[nodiscard]] MeshId object_mesh(ObjectId object) const;
    [[nodiscard]] const glm::dmat4& object_placement(ObjectId object) const;  ///< at time 0
    [[nodiscard]] std::vector<Aabb> object_boxes() const;                     ///< at time 0
    /// Box of everything, static and dynamic, relative to `origin`.
    [[nodiscard]] Aabb bounds() const;
    /// The static batches as spans into this scene; batch i is `BatchId{i}`.
    [[nodiscard]] std::vector<TriangleBatch> triangle_batches() const;
};

}  // namespace rhview
