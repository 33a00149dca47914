// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/scene_buffers.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>

#include "attributes.h"
#include "rhview/gl/context.h"
#include "rhview/pipeline/query_boxes.h"
#include "state_guard.h"

namespace rhview::gl {
namespace {

Buffer make_buffer(GLenum target, std::size_t bytes) {
    GLuint name = 0;
    glGenBuffers(1, &name);
    glBindBuffer(target, name);
    glBufferData(target, static_cast<GLsizeiptr>(bytes), nullptr, GL_STATIC_DRAW);
    return Buffer(name);
}

template <class T>
void write(GLenum target, std::size_t& offset, std::span<const T> values) {
    glBufferSubData(target, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(values.size_bytes()),
                    values.data());
    offset += values.size_bytes();
}

void enable_attribute(GLuint index, GLint size, GLenum type, GLboolean normalized, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, type, normalized, 0, reinterpret_cast<const void*>(offset));
}

/// One stream after the other in one buffer: positions, then normals, then colours.
Buffer make_vertex_buffer(const VertexPool& pool) {
    Buffer buffer = make_buffer(GL_ARRAY_BUFFER, pool.bytes());
    std::size_t offset = 0;
    write<glm::vec3>(GL_ARRAY_BUFFER, offset, pool.positions);
    if (!pool.normals.empty()) write<PackedNormal>(GL_ARRAY_BUFFER, offset, pool.normals);
    if (!pool.colours.empty()) write<PackedColour>(GL_ARRAY_BUFFER, offset, pool.colours);
    return buffer;
}

VertexArray make_vertex_array(const VertexPool& pool, const Buffer& vertices, const Buffer& indices) {
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    glBindVertexArray(name);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices.name());
    std::size_t offset = 0;
    enable_attribute(kPositionAttribute, 3, GL_FLOAT, GL_FALSE, offset);
    offset += pool.positions.span().size_bytes();
    if (!pool.normals.empty()) enable_attribute(kNormalAttribute, 4, GL_INT_2_10_10_10_REV, GL_TRUE, offset);
    offset += pool.normals.span().size_bytes();
    if (!pool.colours.empty()) enable_attribute(kColourAttribute, 4, GL_UNSIGNED_BYTE, GL_TRUE, offset);
    return VertexArray(name);
}

/// In the bound vertex array: who draws binds the instances' buffer.
void enable_instance_attributes() {
    for (GLuint i = 0; i < kInstanceAttributes; ++i) {
        glEnableVertexAttribArray(kFirstInstanceAttribute + i);
        glVertexAttribFormat(kFirstInstanceAttribute + i, 4, GL_FLOAT, GL_FALSE, 4 * sizeof(float) * i);
        glVertexAttribBinding(kFirstInstanceAttribute + i, kInstanceBinding);
    }
    glVertexBindingDivisor(kInstanceBinding, 1);
}

std::size_t index_bytes_of(const Scene& scene, std::span<const std::uint32_t> static_indices,
                           std::span<const MeshLevels> levels) {
    std::size_t bytes = scene.index_bytes();
    if (!static_indices.empty()) {
        for (const SceneBatch& batch : scene.batches) bytes -= std::span(batch.indices).size_bytes();
        bytes += static_indices.size_bytes();
    }
    for (const MeshLevels& mesh : levels) bytes += mesh.indices.size_bytes();
    return bytes;
}

}  // namespace

std::vector<std::uint32_t> SceneBuffers::write_indices(const Scene& scene,
                                                       std::span<const std::uint32_t> static_indices,
                                                       std::span<const MeshLevels> levels,
                                                       std::size_t bytes) {
    glBindVertexArray(0);
    indices_ = make_buffer(GL_ELEMENT_ARRAY_BUFFER, bytes);
    std::size_t offset = 0;
    const auto next_index = [&] { return static_cast<std::uint32_t>(offset / sizeof(std::uint32_t)); };
    if (static_indices.empty())
        for (const SceneBatch& batch : scene.batches)
            write<std::uint32_t>(GL_ELEMENT_ARRAY_BUFFER, offset, batch.indices);
    else
        write(GL_ELEMENT_ARRAY_BUFFER, offset, static_indices);
    std::vector<std::uint32_t> first_of_mesh;
    for (const SceneMesh& mesh : scene.meshes) {
        first_of_mesh.push_back(next_index());
        write<std::uint32_t>(GL_ELEMENT_ARRAY_BUFFER, offset, mesh.indices);
    }
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        first_level_.push_back(static_cast<std::uint32_t>(levels_.size()));
        if (mesh >= levels.size()) continue;
        for (const LevelRange& level : levels[mesh].levels)
            levels_.push_back({next_index() + level.first_index, level.index_count});
        write(GL_ELEMENT_ARRAY_BUFFER, offset, levels[mesh].indices);
    }
    first_level_.push_back(static_cast<std::uint32_t>(levels_.size()));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    RHVIEW_ASSERT(offset == bytes);
    return first_of_mesh;
}

void SceneBuffers::make_vertex_arrays(const Scene& scene) {
    for (const VertexPool& pool : scene.pools) {
        vertices_.push_back(make_vertex_buffer(pool));
        vertex_arrays_.push_back(make_vertex_array(pool, vertices_.back(), indices_));
        instanced_arrays_.push_back(make_vertex_array(pool, vertices_.back(), indices_));
        enable_instance_attributes();
    }
}

void SceneBuffers::list_objects(const Scene& scene, std::span<const std::uint32_t> first_of_mesh) {
    const auto state_of = [&](MaterialId material_id, std::uint32_t pool) {
        const Material& material = scene.materials[index_of(material_id)];
        return DrawState{vertex_arrays_[pool].name(), material.colour, !scene.pools[pool].colours.empty(),
                         material.two_sided};
    };
    for (const SceneBatch& batch : scene.batches) batches_.push_back(state_of(batch.material, batch.pool));
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const SceneMesh& mesh = scene.meshes[i];
        meshes_.push_back({state_of(mesh.material, mesh.pool),
                           instanced_arrays_[mesh.pool].name(),
                           {first_of_mesh[i], static_cast<std::uint32_t>(mesh.indices.size())}});
    }
    object_meshes_.reserve(scene.object_count());
    placements_.reserve(scene.object_count());
    for (std::uint32_t i = 0; i < scene.object_count(); ++i) {
        object_meshes_.push_back(static_cast<std::uint32_t>(scene.object_mesh(ObjectId{i})));
        placements_.push_back(scene.object_placement(ObjectId{i}));
        largest_growth_ = std::max(largest_growth_, rounding_growth(placements_.back()));
    }
}

LevelRange SceneBuffers::level_range(std::uint32_t mesh, std::uint32_t level) const {
    const std::uint32_t first = first_level_[mesh], end = first_level_[mesh + 1];
    RHVIEW_ASSERT(level <= end - first);
    level = std::min(level, end - first);
    return level == 0 ? meshes_[mesh].whole : levels_[first + level - 1];
}

Result<SceneBuffers> SceneBuffers::upload(const Scene& scene, std::span<const std::uint32_t> static_indices,
                                          std::span<const MeshLevels> levels) {
    take_error();
    const StateGuard guard(has_clip_control());
    SceneBuffers buffers;
    buffers.origin_ = scene.origin;
    const std::size_t index_bytes = index_bytes_of(scene, static_indices, levels);
    const std::vector<std::uint32_t> first_of_mesh =
        buffers.write_indices(scene, static_indices, levels, index_bytes);
    buffers.make_vertex_arrays(scene);
    buffers.list_objects(scene, first_of_mesh);
    buffers.bytes_ = index_bytes + scene.vertex_bytes();
    if (const std::string error = take_error(); !error.empty())
        return Error{fmt::format("{}: the driver could not take {} MiB of vertices and indices ({})",
                                 scene.name, buffers.bytes_ >> 20, error)};
    return buffers;
}

}  // namespace rhview::gl
