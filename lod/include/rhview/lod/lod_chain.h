// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Chains of levels of detail: one mesh with ever fewer triangles, each level with a proven error.
///
/// All levels index the mesh's own vertices. A level's `error` bounds the Hausdorff distance between its
/// surface and that of the mesh itself, both ways: no point of either is farther from the other than that. It
/// is not composed over the chain and not the simplifier's estimate: each level is measured against the mesh
/// (src/surface_distance.h says how), so an error can be looser than the truth, by a few per cent as a rule,
/// but not tighter. Simplification: meshoptimizer (Kapoulkine), quadric errors after Garland & Heckbert 1997.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "rhview/base/mappable_array.h"
#include "rhview/base/result.h"

namespace rhview {

/// One way of drawing a mesh.
struct LodLevel {
    std::uint32_t first_index = 0;  ///< level 0: into the mesh's indices; others: into `LodChain::indices`
    std::uint32_t index_count = 0;
    float error = 0.0f;        ///< object units; 0 for level 0; never falls along the chain
    std::uint32_t sloppy = 0;  ///< 1: made without regard to topology, where nothing else gets so small

    friend bool operator==(const LodLevel&, const LodLevel&) = default;
};

/// Why a chain has no further level.
enum class LodEnd : std::uint32_t {
    Smallest,      ///< the last level is as small as was asked for
    FewTriangles,  ///< the mesh itself is
    NotFinite,     ///< a corner is not finite: nothing can be measured
    NoArea,        ///< all triangles are points or lines
    NonManifold,   ///< edges of three triangles or more hold the rest in place
    Locked,        ///< borders, seams or the shape itself do
};
/// "the mesh is small as it is": the end of a sentence.
std::string_view text_of(LodEnd end);

/// A mesh at falling detail, all levels over its own vertices.
struct LodChain {
    /// Finest first, at least one: level 0 is the mesh itself. Each other has at most four fifths of the
    /// indices of the one before.
    MappableArray<LodLevel> levels;
    /// Those of level 1 and on, one after the other; values are the mesh's own, into its vertices. Each
    /// level stands in an order that the vertex cache likes.
    MappableArray<std::uint32_t> indices;
    std::uint64_t vertex_count = 0;  ///< every index is below
    LodEnd end = LodEnd::Smallest;
};

/// A mesh as the engine owns it. Corners at one position are taken for one, whatever else they carry, where
/// seams would keep the mesh from getting smaller.
struct LodMesh {
    std::span<const glm::vec3> positions;    ///< object space; other meshes may share them
    std::span<const std::uint32_t> indices;  ///< three per triangle
};

/// How many levels, and how far apart.
struct LodOptions {
    /// Indices of a level as a share of those of the level before; 0.1 to 0.8.
    double ratio = 0.5;
    /// No level is asked to get smaller than this, in triangles; a sloppy one may all the same.
    std::uint32_t min_triangles = 32;
    /// Vertices on a border (an edge of one triangle) stay: neighbours keep fitting.
    bool lock_borders = false;
    /// Ends a chain that cannot get smaller otherwise with levels that ignore topology.
    bool allow_sloppy = true;
    /// Called now and then with the share that is done, 0 to 1 and never falling, by any of the build's
    /// threads but one at a time. False stops the build, which then returns an error.
    std::function<bool(double)> progress{};
};

/// One chain per mesh, in their order. What can't be simplified keeps level 0 alone and says why
/// (`LodChain::end`). Deterministic. Errors name the mesh: an index out of range, an index count that is no
/// multiple of three, 2^32 indices or more, or a build that was stopped. Threads: oneTBB's, as many as the
/// caller's arena has; the chains are the same with any number. Cost: docs/lod.md.
Result<std::vector<LodChain>> build_lod_chains(std::span<const LodMesh> meshes, const LodOptions& options);

}  // namespace rhview
