// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// Stanford PLY, read without a library: assimp 5.2 hangs on some truncated files and takes others for whole.
// Coordinates are read as `double` and stored relative to the origin, so a far-away scene loses nothing.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "import_internal.h"
#include "import_ply_internal.h"
#include "rhview/scenes/memory.h"
#include "rhview/scenes/scene_builder.h"

namespace rhview {
namespace {

using ply::Element;
using ply::Header;
using ply::Property;
using ply::ValueReader;

/// What a vertex property sets.
enum class Role { None, X, Y, Z, NormalX, NormalY, NormalZ, Red, Green, Blue };

struct PlyMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<PackedColour> colours;
    std::vector<std::uint32_t> indices;
    std::uint64_t degenerate_faces = 0;
};

Role role_of(const Property& property) {
    if (property.list_count) return Role::None;
    const std::string& name = property.name;
    if (name == "x") return Role::X;
    if (name == "y") return Role::Y;
    if (name == "z") return Role::Z;
    if (name == "nx") return Role::NormalX;
    if (name == "ny") return Role::NormalY;
    if (name == "nz") return Role::NormalZ;
    if (name == "red" || name == "diffuse_red" || name == "r") return Role::Red;
    if (name == "green" || name == "diffuse_green" || name == "g") return Role::Green;
    if (name == "blue" || name == "diffuse_blue" || name == "b") return Role::Blue;
    return Role::None;
}

/// Which of the three triples (position, normal, colour) a vertex has whole.
bool has_triple(const std::vector<Role>& roles, Role first) {
    for (int i = 0; i < 3; ++i) {
        const auto wanted = static_cast<Role>(static_cast<int>(first) + i);
        if (std::find(roles.begin(), roles.end(), wanted) == roles.end()) return false;
    }
    return true;
}

class PlyImporter {
  public:
    PlyImporter(const std::string& name, std::string_view bytes, const Header& header)
        : name_(name), header_(header), values_(header.format, bytes.substr(header.bytes)) {}

    Status read();
    PlyMesh take() { return std::move(mesh_); }

  private:
    Status read_vertices(const Element& element);
    Status read_faces(const Element& element);
    Status skip(const Element& element);
    Status add_face(const std::vector<double>& corners, std::uint64_t face);
    /// The length of a list, at most what the rest of the file can hold; else the reader has failed.
    std::optional<std::uint64_t> list_length(const Property& property);
    [[nodiscard]] Error cut_short(const Element& element, std::uint64_t at) const;

    const std::string& name_;
    const Header& header_;
    ValueReader values_;
    PlyMesh mesh_;
    std::vector<glm::dvec3> corner_positions_;  // scratch
    std::vector<std::uint32_t> triangles_;      // scratch
};

Error PlyImporter::cut_short(const Element& element, std::uint64_t at) const {
    return Error{
        fmt::format("{}: {} {} of {}: the data end or are no numbers; the file is truncated or corrupt, "
                    "export it again",
                    name_, element.name, at, element.count)};
}

std::optional<std::uint64_t> PlyImporter::list_length(const Property& property) {
    const double length = values_.next(*property.list_count);
    const std::size_t fewest = header_.format == ply::Format::Ascii ? 1 : property.type.bytes;
    if (values_.failed() || !(length >= 0.0) || length > static_cast<double>(values_.left() / fewest))
        return std::nullopt;
    return static_cast<std::uint64_t>(length);
}

Status PlyImporter::read() {
    const Element* vertices = nullptr;
    const Element* faces = nullptr;
    for (const Element& element : header_.elements) {
        if (element.name == "vertex" && vertices == nullptr) vertices = &element;
        if (element.name == "face" && faces == nullptr && vertices != nullptr) faces = &element;
    }
    if (vertices == nullptr || faces == nullptr)
        return Error{name_ +
                     ": the header must name vertices and then faces; export it as a mesh, not as points"};
    if (vertices->count >= std::numeric_limits<std::uint32_t>::max())
        return Error{name_ + ": more than 4,294,967,294 vertices; split the mesh"};
    for (const Element& element : header_.elements) {
        Status done = &element == vertices ? read_vertices(element)
                      : &element == faces  ? read_faces(element)
                                           : skip(element);
        if (!done) return done;
        if (&element == faces) break;
    }
    return success();
}

Status PlyImporter::skip(const Element& element) {
    if (element.properties.empty()) return success();
    for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const Property& property : element.properties) {
            std::uint64_t values = 1;
            if (property.list_count) {
                const auto length = list_length(property);
                if (!length) return cut_short(element, i);
                values = *length;
            }
            for (std::uint64_t v = 0; v < values; ++v) values_.next(property.type);
        }
        if (values_.failed()) return cut_short(element, i);
    }
    return success();
}

Status PlyImporter::read_vertices(const Element& element) {
    std::vector<Role> roles;
    for (const Property& property : element.properties) {
        if (property.list_count)
            return Error{name_ + ": a vertex property is a list, which is not supported; export it without"};
        roles.push_back(role_of(property));
    }
    if (!has_triple(roles, Role::X)) return Error{name_ + ": vertices have no x, y and z; export it again"};
    const bool normals = has_triple(roles, Role::NormalX);
    const bool colours = has_triple(roles, Role::Red);
    mesh_.positions.reserve(element.count);
    if (normals) mesh_.normals.reserve(element.count);
    if (colours) mesh_.colours.reserve(element.count);
    for (std::uint64_t vertex = 0; vertex < element.count; ++vertex) {
        glm::dvec3 triples[3] = {};  // position, normal, colour
        for (std::size_t i = 0; i < roles.size(); ++i) {
            const ply::ScalarType type = element.properties[i].type;
            double value = values_.next(type);
            if (roles[i] == Role::None) continue;
            const int place = static_cast<int>(roles[i]) - static_cast<int>(Role::X);
            if (place >= 6 && type.kind != 'f') value /= std::exp2(8.0 * type.bytes) - 1.0;
            triples[place / 3][place % 3] = value;
        }
        if (values_.failed()) return cut_short(element, vertex);
        mesh_.positions.push_back(triples[0]);
        if (normals) mesh_.normals.emplace_back(triples[1]);
        if (colours) {
            for (int c = 0; c < 3; ++c) triples[2][c] = triples[2][c] >= 0.0 ? triples[2][c] : 0.0;
            mesh_.colours.push_back(pack_colour(glm::vec3(triples[2])));
        }
    }
    return success();
}

Status PlyImporter::read_faces(const Element& element) {
    std::size_t corners_at = element.properties.size();
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const Property& property = element.properties[i];
        if (property.list_count && (property.name == "vertex_indices" || property.name == "vertex_index"))
            corners_at = i;
    }
    if (corners_at == element.properties.size())
        return Error{name_ + ": faces have no list 'vertex_indices'; export it again"};
    std::vector<double> corners;
    for (std::uint64_t face = 0; face < element.count; ++face) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const Property& property = element.properties[i];
            std::uint64_t length = 1;
            if (property.list_count) {
                const auto told = list_length(property);
                if (!told) return cut_short(element, face);
                length = *told;
            }
            if (i == corners_at) corners.resize(length);
            for (std::uint64_t v = 0; v < length; ++v) {
                const double value = values_.next(property.type);
                if (i == corners_at) corners[v] = value;
            }
        }
        if (values_.failed()) return cut_short(element, face);
        if (Status s = add_face(corners, face); !s) return s;
    }
    return success();
}

Status PlyImporter::add_face(const std::vector<double>& corners, std::uint64_t face) {
    if (corners.size() < 3) {
        ++mesh_.degenerate_faces;
        return success();
    }
    corner_positions_.clear();
    for (const double corner : corners) {
        if (!(corner >= 0.0 && corner < static_cast<double>(mesh_.positions.size()) &&
              corner == std::floor(corner))) {
            return Error{
                fmt::format("{}: face {}: index {} is out of range (there are {} vertices); export it again",
                            name_, face, corner, mesh_.positions.size())};
        }
        corner_positions_.push_back(mesh_.positions[static_cast<std::size_t>(corner)]);
    }
    triangles_.clear();
    triangulate_polygon(corner_positions_, triangles_);
    for (const std::uint32_t corner : triangles_)
        mesh_.indices.push_back(static_cast<std::uint32_t>(corners[corner]));
    return success();
}

Result<Scene> build(const std::string& name, PlyMesh mesh) {
    WorldBounds bounds;
    for (const glm::dvec3& position : mesh.positions) bounds.grow(position);
    const glm::dvec3 origin = choose_origin(bounds);
    std::vector<glm::vec3> positions;
    positions.reserve(mesh.positions.size());
    for (const glm::dvec3& position : mesh.positions) positions.emplace_back(position - origin);
    std::vector<glm::dvec3>().swap(mesh.positions);

    SceneBuilder builder(origin);
    Material material;
    material.name = "default";
    const MaterialId id = builder.add_material(std::move(material));
    builder.reserve(id, !mesh.normals.empty(), !mesh.colours.empty(), positions.size(), mesh.indices.size());
    glm::dmat4 world_from_piece(1.0);
    world_from_piece[3] = glm::dvec4(origin, 1.0);
    builder.add_static(id, {positions, mesh.normals, mesh.colours, mesh.indices}, world_from_piece);
    if (mesh.degenerate_faces > 0) {
        builder.add_warning(
            fmt::format("{} faces with fewer than three corners were left out", mesh.degenerate_faces));
    }
    return builder.finish(name);
}

}  // namespace

Result<Scene> import_ply(const std::string& name, std::string bytes) {
    Result<Header> header = ply::parse_header(name, bytes);
    if (!header) return header.error();
    std::uint64_t vertices = 0, faces = 0;
    for (const Element& element : header->elements) {
        if (element.name == "vertex") vertices += element.count;
        if (element.name == "face") faces += element.count;
    }
    // Reading: 40 bytes a vertex, 12 a triangle; a mesh of quads has two triangles a face.
    const std::uint64_t needed = 40 * vertices + 24 * faces + estimated_scene_bytes(2 * faces, vertices, 20);
    if (Status s = check_memory(name, needed); !s) return s.error();
    PlyImporter importer(name, bytes, *header);
    if (Status s = importer.read(); !s) return s.error();
    PlyMesh mesh = importer.take();
    std::string().swap(bytes);
    return build(name, std::move(mesh));
}

}  // namespace rhview
