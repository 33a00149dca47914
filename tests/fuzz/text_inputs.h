// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What reads files and words of people, used with any bytes; and small inputs to start from. Each aborts if
/// what it was told breaks a promise: an error is one sentence that begins with its source, a result is
/// sound.
#pragma once

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rhview/scenes/camera_path.h"
#include "rhview/scenes/import.h"
#include "rhview/scenes/named_scene.h"
#include "rhview/timing_model/profile.h"

namespace rhview {

inline void demand(bool condition) {
    if (!condition) std::abort();
}

inline void demand_sentence(const Error& error, std::string_view source) {
    demand(error.message.starts_with(source));
    demand(error.message.size() > source.size() + 5);
    demand(error.message.find('\n') == std::string::npos);
}

/// What is accepted can be written, and read again as the same.
inline bool use_profile(std::string_view text) {
    const Result<TimingProfile> profile = parse_profile(text, "p.json");
    if (!profile) {
        demand_sentence(profile.error(), "p.json: ");
        return false;
    }
    demand(validate(*profile).ok());
    const std::string written = profile_text(*profile);
    const Result<TimingProfile> again = parse_profile(written, "again");
    demand(again.ok() && profile_text(*again) == written);
    return true;
}

inline bool use_path(std::string_view text) {
    const Result<CameraPath> path = parse_camera_path(text, "p.json");
    if (!path) {
        demand_sentence(path.error(), "p.json");
        return false;
    }
    demand(validate(*path).ok());
    for (int frame = 0; frame < 3; ++frame)
        demand(validate(path->view_of_frame(frame, 3, 1.5, ClipDepth::ReversedZeroToOne)).ok());
    const std::string written = to_json(*path);
    const Result<CameraPath> again = parse_camera_path(written, "again");
    demand(again.ok() && to_json(*again) == written);
    return true;
}

/// A last parameter that is empty makes every scene an error, once all before it were read: so none is built.
inline bool use_scene_parameters(std::string_view text) {
    const std::string spec = std::string(text) + (text.find(':') == std::string_view::npos ? ":" : ",");
    const Result<SceneAndPath> scene = make_named_scene(spec);
    demand(!scene.ok() && scene.error().message.size() > 10);
    return scene.error().message.find("a parameter is empty") != std::string::npos;
}

/// The bytes as a scene file with this extension.
inline bool use_scene_file(std::string_view bytes, const char* extension) {
    static const std::filesystem::path folder = [] {
        std::filesystem::path made =
            std::filesystem::temp_directory_path() / ("rhview_fuzz_" + std::to_string(getpid()));
        std::filesystem::create_directories(made);
        return made;
    }();
    const std::filesystem::path file = folder / (std::string("scene.") + extension);
    // Some file systems write a truncated file through to the disk, which makes thousands of them slow.
    std::filesystem::remove(file);
    {
        std::ofstream stream(file, std::ios::binary);
        stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        demand(stream.good());
    }
    const Result<Scene> scene = import_scene(file);
    if (!scene) {
        demand_sentence(scene.error(), file.string());
        return false;
    }
    for (const SceneBatch& batch : scene->batches) {
        demand(index_of(batch.material) < scene->materials.size());
        const std::size_t vertices = scene->pools.at(batch.pool).positions.size();
        for (const std::uint32_t index : batch.indices) {
            demand(index < vertices);
            const glm::vec3& p = scene->pools[batch.pool].positions[index];
            demand(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
        }
    }
    return true;
}

struct TextTarget {
    const char* name;
    bool (*use)(std::string_view bytes);
    std::vector<std::string> seeds;  ///< all but the last are accepted
};

inline const std::vector<TextTarget>& text_targets() {
    using namespace std::string_literals;
    static const std::vector<TextTarget> targets{
        {"profile",
         use_profile,
         {R"({"schema": "rhview.profile/1", "device": {"renderer": "r", "version": "v"}, "c0_ns": 1, "c1_ns": 0.5,
"c3_ns": 2})",
          R"({"schema": "rhview.profile/1", "device": {"renderer": "a\u00e9", "version": ""}, "c0_ns": 1,
"c1_ns": 0.25, "c3_ns": 3e3, "samples": 30, "standard_errors": {"c1_ns": 0.1}})",
          R"({"schema": "rhview.profile/1", "c1_ns": 1e999})"}},
        {"path",
         use_path,
         {R"({"schema": "rhview.path/1", "keys": [{"time": 0, "eye": [0, 0, 0], "target": [0, 0, -1]},
{"time": 1, "eye": [0, 0, 1], "target": [0, 0, -1]}]})",
          R"({"schema": "rhview.path/1", "fov_y_deg": 60, "near": 0.1, "far": "infinity", "up": [0, 1, 0], "keys": [
{"time": 0, "eye": [0, 1, 0], "target": [1, 1, 0]}, {"time": 2, "eye": [1e6, -1, 3], "target": [0, 0, 0]}]})",
          R"({"schema": "rhview.path/1", "keys": [{"time": 0, "eye": [0, 0], "target": [0, 0, -1]}]})"}},
        {"scene_parameters",
         use_scene_parameters,
         {"town", "town:size=700,seed=7", "soup:triangles=1000", "farm:instances=3,mesh=1000",
          "town:size=99999999999999999999"}},
        {"obj",
         [](std::string_view bytes) { return use_scene_file(bytes, "obj"); },
         {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
          "mtllib a.mtl\no a\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\ng b\nusemtl m\ns "
          "1\nf -4//1 "
          "-3//1 -2//1 -1//1\nf 1/1/1 2/1/1 3/1/1\n",
          "v 0 0 0\nf 1 2 9\n"}},
        {"ply",
         [](std::string_view bytes) { return use_scene_file(bytes, "ply"); },
         {"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty double y\nproperty float z\n"
          "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 "
          "2\n",
          "ply\nformat binary_little_endian 1.0\ncomment c\nelement vertex 3\nproperty short x\n"
          "property short y\nproperty short z\nproperty uchar red\nproperty uchar green\n"
          "property uchar blue\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n"
          "\0\0\0\0\0\0abc\1\0\0\0\0\0abc\0\0\1\0\0\0abc\3\0\1\2"s,
          "ply\nformat ascii 1.0\nelement vertex 4294967295\nproperty float x\nend_header\n"}},
        {"gltf",
         [](std::string_view bytes) { return use_scene_file(bytes, "gltf"); },
         {R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[1,-1,2]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{"byteLength":44,"uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAA="}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})",
          R"({"asset":{"version":"2.0"},"nodes":[{"children":[0]}],"scenes":[{"nodes":[0]}]})"}},
    };
    return targets;
}

}  // namespace rhview
