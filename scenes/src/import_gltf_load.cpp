// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "import_gltf_internal.h"

namespace rhview::gltf {
namespace {

constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

std::uint32_t little_endian_u32(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

/// The container of section 4 of the specification; `json` is set to the JSON chunk's text.
Status check_glb(const std::string& name, const std::string& bytes, std::string_view& json) {
    if (bytes.size() < kHeaderBytes + kChunkHeaderBytes)
        return Error{
            fmt::format("{}: the file is truncated ({} bytes); export it again", name, bytes.size())};
    const std::uint32_t version = little_endian_u32(bytes, 4);
    if (version != 2) return Error{fmt::format("{}: this is glTF {}; export it as glTF 2.0", name, version)};
    const std::size_t length = little_endian_u32(bytes, 8);
    if (length > bytes.size()) {
        return Error{
            fmt::format("{}: the file is truncated (its header says {} bytes, there are {}); export it again",
                        name, length, bytes.size())};
    }
    std::size_t at = kHeaderBytes;
    for (int chunk = 0; at < length; ++chunk) {
        if (length - at < kChunkHeaderBytes ||
            little_endian_u32(bytes, at) > length - at - kChunkHeaderBytes) {
            return Error{fmt::format("{}: chunk {} at byte {} is longer than the file; export it again", name,
                                     chunk, at)};
        }
        const std::size_t chunk_bytes = little_endian_u32(bytes, at);
        if (chunk == 0) {
            if (bytes.compare(at + 4, 4, "JSON") != 0)
                return Error{name + ": the first chunk is not JSON; export it again"};
            json = std::string_view(bytes).substr(at + kChunkHeaderBytes, chunk_bytes);
        }
        at += kChunkHeaderBytes + chunk_bytes;
    }
    if (json.empty()) return Error{name + ": there is no JSON chunk; export it again"};
    return success();
}

/// TinyGLTF copies extras and extensions recursively: nesting must not reach the end of the stack.
bool nests_too_deep(std::string_view json) {
    constexpr int kDeepest = 200;
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kDeepest) return true;
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return false;
}

/// What the file callbacks need: buffers are read, by names relative to the file's folder; textures are not.
struct FileAccess {
    const tinygltf::Model* model = nullptr;
    std::string folder;
    std::string missing;  ///< the first buffer file that is not there
};

bool file_exists(const std::string& path, void* user) {
    auto& access = *static_cast<FileAccess*>(user);
    // TinyGLTF parses buffers before meshes and images after them: what is asked for now is a texture.
    if (!access.model->meshes.empty()) return false;
    // It would also look in the working directory.
    if (path.rfind(access.folder, 0) != 0) return false;
    std::error_code code;
    if (std::filesystem::is_regular_file(path, code)) return true;
    if (access.missing.empty()) access.missing = path;
    return false;
}

std::string keep_path(const std::string& path, void*) {
    return path;
}

bool read_whole_file(std::vector<unsigned char>* out, std::string* error, const std::string& path, void*) {
    Result<std::string> bytes = read_file(path, path);
    if (!bytes) {
        if (error != nullptr) *error = bytes.error().message;
        return false;
    }
    out->assign(bytes->begin(), bytes->end());
    return true;
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

bool load_no_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*,
                   int, void*) {
    return true;
}

Status check_extensions(const std::string& name, const tinygltf::Model& model) {
    constexpr std::array<std::string_view, 4> kHideGeometry{
        "EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression", "EXT_meshopt_compression",
        "KHR_meshopt_compression"};
    for (const std::string& extension : model.extensionsRequired) {
        if (std::find(kHideGeometry.begin(), kHideGeometry.end(), extension) != kHideGeometry.end()) {
            return Error{
                fmt::format("{}: the file requires the extension {}, which is not supported; export it "
                            "without that extension",
                            name, extension)};
        }
    }
    return success();
}

/// The library's own words without nlohmann-json's exception tag.
std::string library_words(const std::string& error) {
    const std::size_t tag = error.find("] ");
    return one_line(error.rfind("[json.", 0) == 0 && tag != std::string::npos ? error.substr(tag + 2)
                                                                              : error);
}

}  // namespace

// The bytes are taken, so that they are gone before the model becomes a scene.
// cppcheck-suppress passedByValue
Status load_model(const std::filesystem::path& file, const std::string& name, std::string bytes,
                  tinygltf::Model& model) {
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max())
        return Error{name + ": glTF files end at 4 GiB; split the scene"};
    const bool binary = bytes.rfind("glTF", 0) == 0;
    std::string_view json = bytes;
    if (binary) {
        if (Status s = check_glb(name, bytes, json); !s) return s;
    }
    if (nests_too_deep(json)) return Error{name + ": the JSON is nested too deeply; export it again"};

    FileAccess access;
    access.model = &model;
    const std::string folder = file.parent_path().empty() ? "." : file.parent_path().string();
    access.folder = folder;
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(load_no_image, nullptr);
    loader.SetFsCallbacks({file_exists, keep_path, read_whole_file, write_nothing, &access});
    std::string error, warning;
    const bool loaded =
        binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                             reinterpret_cast<const unsigned char*>(bytes.data()),
                                             little_endian_u32(bytes, 8), folder)
               : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(),
                                            static_cast<unsigned int>(bytes.size()), folder);
    // A file with compressed geometry may also lack buffers: the extension is the reason to name.
    if (Status s = check_extensions(name, model); !s) return s;
    if (!access.missing.empty()) {
        return Error{
            fmt::format("{}: the buffer file {} is missing; put it there or export the scene as .glb", name,
                        access.missing)};
    }
    // TinyGLTF skips a primitive that it cannot parse and goes on: only the error text tells.
    if (!loaded || !error.empty())
        return Error{
            fmt::format("{}: the file is not valid glTF ({}); export it again", name, library_words(error))};
    if (model.asset.version.rfind("2.", 0) != 0)
        return Error{fmt::format("{}: this is glTF {}; export it as glTF 2.0", name, model.asset.version)};
    return success();
}

}  // namespace rhview::gltf
