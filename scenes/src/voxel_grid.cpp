// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "voxel_grid.h"

#include <algorithm>

#include "random.h"

namespace rhview {
namespace {

constexpr int kChunk = 16;
constexpr std::size_t kShades = 8;

/// Linear RGB of each kind.
constexpr std::array<glm::vec3, kBlockKinds> kColours{
    {{0.00f, 0.00f, 0.00f}, {0.13f, 0.30f, 0.06f}, {0.22f, 0.14f, 0.08f}, {0.27f, 0.27f, 0.27f},
     {0.62f, 0.54f, 0.34f}, {0.05f, 0.16f, 0.36f}, {0.52f, 0.44f, 0.10f}, {0.30f, 0.29f, 0.28f},
     {0.48f, 0.43f, 0.36f}, {0.72f, 0.68f, 0.58f}, {0.64f, 0.46f, 0.22f}, {0.38f, 0.13f, 0.09f},
     {0.66f, 0.58f, 0.42f}, {0.36f, 0.35f, 0.33f}, {0.12f, 0.07f, 0.04f}, {0.36f, 0.22f, 0.11f},
     {0.46f, 0.12f, 0.06f}, {0.10f, 0.12f, 0.16f}, {0.50f, 0.38f, 0.14f}, {0.16f, 0.10f, 0.05f},
     {0.08f, 0.24f, 0.04f}, {0.04f, 0.14f, 0.05f}, {0.90f, 0.76f, 0.40f}, {0.80f, 0.78f, 0.72f}}};

struct FaceSide {
    Voxel neighbour;
    std::array<Voxel, 4> corners;  ///< counter-clockwise, seen from the neighbour
};

constexpr std::array<FaceSide, 6> kSides{{
    {{-1, 0, 0}, {{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}}},
    {{1, 0, 0}, {{{1, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}}},
    {{0, -1, 0}, {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}}},
    {{0, 1, 0}, {{{0, 1, 1}, {1, 1, 1}, {1, 1, 0}, {0, 1, 0}}}},
    {{0, 0, -1}, {{{1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 1, 0}}}},
    {{0, 0, 1}, {{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}},
}};

/// Calls face(voxel, block, side) for every open face of a chunk.
template <class Face>
void for_each_face(const VoxelGrid& grid, int chunk_x, int chunk_z, Face face) {
    const int end_x = std::min(chunk_x + kChunk, grid.size()),
              end_z = std::min(chunk_z + kChunk, grid.size());
    for (int x = chunk_x; x < end_x; ++x) {
        for (int z = chunk_z; z < end_z; ++z) {
            const Block* column = grid.column(x, z);
            const auto beside = [&](int dx, int dz) {
                return grid.contains({x + dx, 0, z + dz}) ? grid.column(x + dx, z + dz) : nullptr;
            };
            const std::array<const Block*, 6> neighbours{beside(-1, 0), beside(1, 0),  nullptr,
                                                         nullptr,       beside(0, -1), beside(0, 1)};
            for (int y = 0; y < VoxelGrid::kHeight; ++y) {
                const Block block = column[y];
                if (block == Block::Empty) continue;
                for (std::size_t side = 0; side < kSides.size(); ++side) {
                    const bool covered =
                        side == 2   ? y == 0 || column[y - 1] != Block::Empty
                        : side == 3 ? y + 1 < VoxelGrid::kHeight && column[y + 1] != Block::Empty
                                    : neighbours[side] != nullptr && neighbours[side][y] != Block::Empty;
                    if (!covered) face(Voxel{x, y, z}, block, side);
                }
            }
        }
    }
}

template <class Chunk>
void for_each_chunk(const VoxelGrid& grid, Chunk chunk) {
    for (int x = 0; x < grid.size(); x += kChunk)
        for (int z = 0; z < grid.size(); z += kChunk) chunk(x, z);
}

struct ColouredQuads {
    std::vector<glm::vec3> positions;
    std::vector<PackedColour> colours;
    std::vector<std::uint32_t> indices;

    void clear() {
        positions.clear();
        colours.clear();
        indices.clear();
    }
};

class FacePainter {
  public:
    FacePainter(std::uint64_t seed, std::size_t materials) : seed_(seed), materials_(materials) {
        for (std::size_t kind = 0; kind < kBlockKinds; ++kind)
            for (std::size_t shade = 0; shade < kShades; ++shade)
                palette_[kind][shade] =
                    pack_colour(kColours[kind] * (0.86f + 0.04f * static_cast<float>(shade)));
    }

    [[nodiscard]] std::size_t material(const Voxel& v, Block block) const {
        if (materials_ == 1) return 0;
        return hash_of_cell(seed_ + static_cast<std::uint64_t>(block), v.x >> 2, v.y >> 2, v.z >> 2) %
               materials_;
    }
    [[nodiscard]] PackedColour colour(const Voxel& v, Block block) const {
        return palette_[static_cast<std::size_t>(block)][scramble(seed_ ^ packed(v)) % kShades];
    }

  private:
    static std::uint64_t packed(const Voxel& v) {
        return static_cast<std::uint64_t>(v.x) << 32 ^ static_cast<std::uint64_t>(v.z) << 8 ^
               static_cast<std::uint64_t>(v.y);
    }

    std::uint64_t seed_;
    std::size_t materials_;
    std::array<std::array<PackedColour, kShades>, kBlockKinds> palette_{};
};

void add_face(ColouredQuads& quads, const Voxel& v, const FaceSide& side, PackedColour colour, int half) {
    const auto first = static_cast<std::uint32_t>(quads.positions.size());
    for (const Voxel& corner : side.corners) {
        quads.positions.emplace_back(v.x + corner.x - half, v.y + corner.y, v.z + corner.z - half);
        quads.colours.push_back(colour);
    }
    quads.indices.insert(quads.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

void reserve_faces(SceneBuilder& builder, const VoxelGrid& grid, const FacePainter& painter,
                   const std::vector<MaterialId>& materials) {
    std::vector<std::size_t> faces(materials.size(), 0);
    std::size_t all = 0;
    for_each_chunk(grid, [&](int x, int z) {
        for_each_face(grid, x, z, [&](const Voxel& v, Block block, std::size_t) {
            ++faces[painter.material(v, block)];
            ++all;
        });
    });
    // The materials share one pool: its room is asked for once.
    for (std::size_t i = 0; i < materials.size(); ++i)
        builder.reserve(materials[i], false, true, i == 0 ? 4 * all : 0, 6 * faces[i]);
}

}  // namespace

VoxelGrid::VoxelGrid(int size)
    : size_(size),
      blocks_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * kHeight, Block::Empty) {}

void VoxelGrid::fill(const Voxel& low, const Voxel& high, Block block) {
    const int bottom = std::max(low.y, 0), top = std::min(high.y, kHeight);
    if (bottom >= top) return;
    for (int x = std::max(low.x, 0); x < std::min(high.x, size_); ++x)
        for (int z = std::max(low.z, 0); z < std::min(high.z, size_); ++z)
            std::fill_n(&blocks_[place({x, bottom, z})], top - bottom, block);
}

void VoxelGrid::set_if_empty(const Voxel& v, Block block) {
    if (at(v) == Block::Empty) set(v, block);
}

int VoxelGrid::top(int x, int z) const {
    const Block* blocks = column(x, z);
    int y = kHeight;
    while (y > 0 && blocks[y - 1] == Block::Empty) --y;
    return y;
}

void add_voxel_faces(SceneBuilder& builder, const VoxelGrid& grid, std::uint64_t seed,
                     const std::vector<MaterialId>& materials) {
    const FacePainter painter(seed, materials.size());
    reserve_faces(builder, grid, painter, materials);
    std::vector<ColouredQuads> quads(materials.size());
    const int half = grid.size() / 2;
    for_each_chunk(grid, [&](int x, int z) {
        for_each_face(grid, x, z, [&](const Voxel& v, Block block, std::size_t side) {
            add_face(quads[painter.material(v, block)], v, kSides[side], painter.colour(v, block), half);
        });
        for (std::size_t i = 0; i < materials.size(); ++i) {
            builder.add_static(materials[i], {quads[i].positions, {}, quads[i].colours, quads[i].indices});
            quads[i].clear();
        }
    });
}

}  // namespace rhview
