// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace rhview {
namespace {

std::uint32_t pack_snorm10(float value) {
    const float scaled = std::round(glm::clamp(value, -1.0f, 1.0f) * 511.0f);
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(scaled)) & 0x3ffu;
}

float unpack_snorm10(std::uint32_t bits) {
    const auto low = static_cast<std::int32_t>(bits & 0x3ffu);
    return std::max(static_cast<float>(low < 512 ? low : low - 1024) / 511.0f, -1.0f);
}

std::uint32_t pack_unorm8(float value) {
    return static_cast<std::uint32_t>(std::round(glm::clamp(value, 0.0f, 1.0f) * 255.0f));
}

}  // namespace

PackedNormal pack_normal(const glm::vec3& unit_normal) {
    return PackedNormal{pack_snorm10(unit_normal.x) | pack_snorm10(unit_normal.y) << 10 |
                        pack_snorm10(unit_normal.z) << 20};
}

glm::vec3 unpack_normal(PackedNormal normal) {
    const auto bits = static_cast<std::uint32_t>(normal);
    return {unpack_snorm10(bits), unpack_snorm10(bits >> 10), unpack_snorm10(bits >> 20)};
}

PackedColour pack_colour(const glm::vec3& colour) {
    return PackedColour{pack_unorm8(colour.r) | pack_unorm8(colour.g) << 8 | pack_unorm8(colour.b) << 16 |
                        0xff000000u};
}

std::size_t VertexPool::bytes() const {
    return positions.size() * sizeof(glm::vec3) + normals.size() * sizeof(PackedNormal) +
           colours.size() * sizeof(PackedColour);
}

std::uint64_t Scene::batch_triangles() const {
    std::uint64_t total = 0;
    for (const SceneBatch& batch : batches) total += batch.indices.size() / 3;
    return total;
}

std::uint64_t Scene::instance_triangles() const {
    std::uint64_t total = 0;
    for (const StaticInstance& instance : static_instances)
        total += meshes[index_of(instance.mesh)].indices.size() / 3;
    return total;
}

std::uint64_t Scene::static_triangles() const {
    return batch_triangles() + instance_triangles();
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
    return total + static_instances.size();
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
    for (const Aabb& object : object_boxes()) box.grow(object);
    return box;
}

std::size_t Scene::object_count() const {
    return dynamic_objects.size() + static_instances.size();
}

MeshId Scene::object_mesh(ObjectId object) const {
    const std::size_t i = index_of(object), dynamic = dynamic_objects.size();
    return i < dynamic ? dynamic_objects[i].mesh : static_instances[i - dynamic].mesh;
}

const glm::dmat4& Scene::object_placement(ObjectId object) const {
    const std::size_t i = index_of(object), dynamic = dynamic_objects.size();
    return i < dynamic ? dynamic_objects[i].scene_from_mesh : static_instances[i - dynamic].scene_from_mesh;
}

std::vector<Aabb> Scene::object_boxes() const {
    std::vector<Aabb> boxes;
    boxes.reserve(object_count());
    for (const DynamicObject& object : dynamic_objects)
        boxes.push_back(transform_box(object.scene_from_mesh, meshes[index_of(object.mesh)].bounds));
    for (const StaticInstance& instance : static_instances) boxes.push_back(instance.bounds);
    return boxes;
}

std::vector<TriangleBatch> Scene::triangle_batches() const {
    std::vector<TriangleBatch> views;
    views.reserve(batches.size());
    for (const SceneBatch& batch : batches)
        views.push_back({batch.material, pools[batch.pool].positions, batch.indices,
                         materials[index_of(batch.material)].two_sided, batch.objects.span()});
    return views;
}

}  // namespace rhview
