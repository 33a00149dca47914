// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <fstream>
#include <glm/common.hpp>
#include <new>
#include <system_error>

#include "import_internal.h"
#include "rhview/scenes/memory.h"

namespace rhview {
namespace {

constexpr const char* kSupported = ".glb, .gltf, .obj and .ply";

std::string lower_case_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

Result<Scene> dispatch(const std::filesystem::path& file, const std::string& name, RepeatedMeshes repeated) {
    const std::string extension = lower_case_extension(file);
    const bool gltf = extension == ".glb" || extension == ".gltf";
    std::error_code ignored;
    const bool folder = std::filesystem::is_directory(file, ignored);  // told as such, whatever its name
    if (!folder && !gltf && extension != ".obj" && extension != ".ply") {
        return Error{
            fmt::format("{}: unknown scene format '{}'; use one of {}", name, extension, kSupported)};
    }
    Result<std::string> bytes = read_file(file, name);
    if (!bytes) return bytes.error();
    if (gltf) return import_gltf(file, name, std::move(*bytes), repeated);
    if (extension == ".obj") return import_obj(file, name, std::move(*bytes));
    return import_ply(name, std::move(*bytes));
}

/// Hue in turns; saturation and value are those of a muted paint. Linear RGB.
glm::vec3 muted_colour(std::size_t index) {
    constexpr double kGoldenRatio = 0.618033988749895;
    constexpr double kSaturation = 0.4, kValue = 0.8, kFirstHue = 0.09;
    const double turns = kFirstHue + kGoldenRatio * static_cast<double>(index);
    glm::vec3 colour;
    for (int channel = 0; channel < 3; ++channel) {
        // The hue circle: each channel is a trapezoid, a third of a turn after the one before.
        const double position = 6.0 * std::fmod(turns + (3.0 - channel) / 3.0, 1.0);
        const double ramp = std::clamp(std::abs(position - 3.0) - 1.0, 0.0, 1.0);
        colour[channel] = static_cast<float>(std::pow(kValue * (1.0 - kSaturation * (1.0 - ramp)), 2.2));
    }
    return colour;
}

}  // namespace

Result<std::string> read_file(const std::filesystem::path& file, const std::string& name) {
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(file, code);
    if (status.type() == std::filesystem::file_type::not_found)
        return Error{name + ": there is no such file; check the path"};
    if (std::filesystem::is_directory(status))
        return Error{name + ": this is a directory; name a scene file in it"};
    if (!std::filesystem::is_regular_file(status))
        return Error{name + ": this is not a regular file; name a scene file"};
    const std::uintmax_t size = std::filesystem::file_size(file, code);
    if (code)
        return Error{fmt::format("{}: cannot be read ({}); check its permissions", name, code.message())};
    if (size == 0) return Error{name + ": the file is empty; export it again"};
    if (Status fits = check_memory(name, size); !fits) return fits.error();
    std::ifstream stream(file, std::ios::binary);
    std::string bytes;
    if (stream) {
        bytes.resize(static_cast<std::size_t>(size));
        stream.read(bytes.data(), static_cast<std::streamsize>(size));
    }
    if (!stream || stream.gcount() != static_cast<std::streamsize>(size))
        return Error{name + ": cannot be read; check its permissions"};
    return bytes;
}

std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte > ' ' && byte != 0x7f)
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += ' ';
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
}

void WorldBounds::grow(const glm::dvec3& point) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) return;
    min = glm::min(min, point);
    max = glm::max(max, point);
}

glm::dvec3 choose_origin(const WorldBounds& bounds) {
    constexpr double kFarSides = 64.0, kFarCoordinate = 65536.0;
    if (bounds.is_empty()) return glm::dvec3(0.0);
    const auto largest = [](const glm::dvec3& v) {
        return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    };
    const glm::dvec3 centre = 0.5 * bounds.min + 0.5 * bounds.max;
    const bool far_centre = largest(centre) > kFarSides * largest(bounds.max - bounds.min);
    const bool far_corner = std::max(largest(bounds.min), largest(bounds.max)) > kFarCoordinate;
    return far_centre || far_corner ? glm::round(centre) : glm::dvec3(0.0);
}

void colour_white_materials(std::vector<Material>& materials) {
    const auto is_white = [](const Material& material) { return material.colour == glm::vec3(1.0f); };
    if (materials.size() < 2 || !std::all_of(materials.begin(), materials.end(), is_white)) return;
    for (std::size_t i = 0; i < materials.size(); ++i) materials[i].colour = muted_colour(i);
}

Result<Scene> import_scene(const std::filesystem::path& file, RepeatedMeshes repeated) {
    // The reading libraries throw; hostile counts make the standard containers throw.
    std::string name = "scene file";
    try {
        name = file.string();
        Result<Scene> scene = dispatch(file, name, repeated);
        if (!scene) return Error{one_line(scene.error().message)};
        for (std::string& warning : scene->warnings) warning = one_line(warning);
        scene->name = file.stem().string();
        return scene;
    } catch (const std::bad_alloc&) {
        return Error{name + ": there is not enough memory to read it; make it smaller"};
    } catch (const std::exception& problem) {
        return Error{
            one_line(fmt::format("{}: the data is corrupt ({}); export it again", name, problem.what()))};
    } catch (...) {
        return Error{name + ": the data is corrupt; export it again"};
    }
}

}  // namespace rhview
