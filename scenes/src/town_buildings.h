// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The things that stand in the scene `town`, block by block.
#pragma once

#include "random.h"
#include "voxel_grid.h"

namespace rhview {

inline constexpr int kStorey = 4;

enum class Roof { Gable, Pyramid, Battlement };

/// A hollow building with a floor per storey, doors, and window openings without glass.
struct Building {
    Voxel corner;  ///< lowest cube of the least x and z
    int width = 9;
    int depth = 9;
    int storeys = 2;
    Block wall = Block::Plaster;
    Block frame = Block::Timber;  ///< corners and storey lines
    Block roof = Block::RedTiles;
    Roof shape = Roof::Gable;
};

void add_building(VoxelGrid& grid, const Building& building);

/// Walls, frames and roofs in the mixtures of the town's houses.
Building random_house(SceneRandom& random, const Voxel& corner, int width, int depth, int storeys);

/// Trunk with a ragged crown, at most 10 cubes high. `ground` is the lowest cube of the trunk.
void add_tree(VoxelGrid& grid, const Voxel& ground, SceneRandom& random);

/// A market stall, 3 × 3 × 4.
void add_stall(VoxelGrid& grid, const Voxel& corner, Block cloth);

/// A ship afloat, about 7 × 20, its bow towards -z. `corner` is at the water line.
void add_ship(VoxelGrid& grid, const Voxel& corner);

}  // namespace rhview
