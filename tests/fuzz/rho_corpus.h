// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "../rhoctree/random_geometry.h"
#include "rhview/lod/baked_lod.h"
#include "rhview/rhoctree/baked_octree.h"
#include "rhview/scenes/baked_scene.h"
#include "rhview/scenes/scene_builder.h"

namespace rhview {

/// Writes small baked files of every kind into `folder`, for mutations to start from: many batches, replicas,
/// one leaf, nothing; instances, dynamic objects, two vertex formats. Their names.
inline std::vector<std::filesystem::path> write_corpus(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    std::vector<std::filesystem::path> files;
    const auto write = [&](const char* name, const auto& add) {
        files.push_back(folder / name);
        Result<RhoWriter> writer = RhoWriter::create(files.back());
        if (!writer) return;
        add(*writer);
        if (!writer->finish()) files.pop_back();
    };
    const auto write_octree = [&](const char* name, const RandomGeometry& geometry,
                                  const OctreeOptions& options) {
        const std::vector<TriangleBatch> batches = geometry.batches();
        const RhOctree octree = build_octree(batches, options).value();
        write(name, [&](RhoWriter& writer) { add_octree_sections(writer, octree, batches, options); });
    };
    OctreeOptions replicas{.max_leaf_triangles = 16, .replica_budget = 1.0, .costs = {100.0, 3000.0, 0.0}};
    const View above{look_along({10, 300, 40}, {-0.1, -1, 0}, {1, 0, 0}),
                     perspective(1.0, 1.5, 0.1, 2000.0, {})};
    replicas.sample_views = {&above, 1};
    write_octree("replicas.rho", RandomGeometry(1, 2, 150), replicas);
    write_octree("batches.rho", RandomGeometry(2, 9, 20),
                 {.max_leaf_triangles = 8, .min_record_indices = 12});
    write_octree("leaf.rho", RandomGeometry(3, 1, 5), {});
    write_octree("nothing.rho", RandomGeometry(4, 1, 0), {});
    const SceneAndPath scene = make_named_scene("soup:triangles=1000").value();
    write("scene.rho", [&](RhoWriter& writer) { add_scene_sections(writer, scene, {"soup", "the tests"}); });
    SceneBuilder builder;
    const MaterialId stone = builder.add_material({"stone", glm::vec3(0.5f), true, false});
    const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<std::uint32_t> faces{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    const MeshId mesh = builder.add_mesh(stone, {corners, {}, {}, faces}).value();
    for (int i = 0; i < 5; ++i) {
        glm::dmat4 place(1.0);
        place[0][0] = i % 2 == 0 ? 2.0 : -1.0;
        place[3][2] = 3.0 * i;
        builder.add_instance(mesh, place);
    }
    SceneAndPath stones{builder.finish("stones").value(), {}};
    stones.path = walkthrough_of_scene(stones.scene);
    write("stones.rho", [&](RhoWriter& writer) {
        add_scene_sections(writer, stones, {"stones", "the tests"});
    });
    const SceneAndPath farm = make_named_scene("farm:instances=3,mesh=1000").value();
    const std::vector<TriangleBatch> batches = farm.scene.triangle_batches();
    const RhOctree octree = build_octree(batches, {.max_leaf_triangles = 2000}).value();
    write("farm.rho", [&](RhoWriter& writer) {
        add_scene_sections(writer, farm, {"farm", "the tests"});
        add_octree_sections(writer, octree, batches, {.max_leaf_triangles = 2000});
    });
    const VertexPool& pool = farm.scene.pools[farm.scene.meshes[0].pool];
    const LodMesh beast{pool.positions.span(), farm.scene.meshes[0].indices.span()};
    const std::vector<LodChain> chains = build_lod_chains({&beast, 1}, {}).value();
    write("chains.rho", [&](RhoWriter& writer) { add_lod_sections(writer, chains); });
    return files;
}

}  // namespace rhview
