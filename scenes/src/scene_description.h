// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Section SCNE of a baked file: everything of a scene but its long arrays, which have sections of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rhview/scenes/baked_scene.h"

namespace rhview {

struct PoolRecord {
    std::uint64_t vertices = 0;
    bool normals = false;
    bool colours = false;
};

struct BatchRecord {
    MaterialId material{};
    std::uint32_t pool = 0;
    std::uint64_t indices = 0;
    std::uint64_t objects = 0;
};

struct MeshRecord {
    MaterialId material{};
    std::uint32_t pool = 0;
    std::uint64_t indices = 0;
    Aabb bounds;
};

struct SceneDescription {
    SceneProvenance provenance;
    std::string name;
    std::uint64_t static_triangles = 0;
    std::uint64_t dynamic_triangles = 0;
    std::uint64_t dropped_triangles = 0;
    glm::dvec3 origin{0.0};
    std::vector<std::string> warnings;
    std::vector<Material> materials;
    std::vector<PoolRecord> pools;
    std::vector<BatchRecord> batches;
    std::vector<MeshRecord> meshes;
    std::vector<DynamicObject> dynamic_objects;
    std::vector<ObjectMotion> motions;
    std::vector<StaticInstance> static_instances;
    InstancingReport instancing;
    CameraPath path;
};

/// Versions of the section: 1 had no instances and is read no more, 2 had no motions.
inline constexpr std::uint32_t kMotionsVersion = 3;
inline constexpr std::uint32_t kOldestDescription = 2;

SceneDescription describe(const SceneAndPath& scene, const SceneProvenance& provenance);

std::vector<std::byte> to_bytes(const SceneDescription& description);

/// Nothing when the bytes end too early or too late, or a count leaves them: no value is looked at beyond
/// that.
std::optional<SceneDescription> parse_description(std::span<const std::byte> bytes, std::uint32_t version);

}  // namespace rhview
