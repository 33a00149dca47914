// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <array>
#include <cmath>
#include <optional>

#include "loops.h"
#include "scene_recipe.h"
#include "shapes.h"

namespace rhview {
namespace {

using Vec = glm::dvec3;

constexpr double kRoom = 3.0;  ///< edge of the cube that a flyer has to itself
constexpr std::int64_t kKinds = 3;
constexpr int kTiles = 8;  ///< of the ground, along each side

/// The swarm fills a cube of this half edge that stands on its middle.
double half_edge(std::int64_t objects) {
    return 0.5 * kRoom * std::ceil(std::cbrt(static_cast<double>(objects)));
}

/// A body with a wing on one side only, so that a mirrored one looks different. `triangles`, about.
void add_flyer(ShapeBuffer& buffer, std::int64_t triangles) {
    const int sides = std::max(4, static_cast<int>(std::sqrt(static_cast<double>(triangles) / 4.0)));
    const int rings = std::max(3, static_cast<int>(triangles / 2 / (2 * sides)) + 1);
    add_sphere(buffer, {{0.0, 0.0, 0.0}}, 0.3, 0.5, sides, rings);
    const int segments = std::max(3, static_cast<int>(triangles / 2 / (2 * sides)));
    add_torus(buffer, {{0.55, 0.1, 0.0}}, 0.35, 0.08, segments, sides);
}

void add_ground(SceneBuilder& builder, MaterialId material, double half) {
    constexpr int kQuads = 24;
    const double tile = 2.0 * half / kTiles, step = tile / kQuads;
    ShapeBuffer buffer;
    for (int tx = 0; tx < kTiles; ++tx) {
        for (int tz = 0; tz < kTiles; ++tz) {
            buffer.clear();
            for (int x = 0; x <= kQuads; ++x) {
                for (int z = 0; z <= kQuads; ++z) {
                    buffer.add_vertex({tx * tile + x * step - half, 0.0, tz * tile + z * step - half},
                                      {0, 1, 0});
                    if (x == kQuads || z == kQuads) continue;
                    const auto a = static_cast<std::uint32_t>(x * (kQuads + 1) + z);
                    buffer.add_quad(a, a + 1, a + kQuads + 2, a + kQuads + 1);
                }
            }
            builder.add_static(material, buffer.piece());
        }
    }
}

void add_flyers(SceneBuilder& builder, SceneRandom& random, std::int64_t objects,
                std::span<const std::optional<MeshId>> meshes) {
    const double half = half_edge(objects);
    const auto row = static_cast<std::int64_t>(std::ceil(std::cbrt(static_cast<double>(objects))));
    for (std::int64_t i = 0; i < objects; ++i) {
        const Vec cell(static_cast<double>(i % row), static_cast<double>(i / row % row),
                       static_cast<double>(i / (row * row)));
        const Vec home = kRoom * cell + Vec(0.5 * kRoom - half, 0.5 * kRoom + 1.0, 0.5 * kRoom - half);
        const double size = random.between(0.5, 1.0);
        // Every other one is mirrored.
        const double handed = i % 2 == 0 ? size : -size;
        const Frame frame = turned_frame(home, random.unit());
        LoopShape shape;
        shape.radius_x = random.between(0.2, 0.6);
        shape.radius_z = random.between(0.2, 0.6);
        shape.speed = random.between(0.5, 3.0);
        shape.keys = 10;
        const double climb = random.between(-0.4, 0.4);
        builder.add_dynamic(*meshes[static_cast<std::size_t>(i) % meshes.size()],
                            {glm::dvec4(handed * frame.x, 0.0), glm::dvec4(size * frame.y, 0.0),
                             glm::dvec4(size * frame.z, 0.0), glm::dvec4(frame.origin, 1.0)},
                            make_loop(random, shape, [&](double x, double) { return climb * x; }));
    }
}

/// Round the swarm, all of it in view all the time.
CameraPath walk_round_swarm(double half) {
    CameraPath path;
    path.fov_y_deg = 60.0;
    path.near_m = 0.1;
    const Vec middle(0.0, half + 1.0, 0.0);
    // The swarm's sphere and the lens give the distance; some more for what flies beyond the cube.
    const double away = 2.2 * std::sqrt(3.0) * (half + kRoom);
    path.far_m = 8.0 * away;
    for (int i = 0; i <= 12; ++i) {
        const CosSin turn = cos_sin_of_turns(static_cast<double>(i) / 16.0);
        const Vec eye = middle + Vec(away * turn.cos, 0.25 * away, away * turn.sin);
        add_key(path, 2.5, eye, middle - eye);
    }
    return path;
}

Result<SceneAndPath> build_swarm(ParameterValues values, const std::string& name) {
    SceneBuilder builder;
    SceneRandom random(static_cast<std::uint64_t>(values[2]));
    const MaterialId grass = builder.add_material({"grass", {0.16f, 0.32f, 0.09f}});
    const std::array<MaterialId, kKinds> shells{builder.add_material({"amber", {0.70f, 0.42f, 0.08f}}),
                                                builder.add_material({"ruby", {0.55f, 0.05f, 0.10f}}),
                                                builder.add_material({"jet", {0.08f, 0.09f, 0.12f}})};
    ShapeBuffer buffer;
    add_flyer(buffer, values[1]);
    std::array<std::optional<MeshId>, kKinds> meshes;
    for (std::size_t k = 0; k < meshes.size(); ++k) meshes[k] = builder.add_mesh(shells[k], buffer.piece());
    const double half = half_edge(values[0]);
    add_ground(builder, grass, 4.0 * half);
    add_flyers(builder, random, values[0], meshes);
    return with_path(builder.finish(name), walk_round_swarm(half));
}

SceneSize swarm_size(ParameterValues values) {
    constexpr std::uint64_t kStatic = 80'000;
    const std::uint64_t meshes = kKinds * (static_cast<std::uint64_t>(values[1]) * 3 / 2 + 200);
    return {kStatic + meshes, kStatic + meshes, sizeof(glm::vec3) + sizeof(PackedNormal),
            static_cast<std::uint64_t>(values[0]) * 1024};
}

constexpr std::array<SceneParameter, 3> kParameters{{
    {"objects", 1000, 1, 200000, "flyers, every other one mirrored"},
    {"mesh", 2000, 60, 1000000, "triangles of a flyer, about"},
    {"seed", 1, 0, kLargestSeed, "another swarm"},
}};

}  // namespace

const SceneRecipe& swarm_recipe() {
    static const SceneRecipe recipe{
        {"swarm", "flyers over a meadow, all in view and moving: nothing to cull, much to draw",
         "73,728 triangles in 64 objects, and 1,000 dynamic objects of 1,936 triangles", kParameters},
        swarm_size,
        build_swarm};
    return recipe;
}

}  // namespace rhview
