// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "town_buildings.h"

#include <algorithm>
#include <array>

namespace rhview {
namespace {

/// Calls visit(x, z, along) for every column of the outer walls; `along` counts from a corner, 0 at corners.
template <class Visit>
void for_each_wall_column(const Building& b, Visit visit) {
    for (int i = 0; i < b.width; ++i) {
        const int along = i == 0 || i + 1 == b.width ? 0 : i;
        visit(b.corner.x + i, b.corner.z, along);
        visit(b.corner.x + i, b.corner.z + b.depth - 1, along);
    }
    for (int i = 1; i + 1 < b.depth; ++i) {
        visit(b.corner.x, b.corner.z + i, i);
        visit(b.corner.x + b.width - 1, b.corner.z + i, i);
    }
}

void add_walls(VoxelGrid& grid, const Building& b) {
    for_each_wall_column(b, [&](int x, int z, int along) {
        for (int level = 0; level < b.storeys * kStorey; ++level) {
            const int in_storey = level % kStorey;
            const bool frame = along == 0 || in_storey == kStorey - 1;
            const bool window = along % 3 == 2 && (in_storey == 1 || in_storey == 2);
            if (!window) grid.set({x, b.corner.y + level, z}, frame ? b.frame : b.wall);
        }
    });
}

void add_floors(VoxelGrid& grid, const Building& b) {
    const Voxel& c = b.corner;
    for (int storey = 1; storey <= b.storeys; ++storey) {
        const int y = c.y + storey * kStorey - 1;
        grid.fill({c.x + 1, y, c.z + 1}, {c.x + b.width - 1, y + 1, c.z + b.depth - 1}, Block::Planks);
        // The stair well, and what stands in the rooms: a table and a chest.
        if (storey < b.storeys) grid.fill({c.x + 1, y, c.z + 1}, {c.x + 3, y + 1, c.z + 2}, Block::Empty);
        grid.set({c.x + b.width / 2, y - kStorey + 1, c.z + b.depth / 2}, Block::Timber);
        grid.set({c.x + b.width - 2, y - kStorey + 1, c.z + b.depth - 2}, Block::Planks);
    }
    const int door = c.x + b.width / 2;
    grid.fill({door, c.y, c.z}, {door + 1, c.y + 2, c.z + 1}, Block::Empty);
    grid.fill({door, c.y, c.z + b.depth - 1}, {door + 1, c.y + 2, c.z + b.depth}, Block::Empty);
}

/// Steps inwards from two sides; the ends are filled with wall.
void add_gable(VoxelGrid& grid, const Building& b) {
    const Voxel& c = b.corner;
    const int y0 = c.y + b.storeys * kStorey;
    const bool ridge_along_x = b.width >= b.depth;
    const int span = ridge_along_x ? b.depth : b.width;
    const int length = ridge_along_x ? b.width : b.depth;
    for (int step = 0; 2 * step < span; ++step) {
        for (int i = 0; i < length; ++i) {
            const bool end = i == 0 || i + 1 == length;
            for (int across = step; across < span - step; ++across) {
                const bool slope = across == step || across + 1 == span - step;
                if (!slope && !end) continue;
                const Voxel v = ridge_along_x ? Voxel{c.x + i, y0 + step, c.z + across}
                                              : Voxel{c.x + across, y0 + step, c.z + i};
                grid.set(v, slope ? b.roof : b.wall);
            }
        }
    }
}

void add_pyramid(VoxelGrid& grid, const Building& b) {
    const Voxel& c = b.corner;
    const int y0 = c.y + b.storeys * kStorey;
    const int steps = (std::min(b.width, b.depth) + 1) / 2;
    // Two cubes up for each one inwards, hollow.
    for (int step = 0; step < steps; ++step) {
        const Voxel low{c.x + step, y0 + 2 * step, c.z + step};
        const Voxel high{c.x + b.width - step, y0 + 2 * step + 2, c.z + b.depth - step};
        grid.fill(low, high, b.roof);
        grid.fill({low.x + 1, low.y, low.z + 1}, {high.x - 1, high.y, high.z - 1}, Block::Empty);
    }
}

void add_battlement(VoxelGrid& grid, const Building& b) {
    const int y0 = b.corner.y + b.storeys * kStorey;
    for_each_wall_column(b, [&](int x, int z, int) {
        grid.set({x, y0, z}, b.wall);
        if ((x + z) % 2 == 0) grid.set({x, y0 + 1, z}, b.wall);
    });
}

}  // namespace

void add_building(VoxelGrid& grid, const Building& building) {
    add_walls(grid, building);
    add_floors(grid, building);
    switch (building.shape) {
        case Roof::Gable:
            return add_gable(grid, building);
        case Roof::Pyramid:
            return add_pyramid(grid, building);
        case Roof::Battlement:
            return add_battlement(grid, building);
    }
}

Building random_house(SceneRandom& random, const Voxel& corner, int width, int depth, int storeys) {
    constexpr std::array<Block, 5> kWalls{Block::Plaster, Block::Ochre, Block::Brick, Block::Sandstone,
                                          Block::Planks};
    constexpr std::array<Block, 3> kRoofs{Block::RedTiles, Block::SlateTiles, Block::Thatch};
    Building house{corner, width, depth, storeys};
    house.wall = kWalls[static_cast<std::size_t>(random.below(5))];
    house.roof = kRoofs[static_cast<std::size_t>(random.below(3))];
    house.frame = house.wall == Block::Brick ? Block::Sandstone : Block::Timber;
    const int shape = random.below(10);
    house.shape = shape < 7 ? Roof::Gable : shape < 9 ? Roof::Pyramid : Roof::Battlement;
    return house;
}

void add_tree(VoxelGrid& grid, const Voxel& ground, SceneRandom& random) {
    const int trunk = random.whole(3, 5);
    const Block leaves = random.chance(0.4) ? Block::DarkLeaves : Block::Leaves;
    for (int x = -2; x <= 2; ++x) {
        for (int z = -2; z <= 2; ++z) {
            for (int y = 0; y < 5; ++y) {
                const int spread = x * x + z * z + (y - 1) * (y - 1);
                if (spread <= 7 && random.chance(0.8))
                    grid.set_if_empty({ground.x + x, ground.y + trunk - 1 + y, ground.z + z}, leaves);
            }
        }
    }
    grid.fill(ground, {ground.x + 1, ground.y + trunk, ground.z + 1}, Block::Trunk);
}

void add_stall(VoxelGrid& grid, const Voxel& corner, Block cloth) {
    for (const int x : {0, 2})
        for (const int z : {0, 2})
            grid.fill({corner.x + x, corner.y, corner.z + z},
                      {corner.x + x + 1, corner.y + 3, corner.z + z + 1}, Block::Timber);
    grid.fill({corner.x, corner.y, corner.z + 1}, {corner.x + 1, corner.y + 1, corner.z + 2}, Block::Planks);
    for (int x = 0; x < 3; ++x)
        for (int z = 0; z < 3; ++z)
            grid.set({corner.x + x, corner.y + 3, corner.z + z}, x % 2 == 0 ? cloth : Block::Sail);
}

void add_ship(VoxelGrid& grid, const Voxel& corner) {
    constexpr int kLength = 20, kMiddle = 3;
    for (int z = 0; z < kLength; ++z) {
        const int half = std::min({kMiddle, z / 2, 1 + (kLength - z) / 2});
        for (int x = -half; x <= half; ++x) {
            const bool side = x == -half || x == half;
            grid.set({corner.x + kMiddle + x, corner.y - 1, corner.z + z}, Block::Timber);
            grid.set({corner.x + kMiddle + x, corner.y, corner.z + z}, Block::Planks);
            if (side)
                grid.fill({corner.x + kMiddle + x, corner.y + 1, corner.z + z},
                          {corner.x + kMiddle + x + 1, corner.y + (z > 15 ? 4 : 3), corner.z + z + 1},
                          Block::Timber);
        }
    }
    for (const int mast : {6, 13}) {
        const int x = corner.x + kMiddle, z = corner.z + mast;
        grid.fill({x, corner.y + 1, z}, {x + 1, corner.y + 18, z + 1}, Block::Trunk);
        for (int y = 6; y < 16; ++y) {
            const int half = y < 8 ? 4 : 3;
            for (int dx = -half; dx <= half; ++dx) grid.set({x + dx, corner.y + y, z - 1}, Block::Sail);
        }
    }
}

}  // namespace rhview
