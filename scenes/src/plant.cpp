// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "plant_parts.h"
#include "scene_recipe.h"

namespace rhview {
namespace {

constexpr std::int64_t kObjectsPerBay = 250;

/// Bays in a square grid on several decks.
struct PlantPlan {
    int decks = 1;
    int bays = 1;  ///< along each side
    std::int64_t objects = 0;

    [[nodiscard]] std::int64_t bay_count() const { return std::int64_t{decks} * bays * bays; }
};

PlantPlan plan_plant(std::int64_t objects) {
    PlantPlan plan;
    plan.objects = objects;
    plan.decks = static_cast<int>(std::clamp<std::int64_t>(objects / 2000, 1, 5));
    while ((plan.bays + 1) * (plan.bays + 1) * plan.decks * kObjectsPerBay <= objects) ++plan.bays;
    return plan;
}

CameraPath walk_through_plant(const PlantPlan& plan) {
    CameraPath path;
    const double side = plan.bays * kBayPitch, half = 0.5 * side, tall = plan.decks * kDeckHeight;
    path.near_m = 0.1;
    path.far_m = 4.0 * side + 200.0;
    // Walkway k runs along x on the low side of bay row k and is free of pipes below head height.
    const auto walkway = [&](int k) { return k * kBayPitch - half + 0.5 * kWalkway; };
    const int low = plan.bays / 3, high = 2 * plan.bays / 3, upper = plan.decks / 2;
    const double eye = 1.7, eye_above = upper * kDeckHeight + eye;
    add_key(path, 0, {-half - 4.0, eye, walkway(low)}, {1, 0, 0.05});
    add_key(path, 10, {-0.3 * half, eye, walkway(low)}, {1, 0.05, 0.3});
    add_key(path, 4, {-0.2 * half, eye, walkway(low)}, {0.4, 0.2, 1});
    add_key(path, 10, {half - 2.0, eye, walkway(low)}, {0.3, 0, 1});
    add_key(path, 2, {half + 4.0, eye, walkway(low)}, {-0.4, 0.1, 1});
    // Round the outside and up to a higher deck,
    add_key(path, 6, {half + 8.0, eye_above, 0.5 * (walkway(low) + walkway(high))}, {-1, 0.1, 0.4});
    add_key(path, 4, {half + 4.0, eye_above, walkway(high)}, {-1, 0, 0.05});
    add_key(path, 12, {0.0, eye_above, walkway(high)}, {-1, 0.05, -0.3});
    add_key(path, 10, {2.0 - half, eye_above, walkway(high)}, {-0.3, 0, -1});
    add_key(path, 2, {-half - 4.0, eye_above, walkway(high)}, {0.4, 0, -1});
    // out along the side, and an overview.
    add_key(path, 6, {-half - 15.0, 0.6 * tall, 0.6 * half}, {1, -0.1, -0.4});
    add_key(path, 8, {-half - 10.0, 0.7 * tall, -half - 15.0}, {1, -0.1, 0.7});
    add_key(path, 8, {half + 20.0, tall + 15.0, -half - 25.0}, {-1, -0.35, 1});
    add_key(path, 8, {1.4 * half + 20.0, tall + 0.7 * half, 1.4 * half}, {-1, -0.6, -1});
    return path;
}

Result<SceneAndPath> build_plant(ParameterValues values, const std::string& name) {
    const PlantPlan plan = plan_plant(values[0]);
    const auto seed = static_cast<std::uint64_t>(values[1]);
    const auto sides = static_cast<int>(values[2]);
    SceneBuilder builder;
    PlantWriter writer(builder, sides, plan.objects);
    const double half = 0.5 * plan.bays * kBayPitch;
    std::int64_t bay = 0;
    for (int deck = 0; deck < plan.decks; ++deck) {
        for (int i = 0; i < plan.bays; ++i) {
            for (int j = 0; j < plan.bays; ++j, ++bay) {
                // The objects are shared out so that the plant has exactly as many as were asked for.
                writer.set_quota(plan.objects * (bay + 1) / plan.bay_count());
                SceneRandom random(hash_of_cell(seed, i, deck, j));
                const BayPlace place{{i * kBayPitch - half, deck * kDeckHeight, j * kBayPitch - half},
                                     deck + 1 == plan.decks,
                                     i + 1 == plan.bays,
                                     j + 1 == plan.bays};
                add_bay(writer, random, place);
            }
        }
    }
    return with_path(builder.finish(name), walk_through_plant(plan));
}

SceneSize plant_size(ParameterValues values) {
    // Measured means are 40 to 50 triangles an object at 8 sides, 6 of them per side.
    const std::uint64_t triangles =
        static_cast<std::uint64_t>(values[0]) * (10 + 6 * static_cast<std::uint64_t>(values[2]));
    return {triangles, triangles, sizeof(glm::vec3) + sizeof(PackedNormal), 0};
}

constexpr std::array<SceneParameter, 3> kParameters{{
    {"objects", 200000, 100, 1000000, "static objects, exactly"},
    {"seed", 1, 0, kLargestSeed, "another plant"},
    {"sides", 8, 3, 64, "sides of a pipe"},
}};

}  // namespace

const SceneRecipe& plant_recipe() {
    static const SceneRecipe recipe{
        {"plant", "an oil platform of pipes, tanks and beams on several decks: very many small objects",
         "9,961,396 triangles in 200,000 objects", kParameters},
        plant_size,
        build_plant};
    return recipe;
}

}  // namespace rhview
