// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The parts of the glTF importer: container, node tree, primitives. Each checks what it reads before it uses
/// it.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "import_internal.h"
#include "rhview/base/result.h"
#include "rhview/scenes/scene.h"

namespace rhview::gltf {

/// Parses `.glb` or `.gltf` (told by the content) with its buffers; textures are never opened. Extensions
/// that hide geometry from this importer are errors that name them.
Status load_model(const std::filesystem::path& file, const std::string& name, std::string bytes,
                  tinygltf::Model& model);

/// A mesh where a node of the scene places it.
struct PlacedMesh {
    std::size_t mesh = 0;
    glm::dmat4 world_from_mesh{1.0};
};

/// The meshes of the default scene (else the first, else all root nodes), parents before children. Errors: an
/// index out of range, a cycle, a node with two parents.
Result<std::vector<PlacedMesh>> place_meshes(const std::string& name, const tinygltf::Model& model);

/// A primitive's triangles. The arrays are shared: indices into `MeshData`'s lists.
struct PrimitiveData {
    std::size_t material = 0;  ///< the file's own, or their number for the default material
    std::size_t positions = 0;
    std::size_t normals = 0;  ///< kNone without
    std::size_t colours = 0;  ///< kNone without
    std::size_t indices = 0;
    std::uint64_t used_vertices = 0;
};
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Decoded arrays, each accessor once however many primitives share it.
struct MeshData {
    std::vector<std::vector<glm::vec3>> positions;
    std::vector<WorldBounds> position_bounds;  ///< in mesh space, one per `positions`
    std::vector<std::vector<glm::vec3>> normals;
    std::vector<std::vector<PackedColour>> colours;
    std::vector<std::vector<std::uint32_t>> indices;  ///< three per triangle, checked against the positions
    std::vector<std::vector<PrimitiveData>> primitives;  ///< per mesh; empty for meshes that are not placed
    std::vector<std::string> warnings;
};

/// Decodes the primitives of the meshes that `used` marks. Errors: an accessor, view or buffer range or an
/// index out of range, a wrong type, more memory than is free (said before decoding).
Result<MeshData> decode_meshes(const std::string& name, const tinygltf::Model& model,
                               const std::vector<bool>& used);

/// Elements of an accessor without its sparse part; `data` is null where the base is all zero.
struct ElementSpan {
    const unsigned char* data = nullptr;
    std::size_t stride = 0;
    std::size_t count = 0;
    int component_type = 0;
    int components = 0;
    bool normalized = false;
};

/// An accessor whose ranges have been checked: element i is base[i], or the value of its sparse replacement.
struct CheckedAccessor {
    ElementSpan base;
    ElementSpan sparse_indices;  ///< count 0 without
    ElementSpan sparse_values;
};

/// `place` begins the error sentence ("castle.glb: mesh 3 primitive 0: POSITION").
Result<CheckedAccessor> check_accessor(const std::string& place, const tinygltf::Model& model, int accessor);

/// Three components of every element (a fourth is ignored), normalized integers as the specification says.
Result<std::vector<glm::vec3>> decode_vectors(const std::string& place, const CheckedAccessor& accessor);
/// Scalars of an unsigned integer type.
Result<std::vector<std::uint32_t>> decode_indices(const std::string& place, const CheckedAccessor& accessor);

}  // namespace rhview::gltf
