// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "import_gltf_internal.h"
#include "rhview/scenes/memory.h"

namespace rhview::gltf {
namespace {

/// A primitive's accessors, checked, before anything is decoded.
struct CheckedPrimitive {
    std::string place;
    int mode = TINYGLTF_MODE_TRIANGLES;
    int position_id = -1, normal_id = -1, colour_id = -1, index_id = -1;
    CheckedAccessor positions, normals, colours, indices;
    std::size_t material = 0;
};

bool draws_triangles(int mode) {
    return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

Status check_attribute(const std::string& place, const char* attribute, const tinygltf::Model& model,
                       const tinygltf::Primitive& source, int& id, CheckedAccessor& accessor) {
    const auto found = source.attributes.find(attribute);
    if (found == source.attributes.end()) return success();
    id = found->second;
    Result<CheckedAccessor> checked = check_accessor(place + ": " + attribute, model, id);
    if (!checked) return checked.error();
    accessor = *checked;
    return success();
}

Result<CheckedPrimitive> check_primitive(const std::string& place, const tinygltf::Model& model,
                                         const tinygltf::Primitive& source) {
    CheckedPrimitive primitive;
    primitive.place = place;
    primitive.mode = source.mode;
    for (Status s :
         {check_attribute(place, "POSITION", model, source, primitive.position_id, primitive.positions),
          check_attribute(place, "NORMAL", model, source, primitive.normal_id, primitive.normals),
          check_attribute(place, "COLOR_0", model, source, primitive.colour_id, primitive.colours)}) {
        if (!s) return s.error();
    }
    if (source.indices != -1) {
        primitive.index_id = source.indices;
        Result<CheckedAccessor> checked = check_accessor(place + ": indices", model, source.indices);
        if (!checked) return checked.error();
        primitive.indices = *checked;
    }
    const std::size_t vertices = primitive.positions.base.count;
    if ((primitive.normal_id != -1 && primitive.normals.base.count != vertices) ||
        (primitive.colour_id != -1 && primitive.colours.base.count != vertices)) {
        return Error{
            fmt::format("{}: NORMAL or COLOR_0 has another length than POSITION ({}); re-export the file",
                        place, vertices)};
    }
    if (source.material >= 0 && static_cast<std::size_t>(source.material) >= model.materials.size()) {
        return Error{fmt::format("{}: material {} does not exist (the file has {}); re-export the file",
                                 place, source.material, model.materials.size())};
    }
    primitive.material =
        source.material >= 0 ? static_cast<std::size_t>(source.material) : model.materials.size();
    return primitive;
}

/// Three indices per triangle; the winding rules are those of section 3.7.2.1. Stitches of strips (two equal
/// corners) are left out.
std::vector<std::uint32_t> expand_triangles(int mode, std::vector<std::uint32_t> corners) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        corners.resize(corners.size() - corners.size() % 3);
        return corners;
    }
    std::vector<std::uint32_t> triangles;
    if (corners.size() < 3) return triangles;
    triangles.reserve(3 * (corners.size() - 2));
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const bool strip = mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        const std::uint32_t a = corners[strip ? i : i + 1];
        const std::uint32_t b = corners[strip ? i + 1 + i % 2 : i + 2];
        const std::uint32_t c = corners[strip ? i + 2 - i % 2 : 0];
        if (a != b && b != c && a != c) triangles.insert(triangles.end(), {a, b, c});
    }
    return triangles;
}

WorldBounds bounds_of(const std::vector<glm::vec3>& positions) {
    WorldBounds bounds;
    for (const glm::vec3& position : positions) bounds.grow(position);
    return bounds;
}

class Decoder {
  public:
    Decoder(const std::string& name, const tinygltf::Model& model) : name_(name), model_(model) {}

    Status check(const std::vector<bool>& used);
    Status decode();
    MeshData take();

  private:
    Status decode_primitive(const CheckedPrimitive& source, PrimitiveData& data);
    Status decode_positions(const CheckedPrimitive& source, PrimitiveData& data);
    Status decode_attributes(const CheckedPrimitive& source, PrimitiveData& data);
    Status decode_triangles(const CheckedPrimitive& source, PrimitiveData& data);

    /// Of an index list, found once however many primitives share it.
    struct IndexFacts {
        std::uint32_t largest = 0;
        std::uint64_t distinct = 0;  ///< 0: not counted yet
    };

    const std::string& name_;
    const tinygltf::Model& model_;
    std::vector<std::vector<CheckedPrimitive>> checked_;  ///< per mesh
    MeshData data_;
    std::map<int, std::size_t> positions_of_, normals_of_, colours_of_;
    std::map<std::tuple<int, int, std::size_t>, std::size_t>
        indices_of_;  ///< accessor, mode, vertices if without
    std::vector<IndexFacts> index_facts_;
    std::uint64_t not_triangles_ = 0, incomplete_ = 0;
};

Status Decoder::check(const std::vector<bool>& used) {
    checked_.resize(model_.meshes.size());
    std::map<int, std::uint64_t> bytes_of;  // per accessor: decoded once
    std::uint64_t iota_bytes = 0;
    for (std::size_t mesh = 0; mesh < model_.meshes.size(); ++mesh) {
        if (!used[mesh]) continue;
        const auto& primitives = model_.meshes[mesh].primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            const bool has_positions = primitives[i].attributes.count("POSITION") > 0;
            if (!draws_triangles(primitives[i].mode) || !has_positions) {
                ++not_triangles_;
                continue;
            }
            Result<CheckedPrimitive> primitive = check_primitive(
                fmt::format("{}: mesh {} primitive {}", name_, mesh, i), model_, primitives[i]);
            if (!primitive) return primitive.error();
            bytes_of[primitive->position_id] = primitive->positions.base.count;
            if (primitive->normal_id != -1) bytes_of[primitive->normal_id] = primitive->normals.base.count;
            if (primitive->colour_id != -1) bytes_of[primitive->colour_id] = primitive->colours.base.count;
            if (primitive->index_id != -1)
                bytes_of[primitive->index_id] = primitive->indices.base.count;
            else
                iota_bytes = std::max<std::uint64_t>(iota_bytes, primitive->positions.base.count);
            checked_[mesh].push_back(std::move(*primitive));
        }
    }
    // An element takes at most 12 bytes decoded, and as much again while a strip is expanded or colours are
    // packed.
    constexpr std::uint64_t kBytesPerElement = 24, kMostElements = std::uint64_t{1} << 56;
    std::uint64_t elements = 2 * std::min(iota_bytes, kMostElements);
    for (const auto& [accessor, count] : bytes_of)
        elements = std::min(elements + std::min(count, kMostElements), kMostElements);
    return check_memory(name_, elements * kBytesPerElement);
}

Status Decoder::decode() {
    data_.primitives.resize(checked_.size());
    for (std::size_t mesh = 0; mesh < checked_.size(); ++mesh) {
        for (const CheckedPrimitive& source : checked_[mesh]) {
            PrimitiveData data;
            if (Status s = decode_primitive(source, data); !s) return s;
            if (!data_.indices[data.indices].empty()) data_.primitives[mesh].push_back(data);
        }
    }
    return success();
}

Status Decoder::decode_primitive(const CheckedPrimitive& source, PrimitiveData& data) {
    data.material = source.material;
    if (Status s = decode_positions(source, data); !s) return s;
    if (Status s = decode_attributes(source, data); !s) return s;
    return decode_triangles(source, data);
}

Status Decoder::decode_positions(const CheckedPrimitive& source, PrimitiveData& data) {
    const auto [place, is_new] = positions_of_.try_emplace(source.position_id, data_.positions.size());
    data.positions = place->second;
    if (!is_new) return success();
    Result<std::vector<glm::vec3>> positions = decode_vectors(source.place + ": POSITION", source.positions);
    if (!positions) return positions.error();
    data_.position_bounds.push_back(bounds_of(*positions));
    data_.positions.push_back(std::move(*positions));
    return success();
}

Status Decoder::decode_attributes(const CheckedPrimitive& source, PrimitiveData& data) {
    data.normals = data.colours = kNone;
    if (source.normal_id != -1) {
        const auto [place, is_new] = normals_of_.try_emplace(source.normal_id, data_.normals.size());
        data.normals = place->second;
        if (is_new) {
            Result<std::vector<glm::vec3>> normals =
                decode_vectors(source.place + ": NORMAL", source.normals);
            if (!normals) return normals.error();
            data_.normals.push_back(std::move(*normals));
        }
    }
    if (source.colour_id != -1) {
        const auto [place, is_new] = colours_of_.try_emplace(source.colour_id, data_.colours.size());
        data.colours = place->second;
        if (is_new) {
            Result<std::vector<glm::vec3>> colours =
                decode_vectors(source.place + ": COLOR_0", source.colours);
            if (!colours) return colours.error();
            std::vector<PackedColour>& packed = data_.colours.emplace_back();
            packed.reserve(colours->size());
            for (glm::vec3& colour : *colours) {
                for (int c = 0; c < 3; ++c) colour[c] = std::isnan(colour[c]) ? 0.0f : colour[c];
                packed.push_back(pack_colour(colour));
            }
        }
    }
    return success();
}

Status Decoder::decode_triangles(const CheckedPrimitive& source, PrimitiveData& data) {
    const std::size_t vertices = data_.positions[data.positions].size();
    const std::size_t implied = source.index_id == -1 ? vertices : 0;
    const auto [place, is_new] =
        indices_of_.try_emplace(std::tuple(source.index_id, source.mode, implied), data_.indices.size());
    data.indices = place->second;
    if (is_new) {
        std::vector<std::uint32_t> corners;
        if (source.index_id != -1) {
            Result<std::vector<std::uint32_t>> decoded =
                decode_indices(source.place + ": indices", source.indices);
            if (!decoded) return decoded.error();
            corners = std::move(*decoded);
        } else {
            corners.resize(implied);
            for (std::size_t i = 0; i < implied; ++i) corners[i] = static_cast<std::uint32_t>(i);
        }
        if (source.mode == TINYGLTF_MODE_TRIANGLES && corners.size() % 3 != 0) ++incomplete_;
        const auto largest = std::max_element(corners.begin(), corners.end());
        index_facts_.push_back({largest == corners.end() ? 0 : *largest, 0});
        data_.indices.push_back(expand_triangles(source.mode, std::move(corners)));
    }
    IndexFacts& facts = index_facts_[data.indices];
    const std::vector<std::uint32_t>& indices = data_.indices[data.indices];
    if (facts.largest >= vertices && !indices.empty()) {
        return Error{
            fmt::format("{}: index {} is out of range (the primitive has {} vertices); re-export the file",
                        source.place, facts.largest, vertices)};
    }
    if (facts.distinct == 0) {
        std::vector<bool> seen(std::size_t{facts.largest} + 1);
        for (const std::uint32_t index : indices) {
            facts.distinct += seen[index] ? 0 : 1;
            seen[index] = true;
        }
    }
    data.used_vertices = facts.distinct;
    return success();
}

MeshData Decoder::take() {
    if (not_triangles_ > 0) {
        data_.warnings.push_back(fmt::format(
            "{} primitives that are points, lines or without positions were left out", not_triangles_));
    }
    if (incomplete_ > 0) {
        data_.warnings.push_back(fmt::format(
            "{} primitives end in the middle of a triangle; that triangle was left out", incomplete_));
    }
    return std::move(data_);
}

}  // namespace

Result<MeshData> decode_meshes(const std::string& name, const tinygltf::Model& model,
                               const std::vector<bool>& used) {
    Decoder decoder(name, model);
    if (Status s = decoder.check(used); !s) return s.error();
    if (Status s = decoder.decode(); !s) return s.error();
    return decoder.take();
}

}  // namespace rhview::gltf
