// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>

#include "farm_beast.h"
#include "loops.h"
#include "random.h"
#include "scene_recipe.h"
#include "shapes.h"

namespace rhview {
namespace {

using Vec = glm::dvec3;

constexpr double kEdge = 640.0;
constexpr int kQuads = 360;  ///< along each side of the terrain
constexpr int kPatch = 20;   ///< quads along each side of a terrain object
constexpr int kFields = 6;   ///< along each side
constexpr double kField = kEdge / kFields;
constexpr double kTrack = 8.0;  ///< tracks run at x = 8 and z = 8, free of everything
constexpr int kTrees = 350, kHaystacks = 120, kBarns = 9, kHerd = 10;
constexpr std::uint64_t kStaticTriangles = 520'000;

enum FarmMaterial : std::size_t {
    Grass,
    Wheat,
    Soil,
    Meadow,
    Bark,
    Leaf,
    Wood,
    RedWood,
    RoofTile,
    Hay,
    Hide,
    Count
};

class Farm {
  public:
    Farm(SceneBuilder& builder, std::uint64_t seed);

    [[nodiscard]] double height(double x, double z) const;
    [[nodiscard]] Vec on_ground(double x, double z, double above = 0.0) const {
        return {x, height(x, z) + above, z};
    }
    void add_terrain();
    void add_fences();
    void add_trees();
    void add_haystacks();
    void add_barns();
    void add_herds(std::int64_t instances, std::int64_t mesh_triangles);

  private:
    /// A place on the farm that is off the tracks by `clearance`.
    Vec place_off_tracks(double clearance);
    void add_barn(const Frame& frame);
    void finish(FarmMaterial material);

    SceneBuilder& builder_;
    std::uint64_t seed_;
    SceneRandom random_;
    ShapeBuffer buffer_;
    std::array<MaterialId, Count> materials_{};
};

Farm::Farm(SceneBuilder& builder, std::uint64_t seed) : builder_(builder), seed_(seed), random_(seed) {
    constexpr std::array<glm::vec3, Count> kColours{{{0.14f, 0.32f, 0.07f},
                                                     {0.58f, 0.46f, 0.14f},
                                                     {0.24f, 0.15f, 0.09f},
                                                     {0.22f, 0.36f, 0.10f},
                                                     {0.17f, 0.11f, 0.06f},
                                                     {0.07f, 0.24f, 0.05f},
                                                     {0.38f, 0.28f, 0.18f},
                                                     {0.44f, 0.08f, 0.06f},
                                                     {0.20f, 0.18f, 0.18f},
                                                     {0.64f, 0.52f, 0.20f},
                                                     {0.36f, 0.24f, 0.16f}}};
    constexpr std::array<const char*, Count> kNames{
        "grass", "wheat", "soil", "meadow", "bark", "leaf", "wood", "red wood", "roof tile", "hay", "hide"};
    for (std::size_t i = 0; i < Count; ++i) materials_[i] = builder.add_material({kNames[i], kColours[i]});
}

double Farm::height(double x, double z) const {
    return 22.0 * value_noise(seed_, x / 150.0, z / 150.0) + 3.0 * value_noise(seed_ + 1, x / 30.0, z / 30.0);
}

void Farm::finish(FarmMaterial material) {
    builder_.add_static(materials_[material], buffer_.piece());
    buffer_.clear();
}

Vec Farm::place_off_tracks(double clearance) {
    double x = 0.0, z = 0.0;
    do {
        x = random_.between(-0.49 * kEdge, 0.49 * kEdge);
        z = random_.between(-0.49 * kEdge, 0.49 * kEdge);
    } while (std::abs(x - kTrack) < clearance || std::abs(z - kTrack) < clearance);
    return on_ground(x, z);
}

void Farm::add_terrain() {
    constexpr double kStep = kEdge / kQuads;
    const auto at = [](int i) { return kStep * i - 0.5 * kEdge; };
    for (int px = 0; px < kQuads; px += kPatch) {
        for (int pz = 0; pz < kQuads; pz += kPatch) {
            for (int i = 0; i <= kPatch; ++i) {
                for (int j = 0; j <= kPatch; ++j) {
                    const double x = at(px + i), z = at(pz + j);
                    const double slope_x = height(x + kStep, z) - height(x - kStep, z);
                    const double slope_z = height(x, z + kStep) - height(x, z - kStep);
                    buffer_.add_vertex(on_ground(x, z), glm::normalize(Vec(-slope_x, 2.0 * kStep, -slope_z)));
                    if (i == kPatch || j == kPatch) continue;
                    const auto a = static_cast<std::uint32_t>(i * (kPatch + 1) + j);
                    buffer_.add_quad(a, a + 1, a + kPatch + 2, a + kPatch + 1);
                }
            }
            constexpr int kPatches = kQuads / kPatch / kFields;
            const std::uint64_t field =
                hash_of_cell(seed_ + 2, px / kPatch / kPatches, 0, pz / kPatch / kPatches);
            finish(std::array{Grass, Wheat, Soil, Meadow}[field % 4]);
        }
    }
}

void Farm::add_fences() {
    constexpr double kSection = kField / 36.0;  // about 3 m
    constexpr int kSectionsPerObject = 6;
    for (int line = 0; line <= kFields; ++line) {
        for (const bool along_x : {false, true}) {
            for (int section = 0; section < kFields * 36; ++section) {
                const double across = line * kField - 0.5 * kEdge, along = section * kSection - 0.5 * kEdge;
                const auto post_at = [&](double place) {
                    return along_x ? on_ground(place, across) : on_ground(across, place);
                };
                const Vec a = post_at(along), b = post_at(along + kSection);
                const bool gate = std::abs(along + 0.5 * kSection - kTrack) < 5.0;
                if (!gate) {
                    add_box(buffer_, {a}, {-0.06, -0.3, -0.06}, {0.06, 1.2, 0.06});
                    const double length = glm::length(b - a);
                    const Frame rail = frame_along(a, (b - a) / length);
                    for (const double up : {0.5, 1.0})
                        add_box(buffer_, {rail.origin + Vec(0.0, up, 0.0), rail.x, rail.y, rail.z},
                                {-0.03, 0.0, -0.05}, {0.03, length, 0.05});
                }
                if ((section + 1) % kSectionsPerObject == 0) finish(Wood);
            }
        }
    }
}

void Farm::add_trees() {
    for (int i = 0; i < kTrees; ++i) {
        const Frame foot{place_off_tracks(6.0)};
        const double tall = random_.between(2.5, 4.5);
        add_cylinder(buffer_, foot.moved({0.0, -0.3, 0.0}), 0.3, 0.18, tall + 0.6, 8, false);
        finish(Bark);
        for (int blob = 0; blob < 3; ++blob) {
            const CosSin turn = cos_sin_of_turns(random_.unit());
            const double reach = 0.5 * blob, radius = random_.between(1.0, 2.0);
            add_sphere(buffer_, foot.moved({reach * turn.cos, tall + 0.8 * blob, reach * turn.sin}), radius,
                       0.9 * radius, 10, 6);
        }
        finish(Leaf);
    }
}

void Farm::add_haystacks() {
    for (int i = 0; i < kHaystacks; ++i) {
        const Frame foot{place_off_tracks(5.0)};
        const double size = random_.between(0.8, 1.4);
        add_turned(buffer_, foot.moved({0.0, -0.3, 0.0}),
                   {{0.8 * size, 0.0},
                    {1.1 * size, 0.8 * size},
                    {1.0 * size, 1.4 * size},
                    {0.5 * size, 2.0 * size},
                    {0.0, 2.3 * size}},
                   16);
        finish(Hay);
    }
}

void Farm::add_barn(const Frame& frame) {
    constexpr double kHalfX = 6.0, kHalfZ = 10.0, kEaves = 5.0, kRidge = 9.0, kOver = 0.5;
    add_box(buffer_, frame, {-kHalfX, -2.0, -kHalfZ}, {kHalfX, kEaves, kHalfZ});
    // The gables, level with the end walls.
    for (const double side : {-1.0, 1.0}) {
        const Vec normal = frame.direction({0.0, 0.0, side});
        const auto a = buffer_.add_vertex(frame.point({-side * kHalfX, kEaves, side * kHalfZ}), normal);
        buffer_.add_vertex(frame.point({side * kHalfX, kEaves, side * kHalfZ}), normal);
        buffer_.add_vertex(frame.point({0.0, kRidge, side * kHalfZ}), normal);
        buffer_.add_triangle(a, a + 1, a + 2);
    }
    finish(RedWood);
    const double run = kHalfX + kOver, rise = (kRidge - kEaves) * run / kHalfX;
    const double slope = std::sqrt(run * run + rise * rise);
    for (const double side : {-1.0, 1.0}) {
        const Vec down = frame.direction({side * run / slope, -rise / slope, 0.0});
        const Vec along = frame.direction({0.0, 0.0, -side});
        const Frame roof{frame.point({0.0, kRidge, 0.0}), down, glm::cross(along, down), along};
        add_box(buffer_, roof, {0.0, 0.0, -kHalfZ - kOver}, {slope, 0.2, kHalfZ + kOver});
    }
    finish(RoofTile);
    add_turned(buffer_, frame.moved({kHalfX + 4.0, -1.0, kHalfZ - 4.0}),
               {{2.5, 0.0}, {2.5, 11.0}, {2.3, 12.0}, {1.4, 13.0}, {0.0, 13.4}}, 24);
    finish(RoofTile);
}

void Farm::add_barns() {
    for (int i = 0; i < kBarns; ++i) {
        const Vec place = place_off_tracks(22.0);
        add_barn(turned_frame(place, 0.25 * random_.below(4)));
    }
}

void Farm::add_herds(std::int64_t instances, std::int64_t mesh_triangles) {
    const std::optional<MeshId> mesh =
        builder_.add_mesh(materials_[Hide], make_beast(mesh_triangles).piece());
    if (!mesh) return;
    Vec herd(0.0);
    SceneRandom ways(seed_ + 3);
    for (std::int64_t i = 0; i < instances; ++i) {
        if (i % kHerd == 0) herd = place_off_tracks(22.0);
        // Every other herd grazes beside a track.
        if (i % (2 * kHerd) == 0) herd.x = kTrack + (herd.x > 0.0 ? 24.0 : -24.0);
        // A sunflower's spiral keeps them apart.
        const double rank = static_cast<double>(i % kHerd);
        const CosSin turn = cos_sin_of_turns(0.381966 * rank);
        const double away = 5.2 * std::sqrt(rank + 0.5), scale = random_.between(0.7, 1.1);
        const double x = herd.x + away * turn.cos, z = herd.z + away * turn.sin;
        const Frame frame = turned_frame(on_ground(x, z, scale * kBeastFoot), random_.unit());
        // It grazes in a round that leaves the tracks free.
        const double radius = ways.between(1.0, 2.0), speed = ways.between(0.4, 1.0);
        const auto rise = [&](double dx, double dz) { return height(x + dx, z + dz) - height(x, z); };
        builder_.add_dynamic(*mesh,
                             {glm::dvec4(scale * frame.x, 0.0), glm::dvec4(scale * frame.y, 0.0),
                              glm::dvec4(scale * frame.z, 0.0), glm::dvec4(frame.origin, 1.0)},
                             make_loop(ways, {radius, radius, speed, 12, true}, rise));
    }
}

CameraPath walk_through_farm(const Farm& farm) {
    CameraPath path;
    path.fov_y_deg = 45.0;
    path.near_m = 0.1;
    path.far_m = 2.0 * kEdge;
    // Along the tracks, in steps that follow the ground.
    constexpr double kStride = 10.0;
    for (double x = 150.0; x > kTrack; x -= kStride)
        add_key(path, 1.5, farm.on_ground(x, kTrack, 2.2),
                {-1, -0.05, 0.8 * value_noise(1, x / 40.0, 0.0) - 0.6});
    for (double z = kTrack - 2.0; z >= -270.0; z -= kStride)
        add_key(path, 1.5, farm.on_ground(kTrack, z, 2.2),
                {1.4 * value_noise(2, z / 40.0, 0.0) - 0.7, -0.05, -1});
    add_key(path, 4, farm.on_ground(60.0, -280.0, 15.0), {1, -0.25, 0.1});
    add_key(path, 6, farm.on_ground(250.0, -200.0, 25.0), {0.1, -0.4, 1});
    add_key(path, 8, farm.on_ground(220.0, 220.0, 35.0), {-1, -0.5, 0.1});
    add_key(path, 6, {-0.5 * kEdge, 130.0, 0.5 * kEdge}, {1, -0.5, -1});
    return path;
}

Result<SceneAndPath> build_farm(ParameterValues values, const std::string& name) {
    SceneBuilder builder;
    Farm farm(builder, static_cast<std::uint64_t>(values[2]));
    builder.reserve(MaterialId{}, true, false, kStaticTriangles + static_cast<std::size_t>(values[1]) / 2, 0);
    farm.add_terrain();
    farm.add_fences();
    farm.add_trees();
    farm.add_haystacks();
    farm.add_barns();
    farm.add_herds(values[0], values[1]);
    return with_path(builder.finish(name), walk_through_farm(farm));
}

SceneSize farm_size(ParameterValues values) {
    const auto mesh = static_cast<std::uint64_t>(values[1]) * 101 / 100;
    const auto instances = static_cast<std::uint64_t>(values[0]);
    // The body is computed in double before it is stored.
    return {kStaticTriangles + mesh, kStaticTriangles + mesh / 2, sizeof(glm::vec3) + sizeof(PackedNormal),
            mesh / 2 * 60 + mesh * 12 + instances * 2048};
}

constexpr std::array<SceneParameter, 3> kParameters{{
    {"instances", 310, 1, 100000, "placed beasts, all of one mesh"},
    {"mesh", 870000, 1000, 20000000, "triangles of the mesh, within 1 %"},
    {"seed", 1, 0, kLargestSeed, "another farm"},
}};

}  // namespace

const SceneRecipe& farm_recipe() {
    static const SceneRecipe recipe{
        {"farm",
         "open fields with barns and trees, and moving herds of one very detailed mesh: work for levels of "
         "detail",
         "492,446 triangles in 1,675 objects, and 310 dynamic objects of 870,000 triangles", kParameters},
        farm_size,
        build_farm};
    return recipe;
}

}  // namespace rhview
