// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "import_gltf_internal.h"
#include "import_internal.h"
#include "placement.h"
#include "rhview/base/aabb.h"
#include "rhview/scenes/memory.h"
#include "rhview/scenes/scene_builder.h"

namespace rhview {
namespace {

using gltf::kNone;
using gltf::MeshData;
using gltf::PlacedMesh;
using gltf::PrimitiveData;

/// What goes to one batch, material and vertex format, and to the meshes that stay whole beside it.
struct BatchSize {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    std::uint64_t mesh_triangles = 0;

    [[nodiscard]] std::uint64_t all_triangles() const { return triangles + mesh_triangles; }
};

std::size_t format_of(const PrimitiveData& primitive) {
    return (primitive.normals != kNone ? 1u : 0u) + (primitive.colours != kNone ? 2u : 0u);
}

std::vector<Material> read_materials(const tinygltf::Model& model) {
    std::vector<Material> materials;
    for (const tinygltf::Material& source : model.materials) {
        Material& material = materials.emplace_back();
        material.name = source.name;
        const std::vector<double>& factor = source.pbrMetallicRoughness.baseColorFactor;
        for (std::size_t c = 0; c < 3; ++c)
            material.colour[static_cast<int>(c)] = c < factor.size() ? static_cast<float>(factor[c]) : 1.0f;
        material.two_sided = source.doubleSided;
        material.alpha_tested = source.alphaMode == "MASK" || source.alphaMode == "BLEND";
    }
    colour_white_materials(materials);
    return materials;
}

bool is_finite(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

/// Corners of the primitives' boxes under the nodes' transforms.
WorldBounds world_bounds(const std::vector<PlacedMesh>& placed, const MeshData& meshes) {
    WorldBounds bounds;
    for (const PlacedMesh& place : placed) {
        if (!is_finite(place.world_from_mesh)) continue;
        for (const PrimitiveData& primitive : meshes.primitives[place.mesh]) {
            const WorldBounds& box = meshes.position_bounds[primitive.positions];
            if (box.is_empty()) continue;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 point((corner & 1) != 0 ? box.max.x : box.min.x,
                                       (corner & 2) != 0 ? box.max.y : box.min.y,
                                       (corner & 4) != 0 ? box.max.z : box.min.z);
                bounds.grow(glm::dvec3(place.world_from_mesh * glm::dvec4(point, 1.0)));
            }
        }
    }
    return bounds;
}

/// The meshes that are stored once: placed more than once where they can be drawn from their own space.
std::vector<bool> meshes_to_keep(const std::vector<PlacedMesh>& placed, std::size_t mesh_count,
                                 RepeatedMeshes repeated) {
    std::vector<std::size_t> places(mesh_count);
    for (const PlacedMesh& place : placed)
        if (can_be_drawn_through(place.world_from_mesh)) ++places[place.mesh];
    std::vector<bool> keep(mesh_count);
    for (std::size_t mesh = 0; mesh < mesh_count; ++mesh)
        keep[mesh] = repeated == RepeatedMeshes::Keep && places[mesh] > 1;
    return keep;
}

/// Indexed by material * 4 + format; the default material comes last.
std::vector<BatchSize> measure(const std::vector<PlacedMesh>& placed, const MeshData& meshes,
                               const std::vector<bool>& keep, std::size_t materials) {
    std::vector<BatchSize> sizes((materials + 1) * 4);
    std::vector<bool> counted(keep.size());
    for (const PlacedMesh& place : placed) {
        const bool kept = keep[place.mesh] && can_be_drawn_through(place.world_from_mesh);
        if (kept && counted[place.mesh]) continue;
        counted[place.mesh] = counted[place.mesh] || kept;
        for (const PrimitiveData& primitive : meshes.primitives[place.mesh]) {
            BatchSize& size = sizes[primitive.material * 4 + format_of(primitive)];
            size.vertices += primitive.used_vertices;
            (kept ? size.mesh_triangles : size.triangles) += meshes.indices[primitive.indices].size() / 3;
        }
    }
    return sizes;
}

Status check_scene_memory(const std::string& name, const std::vector<BatchSize>& sizes) {
    constexpr std::array<std::uint64_t, 4> kVertexBytes{12, 16, 16,
                                                        20};  // by format: position, normal, colour
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i)
        bytes += estimated_scene_bytes(sizes[i].all_triangles(), sizes[i].vertices, kVertexBytes[i % 4]);
    return check_memory(name, bytes);
}

MeshPiece piece_of(const PrimitiveData& primitive, const MeshData& meshes) {
    MeshPiece piece;
    piece.positions = meshes.positions[primitive.positions];
    if (primitive.normals != kNone) piece.normals = meshes.normals[primitive.normals];
    if (primitive.colours != kNone) piece.colours = meshes.colours[primitive.colours];
    piece.indices = meshes.indices[primitive.indices];
    return piece;
}

/// Every primitive of every placed mesh, in the order of the nodes: into its batch, or as an instance.
void add_placed(SceneBuilder& builder, const std::vector<PlacedMesh>& placed, const MeshData& meshes,
                const std::vector<bool>& keep) {
    std::map<std::pair<std::size_t, std::size_t>, std::optional<MeshId>> added;
    for (const PlacedMesh& place : placed) {
        const std::vector<PrimitiveData>& primitives = meshes.primitives[place.mesh];
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            const MaterialId material{static_cast<std::uint32_t>(primitives[i].material)};
            const MeshPiece piece = piece_of(primitives[i], meshes);
            if (keep[place.mesh] && can_be_drawn_through(place.world_from_mesh)) {
                const auto [found, is_new] = added.try_emplace({place.mesh, i});
                if (is_new) found->second = builder.add_mesh(material, piece);
                if (!found->second || builder.add_instance(*found->second, place.world_from_mesh)) continue;
            }
            builder.add_static(material, piece, place.world_from_mesh);
        }
    }
}

void add_warnings(SceneBuilder& builder, const tinygltf::Model& model, const MeshData& meshes) {
    for (const std::string& warning : meshes.warnings) builder.add_warning(warning);
    const auto instanced = [](const tinygltf::Node& node) {
        return node.extensions.count("EXT_mesh_gpu_instancing") > 0;
    };
    if (std::any_of(model.nodes.begin(), model.nodes.end(), instanced))
        builder.add_warning("EXT_mesh_gpu_instancing is not read: instanced nodes are placed once");
    if (!model.skins.empty()) builder.add_warning("skins are not read: skinned meshes keep their bind pose");
}

}  // namespace

Result<Scene> import_gltf(const std::filesystem::path& file, const std::string& name, std::string bytes,
                          RepeatedMeshes repeated) {
    tinygltf::Model model;
    if (Status s = gltf::load_model(file, name, std::move(bytes), model); !s) return s.error();
    Result<std::vector<PlacedMesh>> placed = gltf::place_meshes(name, model);
    if (!placed) return placed.error();
    std::vector<bool> used(model.meshes.size());
    for (const PlacedMesh& place : *placed) used[place.mesh] = true;
    Result<MeshData> meshes = gltf::decode_meshes(name, model, used);
    if (!meshes) return meshes.error();
    model.buffers.clear();

    std::vector<Material> materials = read_materials(model);
    const std::vector<bool> keep = meshes_to_keep(*placed, model.meshes.size(), repeated);
    const std::vector<BatchSize> sizes = measure(*placed, *meshes, keep, materials.size());
    if (Status s = check_scene_memory(name, sizes); !s) return s.error();

    SceneBuilder builder(choose_origin(world_bounds(*placed, *meshes)));
    for (Material& material : materials) builder.add_material(std::move(material));
    const std::size_t default_material = materials.size();
    for (std::size_t format = 0; format < 4; ++format) {
        if (sizes[default_material * 4 + format].all_triangles() == 0) continue;
        Material material;
        material.name = "default";
        builder.add_material(std::move(material));
        break;
    }
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (sizes[i].all_triangles() == 0) continue;
        builder.reserve(MaterialId{static_cast<std::uint32_t>(i / 4)}, i % 2 != 0, i % 4 >= 2,
                        sizes[i].vertices, 3 * sizes[i].triangles);
    }
    add_placed(builder, *placed, *meshes, keep);
    add_warnings(builder, model, *meshes);
    return builder.finish(name);
}

}  // namespace rhview
