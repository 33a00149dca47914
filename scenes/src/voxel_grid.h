// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Unit cubes in a square map, and the quads of their open faces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rhview/scenes/scene_builder.h"

namespace rhview {

enum class Block : std::uint8_t {
    Empty,
    Grass,
    Dirt,
    Stone,
    Sand,
    Water,
    Crops,
    Cobble,
    Plaza,
    Plaster,
    Ochre,
    Brick,
    Sandstone,
    WallStone,
    Timber,
    Planks,
    RedTiles,
    SlateTiles,
    Thatch,
    Trunk,
    Leaves,
    DarkLeaves,
    Lamp,
    Sail,
};
inline constexpr std::size_t kBlockKinds = 24;

struct Voxel {
    int x = 0, y = 0, z = 0;
};

/// Cube (x, y, z) fills [x, x + 1] × [y, y + 1] × [z, z + 1]. What is outside of the map is empty, below it
/// solid.
class VoxelGrid {
  public:
    static constexpr int kHeight = 96;

    explicit VoxelGrid(int size);

    [[nodiscard]] int size() const { return size_; }
    [[nodiscard]] bool contains(const Voxel& v) const {
        return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < size_ && v.y < kHeight && v.z < size_;
    }
    [[nodiscard]] Block at(const Voxel& v) const { return contains(v) ? blocks_[place(v)] : Block::Empty; }
    /// Ignored outside of the map.
    void set(const Voxel& v, Block block) {
        if (contains(v)) blocks_[place(v)] = block;
    }
    /// All of [low, high), clipped to the map.
    void fill(const Voxel& low, const Voxel& high, Block block);
    /// As `set`, where nothing is yet.
    void set_if_empty(const Voxel& v, Block block);
    /// First empty cube above everything in the column.
    [[nodiscard]] int top(int x, int z) const;
    /// The blocks of a column, from y = 0 up.
    [[nodiscard]] const Block* column(int x, int z) const { return &blocks_[place({x, 0, z})]; }

  private:
    [[nodiscard]] std::size_t place(const Voxel& v) const {
        return (static_cast<std::size_t>(v.x) * static_cast<std::size_t>(size_) +
                static_cast<std::size_t>(v.z)) *
                   kHeight +
               static_cast<std::size_t>(v.y);
    }

    int size_;
    std::vector<Block> blocks_;
};

/// Adds one quad of two triangles per open face, four vertices each, coloured by block; one static object per
/// chunk of 16 × 16 columns and material. The kinds of block are spread over all `materials` in patches of 4
/// × 4 × 4, so that neighbouring faces often differ. The middle of the map becomes x = z = 0.
void add_voxel_faces(SceneBuilder& builder, const VoxelGrid& grid, std::uint64_t seed,
                     const std::vector<MaterialId>& materials);

}  // namespace rhview
