// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What the importers share. `name` is the file as the caller gave it: every error sentence begins with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/scenes/import.h"
#include "rhview/scenes/scene.h"

namespace rhview {

Result<Scene> import_gltf(const std::filesystem::path& file, const std::string& name, std::string bytes,
                          RepeatedMeshes repeated);
Result<Scene> import_obj(const std::filesystem::path& file, const std::string& name, std::string bytes);
Result<Scene> import_ply(const std::string& name, std::string bytes);

/// The whole file. Errors: missing, not a regular file, unreadable, empty, larger than the memory that is
/// free.
Result<std::string> read_file(const std::filesystem::path& file, const std::string& name);

/// `text` with every run of white space and control characters folded to one space, none at the ends.
std::string one_line(std::string_view text);

/// Box in world space, in double. Points that are not finite are left out.
struct WorldBounds {
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};

    void grow(const glm::dvec3& point);
    [[nodiscard]] bool is_empty() const { return !(min.x <= max.x); }
};

/// The origin that keeps `float` positions exact enough: zero, or the rounded centre of a scene that lies far
/// from zero (centre beyond 64 × its largest side, or a coordinate beyond 65,536).
glm::dvec3 choose_origin(const WorldBounds& bounds);

/// Textures are not read, so a textured scene's colours are all white: where several materials are and no
/// other colour is, each gets a muted colour of its own, the hue turned by the golden ratio from one index to
/// the next.
void colour_white_materials(std::vector<Material>& materials);

/// Appends the triangles of a simple polygon as corner numbers (0 … n-1), n-2 of them in the polygon's own
/// winding. Concave polygons are cut by ears; above 256 corners, or where no ear is found, by a fan.
void triangulate_polygon(std::span<const glm::dvec3> corners, std::vector<std::uint32_t>& triangles);

}  // namespace rhview
