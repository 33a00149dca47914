// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "scene_description.h"

#include "byte_stream.h"

namespace rhview {
namespace {

struct Writing {
    ByteWriter bytes;

    template <class T>
    void value(const T& value) {
        bytes.put(value);
    }
    template <class T, class Each>
    void list(const std::vector<T>& items, std::size_t, Each each) {
        bytes.put(static_cast<std::uint64_t>(items.size()));
        for (const T& item : items) each(item);
    }
};

struct Reading {
    ByteReader bytes;

    template <class T>
    void value(T& value) {
        bytes.get(value);
    }
    template <class T, class Each>
    void list(std::vector<T>& items, std::size_t least_bytes, Each each) {
        items.resize(bytes.get_count(least_bytes));
        for (T& item : items) each(item);
    }
};

template <class Io, class Vector>
void stream_vector(Io& io, Vector& v) {
    for (glm::length_t i = 0; i < 3; ++i) io.value(v[i]);
}

template <class Io, class Matrix>
void stream_matrix(Io& io, Matrix& matrix) {
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 4; ++row) io.value(matrix[column][row]);
}

template <class Io, class Report>
void stream_report(Io& io, Report& report) {
    io.value(report.flattened_meshes);
    io.value(report.flattened_placements);
    io.value(report.flattened_bytes);
    io.value(report.kept_meshes);
    io.value(report.kept_placements);
    io.value(report.kept_bytes);
    io.value(report.all_flattened_bytes);
    io.value(report.budget_bytes);
    io.value(report.all_kept_ns);
    io.value(report.all_flattened_ns);
    io.value(report.chosen_ns);
}

/// The layout, for both directions: `io` puts or gets each value. Lists say how many bytes an item takes at
/// least.
template <class Io, class Description>
void stream_scene(Io& io, Description& d) {
    io.value(d.provenance.source);
    io.value(d.provenance.baked_by);
    io.value(d.name);
    io.value(d.static_triangles);
    io.value(d.dynamic_triangles);
    io.value(d.dropped_triangles);
    stream_vector(io, d.origin);
    io.list(d.warnings, 4, [&](auto& warning) { io.value(warning); });
    io.list(d.materials, 18, [&](auto& material) {
        io.value(material.name);
        stream_vector(io, material.colour);
        io.value(material.two_sided);
        io.value(material.alpha_tested);
    });
    io.list(d.pools, 10, [&](auto& pool) {
        io.value(pool.vertices);
        io.value(pool.normals);
        io.value(pool.colours);
    });
    io.list(d.batches, 24, [&](auto& batch) {
        io.value(batch.material);
        io.value(batch.pool);
        io.value(batch.indices);
        io.value(batch.objects);
    });
    io.list(d.meshes, 40, [&](auto& mesh) {
        io.value(mesh.material);
        io.value(mesh.pool);
        io.value(mesh.indices);
        stream_vector(io, mesh.bounds.min);
        stream_vector(io, mesh.bounds.max);
    });
    io.list(d.dynamic_objects, 132, [&](auto& object) {
        io.value(object.mesh);
        stream_matrix(io, object.scene_from_mesh);
    });
    io.list(d.static_instances, 156, [&](auto& instance) {
        io.value(instance.mesh);
        stream_matrix(io, instance.scene_from_mesh);
        stream_vector(io, instance.bounds.min);
        stream_vector(io, instance.bounds.max);
    });
    stream_report(io, d.instancing);
}

/// Where dynamic objects go: version 3 and later.
template <class Io, class Description>
void stream_motions(Io& io, Description& d) {
    io.list(d.motions, 8, [&](auto& motion) {
        io.list(motion.keys, 40, [&](auto& key) {
            io.value(key.time_s);
            stream_vector(io, key.offset);
            io.value(key.turns);
        });
    });
    for (auto& object : d.dynamic_objects) io.value(object.motion);
}

template <class Io, class Path>
void stream_path(Io& io, Path& path) {
    io.value(path.fov_y_deg);
    io.value(path.near_m);
    io.value(path.far_m);
    stream_vector(io, path.up);
    io.list(path.keys, 56, [&](auto& key) {
        io.value(key.time_s);
        stream_vector(io, key.eye);
        stream_vector(io, key.target);
    });
}

}  // namespace

SceneDescription describe(const SceneAndPath& loaded, const SceneProvenance& provenance) {
    const Scene& scene = loaded.scene;
    SceneDescription d;
    d.provenance = provenance;
    d.name = scene.name;
    d.static_triangles = scene.static_triangles();
    d.dynamic_triangles = scene.dynamic_triangles();
    d.dropped_triangles = scene.dropped_triangles;
    d.origin = scene.origin;
    d.warnings = scene.warnings;
    d.materials = scene.materials;
    for (const VertexPool& pool : scene.pools)
        d.pools.push_back({pool.positions.size(), !pool.normals.empty(), !pool.colours.empty()});
    for (const SceneBatch& batch : scene.batches)
        d.batches.push_back({batch.material, batch.pool, batch.indices.size(), batch.objects.size()});
    for (const SceneMesh& mesh : scene.meshes)
        d.meshes.push_back({mesh.material, mesh.pool, mesh.indices.size(), mesh.bounds});
    d.dynamic_objects = scene.dynamic_objects;
    d.motions = scene.motions;
    d.static_instances = scene.static_instances;
    d.instancing = scene.instancing;
    d.path = loaded.path;
    return d;
}

std::vector<std::byte> to_bytes(const SceneDescription& description) {
    Writing io;
    stream_scene(io, description);
    stream_path(io, description.path);
    stream_motions(io, description);
    return io.bytes.take();
}

std::optional<SceneDescription> parse_description(std::span<const std::byte> bytes, std::uint32_t version) {
    Reading io{ByteReader(bytes)};
    SceneDescription description;
    stream_scene(io, description);
    stream_path(io, description.path);
    if (version >= kMotionsVersion) stream_motions(io, description);
    if (!io.bytes.ok() || !io.bytes.at_end()) return std::nullopt;
    return description;
}

}  // namespace rhview
