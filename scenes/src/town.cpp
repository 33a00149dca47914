// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>

#include "scene_recipe.h"
#include "town_buildings.h"

namespace rhview {
namespace {

constexpr int kBlockPitch = 24;  ///< from street to street
constexpr int kStreet = 5;       ///< width of a street, on the low side of its block
constexpr int kLot = kBlockPitch - kStreet;
constexpr int kSea = 8;       ///< first cube above the water
constexpr int kGround = 11;   ///< first cube above the streets
constexpr int kWallBand = 9;  ///< level ground round the town, for its wall

/// The town's rectangle [low, high) in whole blocks plus the street that closes it; empty on small maps.
struct TownPlan {
    int size = 0;
    std::uint64_t seed = 0;
    int low_x = 0, low_z = 0, high_x = 0, high_z = 0;

    [[nodiscard]] bool has_town() const { return low_x < high_x && low_z < high_z; }
    [[nodiscard]] int blocks_x() const { return has_town() ? (high_x - low_x) / kBlockPitch : 0; }
    [[nodiscard]] int blocks_z() const { return has_town() ? (high_z - low_z) / kBlockPitch : 0; }
};

TownPlan plan_town(int size, std::uint64_t seed) {
    const auto up = [](int v) { return (v + kBlockPitch - 1) / kBlockPitch * kBlockPitch; };
    TownPlan plan{size, seed, up(size / 10), up(size / 6), 0, 0};
    plan.high_x = (size - size / 10 - plan.low_x) / kBlockPitch * kBlockPitch + plan.low_x + kStreet;
    plan.high_z = (size - size / 10 - plan.low_z) / kBlockPitch * kBlockPitch + plan.low_z + kStreet;
    if (plan.high_x - plan.low_x < kBlockPitch || plan.high_z - plan.low_z < kBlockPitch)
        plan.low_x = plan.high_x = plan.low_z = plan.high_z = size / 2;
    return plan;
}

/// In [0, 1), smooth over `cell` columns.
double noise(std::uint64_t seed, int x, int z, int cell) {
    return value_noise(seed, static_cast<double>(x) / cell, static_cast<double>(z) / cell);
}

int outside_by(int v, int low, int high) {
    return std::max({low - v, v - high + 1, 0});
}

/// Columns with z below this are sea: a straight quay before the town, a wavy beach beside it.
int shore(const TownPlan& plan, int x) {
    const int beside = outside_by(x, plan.low_x - kWallBand, plan.high_x + kWallBand);
    const int quay = std::max(plan.low_z - kWallBand, 0);
    if (beside == 0) return plan.has_town() ? quay : plan.size / 8;
    const double retreat = std::min(1.0, beside / (0.08 * plan.size));
    return static_cast<int>(quay * (1.0 - 0.6 * retreat) + 14.0 * (noise(plan.seed + 1, x, 0, 24) - 0.5));
}

/// Height of the first empty cube above land or sea bed.
int ground_height(const TownPlan& plan, int x, int z) {
    const int sea_edge = shore(plan, x);
    if (z < sea_edge) return std::max(2, kSea - 2 - (sea_edge - z) / 6);
    const int dx = outside_by(x, plan.low_x - kWallBand, plan.high_x + kWallBand);
    const int dz = outside_by(z, plan.low_z - kWallBand, plan.high_z + kWallBand);
    const double away = std::min(1.0, std::max(dx, dz) / (0.09 * plan.size));
    const double inland = std::min(1.0, (z - sea_edge) / 30.0);
    const double relief = 0.6 * noise(plan.seed + 2, x, z, 48) + 0.3 * noise(plan.seed + 3, x, z, 17) +
                          0.25 * noise(plan.seed + 4, x, z, 6);
    const double beach = dx == 0 ? 0.0 : (1.0 - inland) * 2.0;
    return kGround - static_cast<int>(beach) + static_cast<int>(inland * away * (6.0 + 34.0 * relief));
}

void fill_terrain(VoxelGrid& grid, const TownPlan& plan) {
    for (int x = 0; x < plan.size; ++x) {
        for (int z = 0; z < plan.size; ++z) {
            const int height = ground_height(plan, x, z);
            const bool town = outside_by(x, plan.low_x, plan.high_x) == 0 &&
                              outside_by(z, plan.low_z - kWallBand, plan.high_z) == 0 && plan.has_town();
            const bool field = noise(plan.seed + 5, x, z, 40) > 0.62;
            const Block top = town                         ? Block::Cobble
                              : height <= kSea + 1         ? Block::Sand
                              : height > 38                ? Block::Stone
                              : field && height <= kGround ? Block::Crops
                                                           : Block::Grass;
            grid.fill({x, 0, z}, {x + 1, height - 3, z + 1}, Block::Stone);
            grid.fill({x, height - 3, z}, {x + 1, height - 1, z + 1}, town ? Block::Stone : Block::Dirt);
            grid.set({x, height - 1, z}, top);
            grid.fill({x, height, z}, {x + 1, kSea, z + 1}, Block::Water);
        }
    }
}

/// Four houses, their gardens between them.
void add_houses(VoxelGrid& grid, SceneRandom& random, int x, int z) {
    const int split_x = random.whole(8, 10), split_z = random.whole(8, 10);
    for (const bool far_x : {false, true}) {
        for (const bool far_z : {false, true}) {
            const int width = far_x ? kLot - split_x - 1 : split_x,
                      depth = far_z ? kLot - split_z - 1 : split_z;
            const Voxel corner{x + (far_x ? split_x + 1 : 0), kGround, z + (far_z ? split_z + 1 : 0)};
            add_building(grid, random_house(random, corner, width, depth, random.whole(2, 4)));
        }
    }
}

void add_rows(VoxelGrid& grid, SceneRandom& random, int x, int z) {
    for (int row = 0; row < 2; ++row)
        for (int i = 0; i < 3; ++i)
            add_building(grid, random_house(random, {x + row * 10, kGround, z + i * 6 + (i > 0 ? 1 : 0)}, 9,
                                            i == 0 ? 7 : 6, random.whole(2, 5)));
}

void add_church(VoxelGrid& grid, SceneRandom& random, int x, int z) {
    Building hall{{x + 4, kGround, z + 6}, 11, 13, 3, Block::Sandstone, Block::WallStone, Block::SlateTiles};
    Building tower{{x + 6, kGround, z}, 7, 7, random.whole(6, 8), Block::Sandstone, Block::WallStone,
                   Block::SlateTiles};
    tower.shape = Roof::Pyramid;
    add_building(grid, hall);
    add_building(grid, tower);
    for (const int corner : {0, 17}) {
        add_tree(grid, {x + corner, kGround, z + 17}, random);
        add_tree(grid, {x + corner, kGround, z + 2}, random);
    }
}

void add_keep(VoxelGrid& grid, SceneRandom& random, int x, int z) {
    Building keep{{x + 4, kGround, z + 4}, 11, 11, random.whole(5, 7), Block::WallStone, Block::Stone};
    keep.shape = Roof::Battlement;
    add_building(grid, keep);
    for (const int dx : {0, 13}) {
        for (const int dz : {0, 13}) {
            Building turret{{x + dx, kGround, z + dz}, 6, 6, 4, Block::WallStone, Block::Stone};
            turret.shape = random.chance(0.5) ? Roof::Battlement : Roof::Pyramid;
            add_building(grid, turret);
        }
    }
}

void add_market(VoxelGrid& grid, SceneRandom& random, int x, int z) {
    grid.fill({x, kGround - 1, z}, {x + kLot, kGround, z + kLot}, Block::Plaza);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            if (random.chance(0.8))
                add_stall(grid, {x + 1 + 5 * i, kGround, z + 1 + 5 * j},
                          random.chance(0.5) ? Block::RedTiles : Block::Crops);
}

void add_park(VoxelGrid& grid, SceneRandom& random, int x, int z) {
    grid.fill({x, kGround - 1, z}, {x + kLot, kGround, z + kLot}, Block::Grass);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            add_tree(grid, {x + 2 + 5 * i + random.below(2), kGround, z + 2 + 5 * j + random.below(2)},
                     random);
}

void add_lamps(VoxelGrid& grid, int x, int z) {
    for (int along = 8; along < kBlockPitch; along += 6) {
        for (const bool across : {false, true}) {
            const Voxel foot{across ? x + along : x, kGround, across ? z : z + along};
            grid.fill(foot, {foot.x + 1, foot.y + 3, foot.z + 1}, Block::Timber);
            grid.set({foot.x, foot.y + 3, foot.z}, Block::Lamp);
        }
    }
}

/// A covered passage over the street on the block's low x side.
void add_bridge(VoxelGrid& grid, int x, int z) {
    const int y = kGround + 5;
    grid.fill({x, y, z + 12}, {x + kStreet, y + 4, z + 16}, Block::Brick);
    grid.fill({x, y + 1, z + 13}, {x + kStreet, y + 3, z + 15}, Block::Empty);
    grid.fill({x + 1, y + 1, z + 12}, {x + 4, y + 3, z + 13}, Block::Empty);
}

void add_blocks(VoxelGrid& grid, const TownPlan& plan) {
    for (int i = 0; i < plan.blocks_x(); ++i) {
        for (int j = 0; j < plan.blocks_z(); ++j) {
            const int x = plan.low_x + i * kBlockPitch, z = plan.low_z + j * kBlockPitch;
            SceneRandom random(hash_of_cell(plan.seed, x, 0, z));
            const int kind = random.below(100);
            const auto add = kind < 48   ? add_houses
                             : kind < 66 ? add_rows
                             : kind < 72 ? add_church
                             : kind < 76 ? add_keep
                             : kind < 86 ? add_market
                                         : add_park;
            add(grid, random, x + kStreet, z + kStreet);
            add_lamps(grid, x, z);
            if (i > 0 && kind < 66 && random.chance(0.25)) add_bridge(grid, x, z);
        }
    }
}

/// Round three sides; the sea guards the fourth.
void add_town_wall(VoxelGrid& grid, const TownPlan& plan) {
    constexpr int kThick = 3, kHigh = 9;
    const int low_x = plan.low_x - kThick - 2, high_x = plan.high_x + 2, high_z = plan.high_z + 2;
    const auto add_stretch = [&](Voxel low, Voxel high) {
        grid.fill(low, high, Block::WallStone);
        for (int x = low.x; x < high.x; ++x)
            for (int z = low.z; z < high.z; ++z)
                if ((x + z) % 3 != 0 && (x == low.x || x + 1 == high.x || z == low.z || z + 1 == high.z))
                    grid.set({x, high.y, z}, Block::WallStone);
    };
    for (const int x : {low_x, high_x})
        add_stretch({x, kGround, plan.low_z}, {x + kThick, kGround + kHigh, high_z});
    add_stretch({low_x, kGround, high_z}, {high_x + kThick, kGround + kHigh, high_z + kThick});
    for (int i = 0; i <= plan.blocks_x(); ++i) {
        const int x = plan.low_x + i * kBlockPitch;
        grid.fill({x, kGround, high_z}, {x + kStreet, kGround + 6, high_z + kThick}, Block::Empty);
    }
    for (int j = 0; j <= plan.blocks_z(); j += 3) {
        for (const int x : {low_x - 3, high_x - 1}) {
            Building tower{
                {x, kGround, plan.low_z + j * kBlockPitch - 2}, 7, 7, 4, Block::WallStone, Block::Stone};
            tower.shape = Roof::Pyramid;
            add_building(grid, tower);
        }
    }
}

void add_harbour(VoxelGrid& grid, const TownPlan& plan) {
    const int quay = plan.low_z - kWallBand;
    for (int i = 1; i < plan.blocks_x(); i += 2) {
        const int x = plan.low_x + i * kBlockPitch;
        const int length = std::min(34, quay - 4);
        grid.fill({x, kGround - 1, quay - length}, {x + kStreet, kGround, quay}, Block::Planks);
        for (int z = quay - length; z < quay; z += 4)
            for (const int post : {x, x + kStreet - 1})
                grid.fill({post, 2, z}, {post + 1, kGround + 1, z + 1}, Block::Trunk);
        if (length >= 28) add_ship(grid, {x + kStreet + 2, kSea, quay - 26});
    }
}

void add_woods(VoxelGrid& grid, const TownPlan& plan) {
    constexpr int kCell = 6;
    for (int x = 3; x + kCell < plan.size; x += kCell) {
        for (int z = 3; z + kCell < plan.size; z += kCell) {
            SceneRandom random(hash_of_cell(plan.seed + 6, x, 0, z));
            const int tx = x + random.below(kCell - 2), tz = z + random.below(kCell - 2);
            const bool in_town = outside_by(tx, plan.low_x - kWallBand, plan.high_x + kWallBand) == 0 &&
                                 outside_by(tz, plan.low_z - kWallBand, plan.high_z + kWallBand) == 0;
            const int y = grid.top(tx, tz);
            if ((in_town && plan.has_town()) || y == 0 || grid.at({tx, y - 1, tz}) != Block::Grass) continue;
            if (random.chance(0.2 + 0.6 * noise(plan.seed + 7, tx, tz, 32)))
                add_tree(grid, {tx, y, tz}, random);
        }
    }
}

/// Where there is no town to walk in.
void fly_over_land(CameraPath& path, const TownPlan& plan) {
    const double edge = plan.size;
    add_key(path, 0, {-0.4 * edge, 75.0, -0.5 * edge}, {0.4 * edge, -60.0, 0.5 * edge});
    add_key(path, 10, {0.0, 80.0, 0.6 * edge}, {0.1 * edge, -60.0, -0.6 * edge});
    add_key(path, 10, {0.8 * edge, 120.0, 0.2 * edge}, {-0.8 * edge, -100.0, -0.2 * edge});
}

CameraPath walk_through_town(const TownPlan& plan) {
    CameraPath path;
    path.far_m = 2.0 * plan.size + 200.0;
    path.near_m = 0.1;
    if (!plan.has_town()) {
        fly_over_land(path, plan);
        return path;
    }
    const double half = plan.size / 2, eye = kGround + 1.7;
    // The middle of the street on the low side of block i; the walk keeps to whole streets.
    const auto street_x = [&](int i) { return plan.low_x + i * kBlockPitch + 0.5 * kStreet - half; };
    const auto street_z = [&](int j) { return plan.low_z + j * kBlockPitch + 0.5 * kStreet - half; };
    const int i0 = plan.blocks_x() / 3, i1 = plan.blocks_x() - i0, j1 = plan.blocks_z() / 2;
    const double x0 = street_x(i0), x1 = street_x(i1), x2 = street_x(plan.blocks_x());
    const double z0 = street_z(0), z1 = street_z(j1), z2 = street_z(plan.blocks_z()), quay = z0 - 6.0;
    // Out of the middle of the town to the harbour, along the quay, and back in by another street.
    add_key(path, 0, {x1, eye, z1}, {-1, 0, 0.1});
    add_key(path, 12, {x0, eye, z1}, {-1, 0.05, -0.2});
    add_key(path, 2, {x0, eye, z1 - 1.0}, {-0.1, 0, -1});
    add_key(path, 14, {x0, eye, z0}, {0.2, 0, -1});
    add_key(path, 3, {x0 + 1.0, eye, quay}, {1, 0, -0.6});
    add_key(path, 9, {x1, eye, quay}, {1, 0.05, -0.2});
    add_key(path, 3, {x1, eye, z0}, {0.1, 0, 1});
    add_key(path, 8, {x1, eye, street_z(j1 / 2)}, {0, 0.1, 1});
    // Straight up at a crossing, then over the roofs.
    add_key(path, 5, {x1, kGround + 50.0, street_z(j1 / 2)}, {0.8, -0.8, 0.4});
    add_key(path, 12, {x2, kGround + 46.0, z1}, {-0.3, -0.7, 1});
    add_key(path, 12, {x1, kGround + 55.0, z2}, {-1, -0.6, -0.2});
    add_key(path, 12, {x0, kGround + 44.0, z1}, {-1, -0.5, -0.2});
    const double edge = plan.size, high = std::max(0.28 * edge, 100.0);
    add_key(path, 8, {-0.45 * edge, high, -0.5 * edge}, {0.45 * edge, -high, 0.5 * edge});
    add_key(path, 6, {-0.55 * edge, high, 0.5 * edge}, {0.55 * edge, -high, -0.5 * edge});
    return path;
}

Result<SceneAndPath> build_town(ParameterValues values, const std::string& name) {
    const TownPlan plan = plan_town(static_cast<int>(values[0]), static_cast<std::uint64_t>(values[1]));
    VoxelGrid grid(plan.size);
    fill_terrain(grid, plan);
    if (plan.has_town()) {
        add_blocks(grid, plan);
        add_town_wall(grid, plan);
        add_harbour(grid, plan);
    }
    add_woods(grid, plan);
    SceneBuilder builder;
    std::vector<MaterialId> materials;
    for (std::int64_t i = 0; i < values[2]; ++i)
        materials.push_back(
            builder.add_material({"blocks " + std::to_string(i + 1), glm::vec3(0.5f), false, false}));
    add_voxel_faces(builder, grid, plan.seed, materials);
    return with_path(builder.finish(name), walk_through_town(plan));
}

SceneSize town_size(ParameterValues values) {
    const auto columns = static_cast<std::uint64_t>(values[0] * values[0]);
    // At most 8 faces for each column on the whole map (6.5 by default), and the sides of a small one.
    const std::uint64_t faces = 8 * columns + 400 * static_cast<std::uint64_t>(values[0]);
    return {2 * faces, 4 * faces, sizeof(glm::vec3) + sizeof(PackedColour), columns * VoxelGrid::kHeight};
}

constexpr std::array<SceneParameter, 3> kParameters{{
    {"size", 700, 16, 65536, "edge of the map in cubes of 1 m"},
    {"seed", 7, 0, kLargestSeed, "another town"},
    {"materials", 1, 1, 84, "materials that the blocks are spread over"},
}};

}  // namespace

const SceneRecipe& town_recipe() {
    static const SceneRecipe recipe{
        {"town",
         "a walled harbour town of unit cubes among wooded hills, walked, flown over and seen from afar",
         "6,323,468 triangles in 1,936 objects", kParameters},
        town_size,
        build_town};
    return recipe;
}

}  // namespace rhview
