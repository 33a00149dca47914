// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/scene_builder.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "placement.h"
#include "rhview/base/assert.h"
#include "rhview/scenes/object_motion.h"

namespace rhview {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kNotFinite = kNone - 1;  // a vertex whose place is not finite
constexpr std::size_t kFormats = 4;

std::size_t format_of(bool normals, bool colours) {
    return (normals ? 1u : 0u) + (colours ? 2u : 0u);
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
    std::vector<glm::vec3>& positions = scene_.pools[pool_id].positions.own();
    std::vector<PackedNormal>& normals = scene_.pools[pool_id].normals.own();
    std::vector<PackedColour>& colours = scene_.pools[pool_id].colours.own();
    if (indices.size() + piece.indices.size() >= kNone) {
        too_large_ = true;
        return;
    }
    const Placement placement(target_from_piece);
    if (new_index_.size() < piece.positions.size()) new_index_.resize(piece.positions.size(), kNone);
    const auto is_new = [&](std::uint32_t vertex) { return new_index_[vertex] >= kNotFinite; };
    const auto store = [&](std::uint32_t vertex, const glm::vec3& position) {
        new_index_[vertex] = static_cast<std::uint32_t>(positions.size());
        positions.push_back(position);
        bounds.grow(position);
        if (!piece.normals.empty()) normals.push_back(placement.normal(piece.normals[vertex]));
        if (!piece.colours.empty()) colours.push_back(piece.colours[vertex]);
    };
    // Stores the corners that are new. All are placed before any is stored: a dropped triangle leaves no
    // vertex.
    const auto store_new = [&](const std::array<std::uint32_t, 3>& corners) {
        std::array<glm::vec3, 3> places;
        bool finite = true;
        for (std::size_t i = 0; i < 3; ++i) {
            if (!is_new(corners[i])) continue;
            places[i] = placement.position(piece.positions[corners[i]]);
            if (!is_finite(places[i])) new_index_[corners[i]] = kNotFinite;
            finite = finite && new_index_[corners[i]] != kNotFinite;
        }
        for (std::size_t i = 0; i < 3 && finite; ++i)
            if (is_new(corners[i])) store(corners[i], places[i]);
        return finite;
    };

    for (std::size_t i = 0; i + 2 < piece.indices.size() && !too_large_; i += 3) {
        const std::array<std::uint32_t, 3> corners{piece.indices[i],
                                                   piece.indices[placement.mirrored ? i + 2 : i + 1],
                                                   piece.indices[placement.mirrored ? i + 1 : i + 2]};
        if (is_new(corners[0]) || is_new(corners[1]) || is_new(corners[2])) {
            too_large_ = positions.size() + 3 >= kNotFinite;
            if (too_large_) break;
            if (!store_new(corners)) {
                ++scene_.dropped_triangles;
                continue;
            }
        }
        for (const std::uint32_t corner : corners) indices.push_back(new_index_[corner]);
    }
    // Only what was touched is reset: pieces may share one long position array.
    for (const std::uint32_t vertex : piece.indices) new_index_[vertex] = kNone;
}

void SceneBuilder::add_static(MaterialId material, const MeshPiece& piece,
                              const glm::dmat4& world_from_piece) {
    const std::uint32_t pool = pool_for(!piece.normals.empty(), !piece.colours.empty());
    SceneBatch& batch = batch_for(material, pool);
    glm::dmat4 scene_from_piece = world_from_piece;
    scene_from_piece[3] -= glm::dvec4(scene_.origin, 0.0);
    SceneObject object;
    object.first_index = static_cast<std::uint32_t>(batch.indices.size());
    append(piece, scene_from_piece, pool, batch.indices.own(), object.bounds);
    object.index_count = static_cast<std::uint32_t>(batch.indices.size()) - object.first_index;
    if (object.index_count > 0) batch.objects.own().push_back(object);
}

std::optional<MeshId> SceneBuilder::add_mesh(MaterialId material, const MeshPiece& piece) {
    SceneMesh mesh;
    mesh.material = material;
    mesh.pool = pool_for(!piece.normals.empty(), !piece.colours.empty());
    const std::size_t first = scene_.pools[mesh.pool].positions.size();
    append(piece, glm::dmat4(1.0), mesh.pool, mesh.indices.own(), mesh.bounds);
    if (mesh.indices.empty()) return std::nullopt;
    mesh_vertices_.push_back({first, scene_.pools[mesh.pool].positions.size()});
    scene_.meshes.push_back(std::move(mesh));
    return MeshId{static_cast<std::uint32_t>(scene_.meshes.size() - 1)};
}

void SceneBuilder::add_dynamic(MeshId mesh, const glm::dmat4& world_from_mesh) {
    glm::dmat4 scene_from_mesh = world_from_mesh;
    scene_from_mesh[3] -= glm::dvec4(scene_.origin, 0.0);
    scene_.dynamic_objects.push_back({mesh, scene_from_mesh});
}

void SceneBuilder::add_dynamic(MeshId mesh, const glm::dmat4& world_from_mesh, ObjectMotion motion) {
    RHVIEW_ASSERT(problem_of(motion) == nullptr);
    add_dynamic(mesh, world_from_mesh);
    scene_.dynamic_objects.back().motion = static_cast<std::uint32_t>(scene_.motions.size());
    scene_.motions.push_back(std::move(motion));
}

bool SceneBuilder::add_instance(MeshId mesh, const glm::dmat4& world_from_mesh) {
    glm::dmat4 scene_from_mesh = world_from_mesh;
    scene_from_mesh[3] -= glm::dvec4(scene_.origin, 0.0);
    if (!can_be_drawn_through(scene_from_mesh)) return false;
    const Placement placement(scene_from_mesh);
    const auto [first, end] = mesh_vertices_[index_of(mesh)];
    const std::span<const glm::vec3> positions =
        scene_.pools[scene_.meshes[index_of(mesh)].pool].positions.span().subspan(first, end - first);
    glm::dvec3 min(std::numeric_limits<double>::infinity()), max = -min;
    for (const glm::vec3& position : positions) {
        const glm::dvec3 place = placement.exact_position(position);
        min = glm::min(min, place);
        max = glm::max(max, place);
    }
    StaticInstance instance{mesh, scene_from_mesh, {}};
    if (!round_outwards(min, max, instance.bounds)) return false;
    scene_.static_instances.push_back(instance);
    return true;
}

void SceneBuilder::add_warning(std::string sentence) {
    scene_.warnings.push_back(std::move(sentence));
}

void SceneBuilder::reserve(MaterialId material, bool normals, bool colours, std::size_t vertices,
                           std::size_t indices) {
    const std::uint32_t pool_id = pool_for(normals, colours);
    VertexPool& pool = scene_.pools[pool_id];
    // Batches share their format's pool: what was asked for before has not been added yet.
    std::size_t& reserved = reserved_vertices_[format_of(normals, colours)];
    reserved = std::max(reserved, pool.positions.size()) + vertices;
    pool.positions.own().reserve(reserved);
    if (normals) pool.normals.own().reserve(reserved);
    if (colours) pool.colours.own().reserve(reserved);
    SceneBatch& batch = batch_for(material, pool_id);
    batch.indices.own().reserve(batch.indices.size() + indices);
}

Result<Scene> SceneBuilder::finish(std::string name) {
    Scene scene = std::move(scene_);
    const bool too_large = too_large_;
    *this = SceneBuilder();
    if (too_large) {
        return Error{name +
                     ": more than 4,294,967,294 vertices or indices in one vertex format; split the scene"};
    }
    std::erase_if(scene.batches, [](const SceneBatch& batch) { return batch.indices.empty(); });
    if (scene.batches.empty() && scene.object_count() == 0) {
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
