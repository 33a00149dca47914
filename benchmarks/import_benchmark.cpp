// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// Reading a scene file and flattening it into batches. The files stay in the system's cache after the first
// pass.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "rhview/scenes/import.h"

namespace rhview {
namespace {

constexpr int kGridSide = 700;  // squares: 980,000 triangles

std::string text_grid() {
    std::string text;
    for (int y = 0; y <= kGridSide; ++y)
        for (int x = 0; x <= kGridSide; ++x)
            text.append("v ")
                .append(std::to_string(0.25 * x))
                .append(" 0 ")
                .append(std::to_string(0.25 * y))
                .append("\n");
    for (int y = 0; y < kGridSide; ++y) {
        for (int x = 0; x < kGridSide; ++x) {
            const int a = y * (kGridSide + 1) + x + 1;
            text.append("f");
            for (const int corner : {a, a + kGridSide + 1, a + kGridSide + 2, a + 1})
                text.append(" ").append(std::to_string(corner));
            text.append("\n");
        }
    }
    return text;
}

template <class T>
void append(std::string& bytes, std::initializer_list<T> values) {
    for (const T& value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Little-endian machines only: the benchmark writes what it has in memory.
std::string binary_grid() {
    constexpr int kVertices = (kGridSide + 1) * (kGridSide + 1);
    std::string bytes("ply\nformat binary_little_endian 1.0\nelement vertex ");
    bytes.append(std::to_string(kVertices))
        .append("\nproperty float x\nproperty float y\nproperty float z\nelement face ");
    bytes.append(std::to_string(2 * kGridSide * kGridSide))
        .append("\nproperty list uchar int vertex_indices\nend_header\n");
    for (int y = 0; y <= kGridSide; ++y)
        for (int x = 0; x <= kGridSide; ++x)
            append<float>(bytes, {0.25f * static_cast<float>(x), 0.0f, 0.25f * static_cast<float>(y)});
    for (int y = 0; y < kGridSide; ++y) {
        for (int x = 0; x < kGridSide; ++x) {
            const int a = y * (kGridSide + 1) + x;
            bytes.push_back(3);
            append<std::int32_t>(bytes, {a, a + kGridSide + 1, a + 1});
            bytes.push_back(3);
            append<std::int32_t>(bytes, {a + 1, a + kGridSide + 1, a + kGridSide + 2});
        }
    }
    return bytes;
}

void import_file(benchmark::State& state, const std::filesystem::path& file) {
    std::uint64_t triangles = 0;
    for (auto _ : state) {
        const Result<Scene> scene = import_scene(file);
        if (!scene) {
            state.SkipWithError(scene.error().message.c_str());
            return;
        }
        triangles = scene->static_triangles();
        benchmark::DoNotOptimize(triangles);
    }
    state.counters["triangles"] = static_cast<double>(triangles);
    state.counters["Mtri/s"] =
        benchmark::Counter(static_cast<double>(triangles) * 1e-6 * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate);
}

void import_real_scene(benchmark::State& state, const char* name) {
    const std::filesystem::path file = std::filesystem::path(RHVIEW_SHARED_SCENES_DIR) / name;
    if (!std::filesystem::exists(file)) {
        state.SkipWithError("the scene is not on this machine");
        return;
    }
    import_file(state, file);
}

void import_grid(benchmark::State& state, const char* name, std::string (*make)()) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / name;
    {
        std::ofstream stream(file, std::ios::binary);
        stream << make();
    }
    import_file(state, file);
    std::error_code code;
    std::filesystem::remove(file, code);
}

BENCHMARK_CAPTURE(import_real_scene, napata, "0ad_napata_reconstruction.glb")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(import_real_scene, castle, "intel_castle.glb")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(import_real_scene, castle_market, "intel_castle_market_substitute.glb")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(import_real_scene, candela_city, "stk_candela_city.glb")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(import_real_scene, nexuiz_reborn, "bsp_nexuiz_ons-reborn.glb")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(import_real_scene, pmuc_skid, "rvm_pmuc_plm_sample.glb")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(import_real_scene, huldra_supports, "rvm_huldra_wd1_psup.glb")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(import_grid, obj, "rhview_benchmark_grid.obj", text_grid)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(import_grid, ply, "rhview_benchmark_grid.ply", binary_grid)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace rhview

BENCHMARK_MAIN();
