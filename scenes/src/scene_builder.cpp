// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/scene_builder.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace rhview {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kFormats = 4;

std::size_t format_of(bool normals, bool colours) {
    return (normals ? 1u : 0u) + (colours ? 2u : 0u);
}

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

SceneBuilder::SceneBuilder(const glm::dvec3& origin) : pool_of_format_(kFormats, kNone) {
    scene_.origin = origin;
}

MaterialId SceneBuilder::add_material(Material material) {
    scene_.materials.push_back(std::move(material));
    batch_of_.resize(scene_.materials.size() * kFormats, kNone);
    return MaterialId{static_cast<std::uint32_t>(scene_.materials.size() - 1)};
}

std::uint32_t SceneBuilder::pool_for(bool normals, bool colours) {
    std::uint32_t& pool = pool_of_format_[format_of(normals, colours)];
    if (pool == kNone) {
        pool = static_cast<std::uint32_t>(scene_.pools.size());
        scene_.pools.emplace_back();
    }
    return pool;
}

SceneBatch& SceneBuilder::batch_for(MaterialId material, std::uint32_t pool) {
    std::size_t format = 0;
    while (pool_of_format_[format] != pool) ++format;
    std::uint32_t& batch = batch_of_[index_of(material) * kFormats + format];
    if (batch == kNone) {
        batch = static_cast<std::uint32_t>(scene_.batches.size());
        scene_.batches.push_back({material, pool, {}, {}});
    }
    return scene_.batches[batch];
}

void SceneBuilder::append(const MeshPiece& piece, const glm::dmat4& target_from_piece, std::uint32_t pool_id,
                          std::vector<std::uint32_t>& indices, Aabb& bounds) {
    VertexPool& pool = scene_.pools[pool_id];
    const glm::dmat3 linear(target_from_piece);
    const bool mirrored = glm::determinant(linear) < 0.0;
    // The cofactor matrix carries normals through any affine map, singular ones included (Abrash; Garrity 2008).
    const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1]));
    const double side = mirrored ? -1.0 : 1.0;

    new_index_.assign(piece.positions.size(), kNone);
    const auto place = [&](std::uint32_t vertex) {
        return glm::vec3(target_from_piece * glm::dvec4(glm::dvec3(piece.positions[vertex]), 1.0));
    };
    const auto store = [&](std::uint32_t vertex, const glm::vec3& position) {
        if (new_index_[vertex] != kNone) return new_index_[vertex];
        const auto index = static_cast<std::uint32_t>(pool.positions.size());
        pool.positions.push_back(position);
        bounds.grow(position);
        if (!piece.normals.empty()) {
            const glm::dvec3 n = side * (cofactor * glm::dvec3(piece.normals[vertex]));
            const double length = glm::length(n);
            pool.normals.push_back(
                pack_normal(length > 0.0 && std::isfinite(length) ? glm::vec3(n / length) : glm::vec3(0, 1, 0)));
        }
        if (!piece.colours.empty()) pool.colours.push_back(piece.colours[vertex]);
        return new_index_[vertex] = index;
    };

    for (std::size_t i = 0; i + 2 < piece.indices.size(); i += 3) {
        const std::uint32_t a = piece.indices[i];
        const std::uint32_t b = piece.indices[mirrored ? i + 2 : i + 1];
        const std::uint32_t c = piece.indices[mirrored ? i + 1 : i + 2];
        const glm::vec3 pa = place(a), pb = place(b), pc = place(c);
        if (!is_finite(pa) || !is_finite(pb) || !is_finite(pc)) {
            ++scene_.dropped_triangles;
            continue;
        }
        if (pool.positions.size() + 3 >= kNone || indices.size() + 3 >= kNone) {
            too_large_ = true;
            return;
        }
        indices.push_back(store(a, pa));
        indices.push_back(store(b, pb));
        indices.push_back(store(c, pc));
    }
}

void SceneBuilder::add_static(MaterialId material, const MeshPiece& piece, const glm::dmat4& world_from_piece) {
    const std::uint32_t pool = pool_for(!piece.normals.empty(), !piece.colours.empty());
    SceneBatch& batch = batch_for(material, pool);
    glm::dmat4 scene_from_piece = world_from_piece;
    scene_from_piece[3] -= glm::dvec4(scene_.origin, 0.0);
    SceneObject object;
    object.first_index = static_cast<std::uint32_t>(batch.indices.size());
    append(piece, scene_from_piece, pool, batch.indices, object.bounds);
    object.index_count = static_cast<std::uint32_t>(batch.indices.size()) - object.first_index;
    if (object.index_count > 0) batch.objects.push_back(object);
}

std::optional<MeshId> SceneBuilder::add_mesh(MaterialId material, const MeshPiece& piece) {
    SceneMesh mesh;
    mesh.material = material;
    mesh.pool = pool_for(!piece.normals.empty(), !piece.colours.empty());
    append(piece, glm::dmat4(1.0), mesh.pool, mesh.indices, mesh.bounds);
    if (mesh.indices.empty()) return std::nullopt;
    scene_.meshes.push_back(std::move(mesh));
    return MeshId{static_cast<std::uint32_t>(scene_.meshes.size() - 1)};
}

void SceneBuilder::add_dynamic(MeshId mesh, const glm::dmat4& world_from_mesh) {
    glm::dmat4 scene_from_mesh = world_from_mesh;
    scene_from_mesh[3] -= glm::dvec4(scene_.origin, 0.0);
    scene_.dynamic_objects.push_back({mesh, scene_from_mesh});
}

void SceneBuilder::add_warning(std::string sentence) {
    scene_.warnings.push_back(std::move(sentence));
}

void SceneBuilder::reserve(MaterialId material, bool normals, bool colours, std::size_t vertices,
                           std::size_t indices) {
    const std::uint32_t pool_id = pool_for(normals, colours);
    VertexPool& pool = scene_.pools[pool_id];
    pool.positions.reserve(pool.positions.size() + vertices);
    if (normals) pool.normals.reserve(pool.normals.size() + vertices);
    if (colours) pool.colours.reserve(pool.colours.size() + vertices);
    SceneBatch& batch = batch_for(material, pool_id);
    batch.indices.reserve(batch.indices.size() + indices);
}

Result<Scene> SceneBuilder::finish(std::string name) {
    Scene scene = std::move(scene_);
    const bool too_large = too_large_;
    *this = SceneBuilder();
    if (too_large) {
        return Error{name + ": more than 4,294,967,294 vertices or indices in one vertex format; split the scene"};
    }
    std::erase_if(scene.batches, [](const SceneBatch& batch) { return batch.indices.empty(); });
    if (scene.batches.empty() && scene.dynamic_objects.empty()) {
        return Error{name + ": the scene holds no triangle to draw" +
                     (scene.dropped_triangles > 0 ? " (" + std::to_string(scene.dropped_triangles) +
                                                        " had a corner that is not finite)"
                                                  : std::string())};
    }
    if (scene.dropped_triangles > 0) {
        scene.warnings.push_back(std::to_string(scene.dropped_triangles) +
                                 " triangles with a corner that is not finite were left out");
    }
    scene.name = std::move(name);
    return scene;
}

}  // namespace rhview
