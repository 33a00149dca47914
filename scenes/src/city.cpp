// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <array>
#include <vector>

#include "random.h"
#include "scene_recipe.h"
#include "shapes.h"

namespace rhview {
namespace {

constexpr double kPitch = 20.0;
constexpr double kBuilding = 14.0;
constexpr int kToriPerBlock = 12;
constexpr int kRingSegments = 32, kTubeSegments = 20;
constexpr double kRing = 0.6, kTube = 0.25;
constexpr std::uint64_t kTorusTriangles = 2 * kRingSegments * kTubeSegments;
constexpr std::uint64_t kTorusVertices = kRingSegments * kTubeSegments;
constexpr std::uint64_t kBlockTriangles = 12 + kToriPerBlock * kTorusTriangles;
constexpr std::uint64_t kBlockVertices = 24 + kToriPerBlock * kTorusVertices;
constexpr std::int64_t kMaterialsOfEach = 4;

std::array<MaterialId, 2 * kMaterialsOfEach> add_materials(SceneBuilder& builder) {
    return {builder.add_material({"concrete", {0.55f, 0.54f, 0.51f}}),
            builder.add_material({"brick", {0.42f, 0.16f, 0.11f}}),
            builder.add_material({"sandstone", {0.62f, 0.52f, 0.34f}}),
            builder.add_material({"blue glass", {0.12f, 0.22f, 0.34f}}),
            builder.add_material({"red enamel", {0.60f, 0.06f, 0.05f}}),
            builder.add_material({"brass", {0.60f, 0.42f, 0.12f}}),
            builder.add_material({"green enamel", {0.06f, 0.40f, 0.16f}}),
            builder.add_material({"white enamel", {0.80f, 0.80f, 0.78f}})};
}

/// Three along each side of the building, between its wall and the middle of the street, which stays free.
Frame torus_frame(SceneRandom& random, const glm::dvec3& centre, int torus) {
    const double along = (torus % 3 - 1) * 5.0 + random.between(-0.5, 0.5);
    const double across = 0.5 * kPitch - 1.6;
    const CosSin side = cos_sin_of_turns(0.25 * (torus / 3));
    const glm::dvec3 outwards(side.cos, 0.0, side.sin), sideways(-side.sin, 0.0, side.cos);
    glm::dvec3 place = centre + across * outwards + along * sideways;
    // Most stand on their rim, some lie flat.
    if (random.chance(0.25)) {
        place.y = kTube;
        return turned_frame(place, random.unit());
    }
    place.y = kRing + kTube;
    const CosSin turn = cos_sin_of_turns(random.unit());
    const glm::dvec3 axis(turn.cos, 0.0, turn.sin);
    return {place, {-turn.sin, 0.0, turn.cos}, axis, {0.0, 1.0, 0.0}};
}

CameraPath walk_through_city(int blocks) {
    CameraPath path;
    const double half = 0.5 * kPitch * blocks, eye = 1.7;
    path.near_m = 0.1;
    path.far_m = 2.0 * kPitch * blocks + 200.0;
    // Street k runs along the low side of block k; its middle is free.
    const auto street = [&](int k) { return k * kPitch - half; };
    const int first = blocks / 2, second = blocks / 4, third = blocks - blocks / 4;
    add_key(path, 0, {street(first), eye, street(0) - 5.0}, {0, 0, 1});
    add_key(path, 15, {street(first), eye, street(third)}, {0.1, 0, 1});
    add_key(path, 2, {street(first) + 0.4, eye, street(third)}, {1, 0, 0});
    add_key(path, 10, {street(blocks), eye, street(third)}, {1, 0, 0.1});
    add_key(path, 2, {street(blocks), eye, street(third) - 0.4}, {-0.3, 0, -1});
    add_key(path, 10, {street(blocks), eye, street(second)}, {-0.1, 0, -1});
    add_key(path, 2, {street(blocks) - 0.4, eye, street(second)}, {-1, 0, 0});
    add_key(path, 15, {street(0), eye, street(second)}, {-1, 0.1, 0});
    // Up at the corner, over the roofs, and away.
    add_key(path, 2, {street(0), eye, street(second) + 0.4}, {0.5, 0.1, 1});
    add_key(path, 5, {street(0), 55.0, street(second) + 0.4}, {1, -0.4, 0.6});
    add_key(path, 10, {street(third), 50.0, street(blocks)}, {0.3, -0.4, -1});
    add_key(path, 8, {1.2 * half, 0.5 * half + 60.0, 1.2 * half}, {-1, -0.6, -1});
    return path;
}

Result<SceneAndPath> build_city(ParameterValues values, const std::string& name) {
    const auto blocks = static_cast<int>(values[0]);
    SceneRandom random(static_cast<std::uint64_t>(values[1]));
    SceneBuilder builder;
    const auto materials = add_materials(builder);
    const auto cells = static_cast<std::uint64_t>(values[0] * values[0]);
    builder.reserve(materials[0], true, false, cells * kBlockVertices, 0);
    // Each torus material gets a quarter of them, give or take.
    for (std::size_t i = kMaterialsOfEach; i < materials.size(); ++i)
        builder.reserve(materials[i], true, false, 0,
                        cells * kToriPerBlock * 3 * kTorusTriangles / 4 * 21 / 20);
    ShapeBuffer buffer;
    for (int x = 0; x < blocks; ++x) {
        for (int z = 0; z < blocks; ++z) {
            const glm::dvec3 centre(kPitch * (x + 0.5 - 0.5 * blocks), 0.0,
                                    kPitch * (z + 0.5 - 0.5 * blocks));
            const double half = 0.5 * kBuilding;
            buffer.clear();
            add_box(buffer, {centre}, {-half, 0.0, -half}, {half, random.between(10.0, 40.0), half});
            builder.add_static(materials[static_cast<std::size_t>(random.below(kMaterialsOfEach))],
                               buffer.piece());
            for (int torus = 0; torus < kToriPerBlock; ++torus) {
                buffer.clear();
                add_torus(buffer, torus_frame(random, centre, torus), kRing, kTube, kRingSegments,
                          kTubeSegments);
                const auto material =
                    static_cast<std::size_t>(kMaterialsOfEach + random.below(kMaterialsOfEach));
                builder.add_static(materials[material], buffer.piece());
            }
        }
    }
    return with_path(builder.finish(name), walk_through_city(blocks));
}

SceneSize city_size(ParameterValues values) {
    const auto cells = static_cast<std::uint64_t>(values[0] * values[0]);
    return {cells * kBlockTriangles, cells * kBlockVertices, sizeof(glm::vec3) + sizeof(PackedNormal), 0};
}

constexpr std::array<SceneParameter, 2> kParameters{{
    {"blocks", 16, 1, 64, "blocks along each side, 20 m each"},
    {"seed", 1, 0, kLargestSeed, "other heights and colours"},
}};

}  // namespace

const SceneRecipe& city_recipe() {
    static const SceneRecipe recipe{
        {"city", "box buildings in a grid of streets full of tori, walked at street level: heavy occlusion",
         "3,935,232 triangles in 3,328 objects", kParameters},
        city_size,
        build_city};
    return recipe;
}

}  // namespace rhview
