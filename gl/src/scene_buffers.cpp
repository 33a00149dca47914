// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/gl/scene_buffers.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "attributes.h"
#include "rhview/gl/context.h"
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
VertexArray make_vertex_array(const VertexPool& pool, GLuint index_buffer, Buffer& buffer) {
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    glBindVertexArray(name);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer);
    buffer = make_buffer(GL_ARRAY_BUFFER, pool.bytes());
    std::size_t offset = 0;
    enable_attribute(kPositionAttribute, 3, GL_FLOAT, GL_FALSE, offset);
    write<glm::vec3>(GL_ARRAY_BUFFER, offset, pool.positions);
    if (!pool.normals.empty()) {
        enable_attribute(kNormalAttribute, 4, GL_INT_2_10_10_10_REV, GL_TRUE, offset);
        write<PackedNormal>(GL_ARRAY_BUFFER, offset, pool.normals);
    }
    if (!pool.colours.empty()) {
        enable_attribute(kColourAttribute, 4, GL_UNSIGNED_BYTE, GL_TRUE, offset);
        write<PackedColour>(GL_ARRAY_BUFFER, offset, pool.colours);
    }
    return VertexArray(name);
}

}  // namespace

Result<SceneBuffers> SceneBuffers::upload(const Scene& scene, std::span<const std::uint32_t> static_indices) {
    take_error();
    const StateGuard guard(has_clip_control());
    SceneBuffers buffers;
    buffers.origin_ = scene.origin;
    glBindVertexArray(0);
    std::size_t index_bytes = scene.index_bytes();
    if (!static_indices.empty()) {
        for (const SceneBatch& batch : scene.batches) index_bytes -= std::span(batch.indices).size_bytes();
        index_bytes += static_indices.size_bytes();
    }
    buffers.indices_ = make_buffer(GL_ELEMENT_ARRAY_BUFFER, index_bytes);
    std::size_t offset = 0;
    if (static_indices.empty())
        for (const SceneBatch& batch : scene.batches)
            write<std::uint32_t>(GL_ELEMENT_ARRAY_BUFFER, offset, batch.indices);
    else
        write(GL_ELEMENT_ARRAY_BUFFER, offset, static_indices);
    std::vector<std::uint32_t> first_of_mesh;
    for (const SceneMesh& mesh : scene.meshes) {
        first_of_mesh.push_back(static_cast<std::uint32_t>(offset / sizeof(std::uint32_t)));
        write<std::uint32_t>(GL_ELEMENT_ARRAY_BUFFER, offset, mesh.indices);
    }
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    RHVIEW_ASSERT(offset == index_bytes);

    buffers.vertices_.resize(scene.pools.size());
    for (std::size_t i = 0; i < scene.pools.size(); ++i)
        buffers.vertex_arrays_.push_back(
            make_vertex_array(scene.pools[i], buffers.indices_.name(), buffers.vertices_[i]));

    const auto state_of = [&](MaterialId material_id, std::uint32_t pool) {
        const Material& material = scene.materials[index_of(material_id)];
        return DrawState{buffers.vertex_arrays_[pool].name(), material.colour,
                         !scene.pools[pool].colours.empty(), material.two_sided};
    };
    for (const SceneBatch& batch : scene.batches)
        buffers.batches_.push_back(state_of(batch.material, batch.pool));
    buffers.objects_.reserve(scene.object_count());
    for (std::uint32_t i = 0; i < scene.object_count(); ++i) {
        const std::size_t mesh_number = index_of(scene.object_mesh(ObjectId{i}));
        const SceneMesh& mesh = scene.meshes[mesh_number];
        buffers.objects_.push_back({state_of(mesh.material, mesh.pool), first_of_mesh[mesh_number],
                                    static_cast<std::uint32_t>(mesh.indices.size()),
                                    scene.object_placement(ObjectId{i})});
    }
    buffers.bytes_ = index_bytes + scene.vertex_bytes();
    if (const std::string error = take_error(); !error.empty())
        return Error{fmt::format("{}: the driver could not take {} MiB of vertices and indices ({})",
                                 scene.name, buffers.bytes_ >> 20, error)};
    return buffers;
}

}  // namespace rhview::gl
