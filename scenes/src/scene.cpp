// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/scene.h"

#include <cmath>
#include <glm/common.hpp>

namespace rhview {
namespace {

std::uint32_t pack_snorm10(float value) {
    const float scaled = std::round(glm::clamp(value, -1.0f, 1.0f) * 511.0f);
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(scaled)) & 0x3ffu;
}

std::uint32_t pack_unorm8(float value) {
    return static_cast<std::uint32_t>(std::round(glm::clamp(value, 0.0f, 1.0f) * 255.0f));
}

}  // namespace

PackedNormal pack_normal(const glm::vec3& unit_normal) {
    return PackedNormal{pack_snorm10(unit_normal.x) | pack_snorm10(unit_normal.y) << 10 |
                        pack_snorm10(unit_normal.z) << 20};
}

PackedColour pack_colour(const glm::vec3& colour) {
    return PackedColour{pack_unorm8(colour.r) | pack_unorm8(colour.g) << 8 | pack_unorm8(colour.b) << 16 |
                        0xff000000u};
}

std::size_t VertexPool::bytes() const {
    return positions.size() * sizeof(glm::vec3) + normals.size() * sizeof(PackedNormal) +
           colours.size() * sizeof(PackedColour);
}

std::uint64_t Scene::static_triangles() const {
    std::uint64_t total = 0;
    for (const SceneBatch& batch : batches) total += batch.indices.size() / 3;
    return total;
}

std::uint64_t Scene::dynamic_triangles() const {
    std::uint64_t total = 0;
    for (const DynamicObject& object : dynamic_objects)
        total += meshes[index_of(object.mesh)].indices.size() / 3;
    return total;
}

std::uint64_t Scene::static_objects() const {
    std::uint64_t total = 0;
    for (const SceneBatch& batch : batches) total += batch.objects.size();
    return total;
}

std::uint64_t Scene::vertex_count() const {
    std::uint64_t total = 0;
    for (const VertexPool& pool : pools) total += pool.positions.size();
    return total;
}

std::uint64_t Scene::vertex_bytes() const {
    std::uint64_t total = 0;
    for (const VertexPool& pool : pools) total += pool.bytes();
    return total;
}

std::uint64_t Scene::index_bytes() const {
    std::uint64_t total = 0;
    for (const SceneBatch& batch : batches) total += batch.indices.size() * sizeof(std::uint32_t);
    for (const SceneMesh& mesh : meshes) total += mesh.indices.size() * sizeof(std::uint32_t);
    return total;
}

Aabb Scene::bounds() const {
    Aabb box;
    for (const SceneBatch& batch : batches)
        for (const SceneObject& object : batch.objects) box.grow(object.bounds);
    for (const DynamicObject& object : dynamic_objects)
        box.grow(transform_box(object.scene_from_mesh, meshes[index_of(object.mesh)].bounds));
    return box;
}

std::vector<TriangleBatch> Scene::triangle_batches() const {
    std::vector<TriangleBatch> views;
    views.reserve(batches.size());
    for (const SceneBatch& batch : batches)
        views.push_back({batch.material, pools[batch.pool].positions, batch.indices,
                         materials[index_of(batch.material)].two_sided});
    return views;
}

}  // namespace rhview
