// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <array>
#include <limits>
#include <vector>

#include "random.h"
#include "scene_recipe.h"
#include "shapes.h"

namespace rhview {
namespace {

using Vec = glm::dvec3;

constexpr double kRoom = 10.0;  ///< most of it lies within this distance of the middle, on each axis
constexpr double kHuge = 1e6, kFarAway = 1e7, kTiny = 1e-6;
constexpr int kSpoilt = 7;  ///< triangles that are not finite
constexpr int kKinds = 8;

Vec random_vector(SceneRandom& random, double size) {
    const double x = random.between(-size, size), y = random.between(-size, size);
    return {x, y, random.between(-size, size)};
}

/// A triangle that may be seen from either side.
void add_loose(ShapeBuffer& buffer, const std::array<Vec, 3>& corners) {
    const Vec cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double length = glm::length(cross);
    const Vec normal = length > 0.0 ? cross / length : Vec(0, 1, 0);
    const std::uint32_t a = buffer.add_vertex(corners[0], normal);
    const std::uint32_t b = buffer.add_vertex(corners[1], normal);
    buffer.add_triangle(a, b, buffer.add_vertex(corners[2], normal));
}

std::array<Vec, 3> random_triangle(SceneRandom& random, const Vec& around, double size) {
    const Vec a = around + random_vector(random, size), b = around + random_vector(random, size);
    return {a, b, around + random_vector(random, size)};
}

/// Three corners on one line, or all in one place.
std::array<Vec, 3> degenerate(SceneRandom& random) {
    const Vec a = random_vector(random, kRoom);
    if (random.chance(0.5)) return {a, a, a};
    const Vec step(random.whole(-3, 3), 0.5, 1.0);
    return {a, a + step, a + 2.0 * step};
}

/// Metres long and a hundred thousandth as wide.
std::array<Vec, 3> sliver(SceneRandom& random) {
    const Vec a = random_vector(random, kRoom), along = random_vector(random, 5.0);
    return {a, a + along, a + 0.5 * along + random_vector(random, 1e-5)};
}

/// In one of a few planes, the same ones again and again.
std::array<Vec, 3> coplanar(SceneRandom& random) {
    std::array<Vec, 3> corners = random_triangle(random, Vec(0.0), kRoom);
    const int axis = random.below(3);
    const double level = random.whole(-2, 2) * 4.0;
    for (Vec& corner : corners) corner[axis] = level;
    return corners;
}

std::array<Vec, 3> triangle_of_kind(SceneRandom& random, int kind) {
    switch (kind) {
        case 0:
            return degenerate(random);
        case 1:
            return sliver(random);
        case 2:
            return coplanar(random);
        case 3:
            return random_triangle(random, random_vector(random, kRoom), kTiny);
        case 4:  // huge ones are rare: they hide the rest
            return random_triangle(random, Vec(0.0), random.chance(0.01) ? kHuge : 2.0);
        case 5:
            return random_triangle(random, random_vector(random, kFarAway), 1000.0);
        default:
            return random_triangle(random, random_vector(random, kRoom), 0.5);
    }
}

/// Adds a triangle, and now and then the same one again, or its back.
void add_with_duplicates(ShapeBuffer& buffer, SceneRandom& random, const std::array<Vec, 3>& corners,
                         std::int64_t& left) {
    add_loose(buffer, corners);
    --left;
    if (left <= 0 || !random.chance(0.15)) return;
    add_loose(buffer, random.chance(0.5) ? corners : std::array<Vec, 3>{corners[0], corners[2], corners[1]});
    --left;
}

void add_spoilt(ShapeBuffer& buffer, SceneRandom& random) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kSpoilt; ++i) {
        std::array<Vec, 3> corners = random_triangle(random, Vec(0.0), kRoom);
        corners[static_cast<std::size_t>(i % 3)][i % 2] =
            i % 3 == 0 ? std::numeric_limits<double>::quiet_NaN() : (i % 2 == 0 ? kInfinity : -kInfinity);
        add_loose(buffer, corners);
    }
}

glm::dmat4 placed(const Vec& x, const Vec& y, const Vec& z, const Vec& at) {
    return {glm::dvec4(x, 0.0), glm::dvec4(y, 0.0), glm::dvec4(z, 0.0), glm::dvec4(at, 1.0)};
}

/// Movers that are mirrored, flattened, sheared, tiny and far away.
void add_movers(SceneBuilder& builder, MaterialId material) {
    ShapeBuffer buffer;
    add_cylinder(buffer, {}, 0.6, 0.0, 1.5, 12);
    add_torus(buffer, {{0.0, 0.3, 0.0}}, 0.8, 0.2, 16, 8);
    const std::optional<MeshId> mesh = builder.add_mesh(material, buffer.piece());
    if (!mesh) return;
    const Vec x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    builder.add_dynamic(*mesh, placed(x, y, z, {3, 0, 3}));
    builder.add_dynamic(*mesh, placed(-x, y, z, {-3, 0, 3}));
    builder.add_dynamic(*mesh, placed(2.0 * x, -0.25 * y, 3.0 * z, {3, 1, -3}));
    builder.add_dynamic(*mesh, placed(x, y + 0.7 * x, z - 0.4 * y, {-3, 1, -3}));
    builder.add_dynamic(*mesh, placed(x, 1e-7 * y, z, {0, 4, 0}));
    builder.add_dynamic(*mesh, placed(kTiny * x, kTiny * y, kTiny * z, {0, 2, 0}));
    builder.add_dynamic(*mesh, placed(1e5 * x, 1e5 * y, 1e5 * z, {kFarAway, 0, 0}));
}

CameraPath walk_through_soup() {
    CameraPath path;
    path.near_m = 0.01;
    path.far_m = 1e8;
    const auto look_at = [&](const Vec& eye, const Vec& target) { add_key(path, 6, eye, target - eye); };
    look_at({0, 0.5, 9}, {0, 0.5, 0});
    look_at({1, 0.5, -1}, {4, 1, -6});
    // In the planes that hold coplanar triangles, and along the needle.
    look_at({-9, 4, -9}, {9, 4, 9});
    look_at({-12, 0, 8}, {12, 0, 8});
    look_at({-30, 1e-3, 1e-3}, {0, 0, 0});
    look_at({60, 40, 60}, {0, 0, 0});
    look_at({3e4, 2e4, 3e4}, {0, 0, 0});
    look_at({-2e7, 1e7, 2e7}, {0, 0, 0});
    look_at({1.001e7, 50, 10}, {kFarAway, 0, 0});
    return path;
}

Result<SceneAndPath> build_soup(ParameterValues values, const std::string& name) {
    SceneRandom random(static_cast<std::uint64_t>(values[1]));
    SceneBuilder builder;
    const std::array<MaterialId, 4> materials{
        builder.add_material({"plain", {0.6f, 0.3f, 0.2f}}),
        builder.add_material({"other", {0.2f, 0.4f, 0.6f}}),
        builder.add_material({"two-sided", {0.3f, 0.6f, 0.2f}, true, false}),
        builder.add_material({"alpha-tested", {0.6f, 0.6f, 0.2f}, true, true})};
    ShapeBuffer buffer;
    // A needle through everything comes first, what is not finite last: neither counts as one of the rest.
    add_loose(buffer, {Vec(-kHuge, 0, 0), Vec(kHuge, 1e-3, 0), Vec(kHuge, 0, 1e-3)});
    builder.add_static(materials[0], buffer.piece());
    std::int64_t left = values[0] - 1;
    for (int object = 0; left > 0; ++object) {
        buffer.clear();
        const int kind = object % kKinds;
        for (int i = random.whole(1, 40); i > 0 && left > 0; --i)
            add_with_duplicates(buffer, random, triangle_of_kind(random, kind), left);
        builder.add_static(materials[static_cast<std::size_t>(random.below(4))], buffer.piece());
    }
    buffer.clear();
    add_spoilt(buffer, random);
    builder.add_static(materials[0], buffer.piece());
    add_movers(builder, materials[1]);
    return with_path(builder.finish(name), walk_through_soup());
}

SceneSize soup_size(ParameterValues values) {
    const auto triangles = static_cast<std::uint64_t>(values[0]) + 1000;
    return {triangles, 3 * triangles, sizeof(glm::vec3) + sizeof(PackedNormal), 0};
}

constexpr std::array<SceneParameter, 2> kParameters{{
    {"triangles", 20000, 1000, 10000000, "static triangles, exactly"},
    {"seed", 1, 0, kLargestSeed, "another mess"},
}};

}  // namespace

const SceneRecipe& soup_recipe() {
    static const SceneRecipe recipe{
        {"soup",
         "hard input: degenerate, duplicate, tiny, huge, far, coplanar and non-finite triangles, odd "
         "transforms",
         "20,000 triangles in 848 objects, and 7 dynamic objects of 280 triangles", kParameters},
        soup_size,
        build_soup};
    return recipe;
}

}  // namespace rhview
