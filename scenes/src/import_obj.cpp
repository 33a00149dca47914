// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// Wavefront OBJ through tinyobjloader's callbacks: they hand over faces as written, so that a bad index is an
// error with its place (the loader's own triangulation skips such faces in silence). Coordinates pass through
// the loader's `float`: a scene far from zero keeps only what that holds. Vertex colours are not read.

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <istream>
#include <limits>
#include <map>
#include <optional>
#include <streambuf>
#include <tuple>

#include "import_internal.h"
#include "rhview/scenes/memory.h"
#include "rhview/scenes/scene_builder.h"

namespace rhview {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Reads from memory that outlives it.
class MemoryStreamBuffer : public std::streambuf {
  public:
    explicit MemoryStreamBuffer(std::string& bytes) {
        setg(bytes.data(), bytes.data(), bytes.data() + bytes.size());
    }
};

/// What a pass over the lines tells before the loader runs.
struct LineCounts {
    std::uint64_t vertices = 0;
    std::uint64_t normals = 0;
    std::uint64_t faces = 0;
    std::uint64_t corners = 0;                ///< of all faces
    std::vector<std::uint64_t> bad_vertices;  ///< in file order: a coordinate is missing or no finite number
};

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

/// The loader reads what it cannot parse as 0: `v 1 nan 2` would become a vertex.
bool has_three_numbers(std::string_view rest) {
    int numbers = 0;
    for (std::size_t i = 0; i < rest.size() && numbers < 3; ++numbers) {
        while (i < rest.size() && is_blank(rest[i])) ++i;
        if (i == rest.size()) break;
        std::size_t digit = rest[i] == '+' || rest[i] == '-' ? i + 1 : i;
        if (digit < rest.size() && rest[digit] == '.') ++digit;
        if (digit >= rest.size() || rest[digit] < '0' || rest[digit] > '9') return false;
        while (i < rest.size() && !is_blank(rest[i])) ++i;
    }
    return numbers == 3;
}

std::uint64_t count_words(std::string_view rest) {
    std::uint64_t words = 0;
    for (std::size_t i = 0; i < rest.size(); ++i)
        words += !is_blank(rest[i]) && (i == 0 || is_blank(rest[i - 1])) ? 1 : 0;
    return words;
}

LineCounts count_lines(std::string_view text) {
    LineCounts counts;
    while (!text.empty()) {
        const std::size_t end = text.find_first_of("\r\n");
        std::string_view line = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
        if (line.size() < 2) continue;
        if (line[0] == 'v' && is_blank(line[1])) {
            if (!has_three_numbers(line.substr(2))) counts.bad_vertices.push_back(counts.vertices);
            ++counts.vertices;
        } else if (line[0] == 'v' && line[1] == 'n') {
            ++counts.normals;
        } else if (line[0] == 'f' && is_blank(line[1])) {
            ++counts.faces;
            counts.corners += count_words(line.substr(2));
        }
    }
    return counts;
}

/// Triangles of one group and material. With normals, corners index the (position, normal) pairs; without,
/// positions.
struct ObjPiece {
    std::size_t material = 0;
    bool normals = false;
    std::vector<std::uint32_t> indices;
};

/// Opens `.mtl` files beside the `.obj`; one that is missing leaves a warning.
class MtlReader : public tinyobj::MaterialReader {
  public:
    explicit MtlReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

    bool operator()(const std::string& file, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* material_map, std::string* warn, std::string* err) override {
        const std::filesystem::path path = folder_ / file;
        Result<std::string> bytes = read_file(path, file);
        if (!bytes) {
            warnings.push_back(bytes.error().message + "; its materials have colours of our own");
            return false;
        }
        MemoryStreamBuffer buffer(*bytes);
        std::istream stream(&buffer);
        tinyobj::LoadMtl(material_map, materials, &stream, warn, err);
        return !materials->empty();
    }

    std::vector<std::string> warnings;

  private:
    std::filesystem::path folder_;
};

class ObjCollector {
  public:
    ObjCollector(const std::string& name, LineCounts counts);

    void add_vertex(const glm::vec3& position);
    void add_normal(const glm::vec3& normal) { normals_.push_back(normal); }
    void add_face(std::span<const tinyobj::index_t> corners);
    void use_material(const std::string& material_name);
    void set_file_materials(std::span<const tinyobj::material_t> materials);
    void start_group() { ++group_; }

    /// The scene; `warnings` are added to its own.
    Result<Scene> finish(const std::vector<std::string>& warnings);

  private:
    std::optional<std::uint32_t> resolve(int written, std::size_t count, const char* what);
    std::uint32_t pair_of(std::uint32_t vertex, std::uint32_t normal);
    ObjPiece& piece_for(bool normals);

    /// A (position, normal) pair that a face uses, in a list per position.
    struct Pair {
        std::uint32_t normal = 0;
        std::uint32_t next = kNone;
    };

    const std::string& name_;
    std::vector<std::uint64_t> bad_vertices_;
    std::size_t next_bad_ = 0;
    std::vector<glm::vec3> positions_, normals_;
    std::vector<std::uint32_t> first_pair_;  ///< per position
    std::vector<Pair> pairs_;
    std::vector<glm::vec3> pair_positions_, pair_normals_;
    std::vector<Material> materials_;
    std::map<std::string, std::size_t> material_of_name_;
    std::size_t material_ = kNone;
    std::size_t group_ = 0;
    std::uint64_t faces_ = 0, degenerate_ = 0;
    std::vector<ObjPiece> pieces_;
    std::map<std::tuple<std::size_t, std::size_t, bool>, std::size_t>
        piece_of_;  ///< group, material, normals
    std::optional<Error> error_;
    std::vector<glm::dvec3> corner_positions_;               // scratch
    std::vector<std::uint32_t> corner_indices_, triangles_;  // scratch
};

ObjCollector::ObjCollector(const std::string& name, LineCounts counts)
    : name_(name), bad_vertices_(std::move(counts.bad_vertices)) {
    positions_.reserve(counts.vertices);
    normals_.reserve(counts.normals);
}

void ObjCollector::add_vertex(const glm::vec3& position) {
    const bool bad = next_bad_ < bad_vertices_.size() && bad_vertices_[next_bad_] == positions_.size();
    if (bad) ++next_bad_;
    positions_.push_back(bad ? glm::vec3(std::numeric_limits<float>::quiet_NaN()) : position);
}

/// Indices count from 1, negative ones from the last element so far.
std::optional<std::uint32_t> ObjCollector::resolve(int written, std::size_t count, const char* what) {
    const std::int64_t index =
        written > 0 ? std::int64_t{written} - 1 : static_cast<std::int64_t>(count) + std::int64_t{written};
    if (written != 0 && index >= 0 && index < static_cast<std::int64_t>(count))
        return static_cast<std::uint32_t>(index);
    error_ = Error{
        fmt::format("{}: face {}: {} index {} is out of range (there are {} so far); re-export the file",
                    name_, faces_, what, written, count)};
    return std::nullopt;
}

std::uint32_t ObjCollector::pair_of(std::uint32_t vertex, std::uint32_t normal) {
    first_pair_.resize(positions_.size(), kNone);
    for (std::uint32_t pair = first_pair_[vertex]; pair != kNone; pair = pairs_[pair].next)
        if (pairs_[pair].normal == normal) return pair;
    const auto pair = static_cast<std::uint32_t>(pairs_.size());
    pairs_.push_back({normal, first_pair_[vertex]});
    first_pair_[vertex] = pair;
    pair_positions_.push_back(positions_[vertex]);
    pair_normals_.push_back(normals_[normal]);
    return pair;
}

ObjPiece& ObjCollector::piece_for(bool normals) {
    if (material_ == kNone) use_material("default");
    const auto [place, is_new] =
        piece_of_.try_emplace(std::tuple(group_, material_, normals), pieces_.size());
    if (is_new) pieces_.push_back({material_, normals, {}});
    return pieces_[place->second];
}

void ObjCollector::add_face(std::span<const tinyobj::index_t> corners) {
    if (error_) return;
    ++faces_;
    if (corners.size() < 3) {
        ++degenerate_;
        return;
    }
    bool with_normals = true;
    for (const tinyobj::index_t& corner : corners) with_normals = with_normals && corner.normal_index != 0;
    corner_positions_.clear();
    corner_indices_.clear();
    for (const tinyobj::index_t& corner : corners) {
        const auto vertex = resolve(corner.vertex_index, positions_.size(), "vertex");
        if (!vertex) return;
        corner_positions_.emplace_back(positions_[*vertex]);
        if (with_normals) {
            const auto normal = resolve(corner.normal_index, normals_.size(), "normal");
            if (!normal) return;
            corner_indices_.push_back(pair_of(*vertex, *normal));
        } else {
            corner_indices_.push_back(*vertex);
        }
    }
    triangles_.clear();
    triangulate_polygon(corner_positions_, triangles_);
    ObjPiece& piece = piece_for(with_normals);
    for (const std::uint32_t corner : triangles_) piece.indices.push_back(corner_indices_[corner]);
}

void ObjCollector::set_file_materials(std::span<const tinyobj::material_t> materials) {
    for (const tinyobj::material_t& source : materials) {
        const std::string material_name = one_line(source.name);
        const auto [place, is_new] = material_of_name_.try_emplace(material_name, materials_.size());
        if (!is_new) continue;
        Material& material = materials_.emplace_back();
        material.name = material_name;
        for (int c = 0; c < 3; ++c) material.colour[c] = static_cast<float>(source.diffuse[c]);
        material.alpha_tested = source.dissolve < 1.0f || !source.alpha_texname.empty();
        // Under a texture, grey is no colour of the material's own.
        const bool grey = material.colour.r == material.colour.g && material.colour.g == material.colour.b;
        if (grey && !source.diffuse_texname.empty()) material.colour = glm::vec3(1.0f);
    }
}

/// A name that no `.mtl` file defines becomes a material too: what is drawn together stays together.
void ObjCollector::use_material(const std::string& material_name) {
    const auto [place, is_new] = material_of_name_.try_emplace(material_name, materials_.size());
    if (is_new) materials_.push_back({material_name, glm::vec3(1.0f), false, false});
    material_ = place->second;
}

Result<Scene> ObjCollector::finish(const std::vector<std::string>& warnings) {
    if (error_) return *error_;
    colour_white_materials(materials_);
    WorldBounds bounds;
    for (const glm::vec3& position : positions_) bounds.grow(position);
    SceneBuilder builder(choose_origin(bounds));
    for (Material& material : materials_) builder.add_material(std::move(material));
    for (const ObjPiece& piece : pieces_) {
        MeshPiece mesh;
        mesh.positions = piece.normals ? pair_positions_ : positions_;
        if (piece.normals) mesh.normals = pair_normals_;
        mesh.indices = piece.indices;
        builder.add_static(MaterialId{static_cast<std::uint32_t>(piece.material)}, mesh);
    }
    for (const std::string& warning : warnings) builder.add_warning(warning);
    if (degenerate_ > 0)
        builder.add_warning(fmt::format("{} faces with fewer than three corners were left out", degenerate_));
    return builder.finish(name_);
}

tinyobj::callback_t callbacks() {
    tinyobj::callback_t calls;
    calls.vertex_cb = [](void* user, float x, float y, float z, float) {
        static_cast<ObjCollector*>(user)->add_vertex({x, y, z});
    };
    calls.normal_cb = [](void* user, float x, float y, float z) {
        static_cast<ObjCollector*>(user)->add_normal({x, y, z});
    };
    calls.index_cb = [](void* user, tinyobj::index_t* corners, int count) {
        static_cast<ObjCollector*>(user)->add_face({corners, static_cast<std::size_t>(count)});
    };
    calls.usemtl_cb = [](void* user, const char* name, int) {
        static_cast<ObjCollector*>(user)->use_material(one_line(name));
    };
    calls.mtllib_cb = [](void* user, const tinyobj::material_t* materials, int count) {
        static_cast<ObjCollector*>(user)->set_file_materials({materials, static_cast<std::size_t>(count)});
    };
    calls.group_cb = [](void* user, const char**, int) { static_cast<ObjCollector*>(user)->start_group(); };
    calls.object_cb = [](void* user, const char*) { static_cast<ObjCollector*>(user)->start_group(); };
    return calls;
}

}  // namespace

Result<Scene> import_obj(const std::filesystem::path& file, const std::string& name, std::string bytes) {
    if (bytes.find('\0') != std::string::npos)
        return Error{name + ": the file is not text; export it again as Wavefront OBJ"};
    LineCounts counts = count_lines(bytes);
    // Beside the scene: the loader's arrays and pairs, at most 40 bytes a corner and 24 a vertex.
    const std::uint64_t reading = 40 * counts.corners + 24 * (counts.vertices + counts.normals);
    const std::uint64_t triangles = counts.corners - std::min(counts.corners, 2 * counts.faces);
    const std::uint64_t scene = estimated_scene_bytes(triangles, counts.corners, 16);
    if (Status s = check_memory(name, reading + scene); !s) return s.error();

    ObjCollector collector(name, std::move(counts));
    MemoryStreamBuffer buffer(bytes);
    std::istream stream(&buffer);
    MtlReader materials(file.parent_path());
    std::string warning, error;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks(), &collector, &materials, &warning, &error) ||
        !error.empty())
        return Error{
            fmt::format("{}: the file is not valid OBJ ({}); export it again", name, one_line(error))};
    return collector.finish(materials.warnings);
}

}  // namespace rhview
