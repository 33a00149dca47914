// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Which cells of a grid static triangles touch, and which lie wholly inside what they enclose.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "rhview/base/triangle_batch.h"
#include "rhview/baselines/cell_grid.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// A static object: its part of the index buffer, where batches follow one another, and its triangles' box.
struct GridStatic {
    DrawRange range;
    Aabb bounds;
};

/// A list of numbers for each cell, one list after the other.
struct CellLists {
    std::vector<std::uint32_t> first;  ///< one more than there are cells
    std::vector<std::uint32_t> entries;

    /// The entries of a cell, by its number in the grid.
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t cell) const {
        return {entries.data() + first[cell], entries.data() + first[cell + 1]};
    }
};

/// A (cell, number) of a list that is being collected.
struct CellEntry {
    std::uint32_t cell = 0;
    std::uint32_t entry = 0;
};
/// Entries of a cell keep their order. `entries` is below 2^32 long.
CellLists make_cell_lists(std::size_t cell_count, std::span<const CellEntry> entries);

/// A cell inside a closed surface.
struct OpaqueCell {
    std::uint32_t cell = 0;
    std::uint32_t surface = 0;
};

/// What encloses, in surfaces: triangles joined by shared corners (equal positions, whatever the batch).
struct SolidCells {
    /// Triangles that touch a cell, numbered through all batches in order. Made of no fewer cells than the
    /// renderer shows them in: the test has slack.
    CellLists triangles;
    std::vector<std::uint32_t> surface_of;  ///< of a triangle; `kOpen`: encloses nothing
    std::vector<OpaqueCell> opaque;         ///< a cell may be inside several surfaces
    std::uint32_t surface_count = 0;        ///< closed ones
    bool opened_below =
        false;  ///< some have no bottom, at the lowest y of all: no eye below sees them closed

    static constexpr std::uint32_t kOpen = 0xffffffffu;
};

/// A surface is closed if each of its edges is run through as often in either direction; edges at the lowest
/// y of all triangles need not be. A cell that no triangle of a closed surface touches is opaque if the
/// surface winds around it counter-clockwise, seen from outside. Batches that do not occlude enclose nothing.
/// Triangles in all: below 2^32 / 3. Cost: about 1 µs and 120 bytes per triangle while it runs.
SolidCells find_solid_cells(const CellGrid& grid, std::span<const TriangleBatch> batches,
                            const std::vector<bool>& occludes);

/// Radius of the ball about `centre` that lies inside a mesh: 0 if the mesh is not closed, or the centre is
/// not inside. Rounded down. Cost: as `find_solid_cells` for its triangles.
float enclosed_radius(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                      const glm::vec3& centre);

/// Whether the ray along +x from `eye` crosses the triangle in the slab of cells `x`, and how: +1 if it goes
/// in, -1 if out, 0 if it does not. All in cell coordinates; slabs at the grid's ends reach to infinity. Over
/// a closed surface the answers add up to minus its winding around the eye.
int ray_crossing(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& eye, int x, int x_cells);

/// The least distance from a point to a triangle. Source: Ericson, Real-Time Collision Detection, 5.1.5.
double triangle_distance(const glm::dvec3& point, const std::array<glm::dvec3, 3>& triangle);

}  // namespace rhview
