// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Small scene files for the importer tests, and what every imported scene must satisfy.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "rhview/scenes/import.h"

namespace rhview {

/// A folder of the running test's own, removed at the end.
class TestFolder {
  public:
    TestFolder() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::path(testing::TempDir()) /
                (std::string("rhview_") + info->test_suite_name() + "_" + info->name());
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~TestFolder() { std::filesystem::remove_all(path_); }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;

    [[nodiscard]] std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        // Some file systems write a truncated file through to the disk, which makes thousands of them slow.
        std::filesystem::remove(path_ / name);
        std::ofstream stream(path_ / name, std::ios::binary);
        stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return path_ / name;
    }
    [[nodiscard]] Result<Scene> import(const std::string& name, std::string_view bytes) const {
        return import_scene(write(name, bytes));
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

template <class T>
void append(std::string& bytes, std::initializer_list<T> values) {
    for (const T& value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline std::string glb(const std::string& json, const std::string& binary) {
    const auto chunk = [](const char* type, std::string data, char padding) {
        while (data.size() % 4 != 0) data += padding;
        std::string bytes;
        append<std::uint32_t>(bytes, {static_cast<std::uint32_t>(data.size())});
        return bytes + std::string(type, 4) + data;
    };
    const std::string chunks =
        chunk("JSON", json, ' ') + (binary.empty() ? "" : chunk("BIN\0", binary, '\0'));
    std::string bytes = "glTF";
    append<std::uint32_t>(bytes, {2, static_cast<std::uint32_t>(12 + chunks.size())});
    return bytes + chunks;
}

/// A glTF file under construction: buffer 0 is `binary`, every `add` makes a buffer view and an accessor.
struct GltfFile {
    nlohmann::json json = {{"asset", {{"version", "2.0"}}},
                           {"scene", 0},
                           {"scenes", {{{"nodes", {0}}}}},
                           {"nodes", {{{"mesh", 0}}}}};
    std::string binary;

    template <class T>
    int add(std::initializer_list<T> values, int component_type, const char* type, std::size_t count,
            bool normalized = false, int stride = 0) {
        while (binary.size() % 4 != 0) binary += '\0';
        nlohmann::json view = {
            {"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", values.size() * sizeof(T)}};
        if (stride != 0) view["byteStride"] = stride;
        append(binary, values);
        json["bufferViews"].push_back(view);
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", component_type},
                                     {"count", count},
                                     {"type", type},
                                     {"normalized", normalized}});
        return static_cast<int>(json["accessors"].size()) - 1;
    }
    [[nodiscard]] std::string bytes() const {
        nlohmann::json whole = json;
        if (!binary.empty()) whole["buffers"] = {{{"byteLength", binary.size()}}};
        return glb(whole.dump(), binary);
    }
};

constexpr int kFloat = 5126, kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
              kUnsignedInt = 5125;

/// A closed cube from (0,0,0) to (1,1,1): positions are accessor 0, indices accessor 1.
inline GltfFile cube_gltf() {
    GltfFile file;
    file.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1}, kFloat, "VEC3",
                    8);
    file.add<std::uint16_t>({0, 3, 2, 0, 2, 1, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                             1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7},
                            kUnsignedShort, "SCALAR", 36);
    file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
    return file;
}

/// Positive where the outside of a closed surface is outside.
inline double signed_volume(const Scene& scene) {
    double volume = 0.0;
    for (const SceneBatch& batch : scene.batches) {
        const auto& p = scene.pools[batch.pool].positions;
        for (std::size_t i = 0; i < batch.indices.size(); i += 3) {
            const glm::dvec3 a(p[batch.indices[i]]), b(p[batch.indices[i + 1]]), c(p[batch.indices[i + 2]]);
            volume += glm::dot(a, glm::cross(b, c)) / 6.0;
        }
    }
    return volume;
}

/// Either a sound scene or one sentence that begins with the file's name: nothing else may come of any bytes.
inline void expect_sound(const Result<Scene>& result, const std::filesystem::path& file) {
    if (!result.ok()) {
        const std::string& message = result.error().message;
        EXPECT_EQ(message.rfind(file.string(), 0), 0u) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return;
    }
    for (const SceneBatch& batch : result->batches) {
        const VertexPool& pool = result->pools[batch.pool];
        ASSERT_LT(static_cast<std::size_t>(batch.material), result->materials.size());
        ASSERT_EQ(batch.indices.size() % 3, 0u);
        for (const std::uint32_t index : batch.indices) {
            ASSERT_LT(index, pool.positions.size());
            ASSERT_TRUE(std::isfinite(glm::dot(glm::dvec3(pool.positions[index]), glm::dvec3(1.0))));
        }
        std::size_t covered = 0;
        for (const SceneObject& object : batch.objects) {
            ASSERT_EQ(object.first_index, covered);
            covered += object.index_count;
        }
        ASSERT_EQ(covered, batch.indices.size());
        ASSERT_TRUE(pool.normals.empty() || pool.normals.size() == pool.positions.size());
        ASSERT_TRUE(pool.colours.empty() || pool.colours.size() == pool.positions.size());
    }
}

inline void expect_error(const Result<Scene>& result, std::string_view part) {
    ASSERT_FALSE(result.ok());
    EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
    EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
}

}  // namespace rhview
