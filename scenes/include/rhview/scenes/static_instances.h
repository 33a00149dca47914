// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Which meshes that a scene places repeatedly are flattened into its batches, and which stay instances.
///
/// A flattened placement costs memory: its triangles and vertices are stored once more. In return the octree
/// cuts it where the frustum does, draws its triangles with their neighbours' in one call and, of one-sided
/// materials, skips most that face away. An instance is a box test in every frame and, where that is not
/// outside, a draw call of all its triangles. With p the share of placements in view, c1 and c3 the prices of
/// an index and of a call, a mesh of t triangles costs, per placement and frame,
///
///     kept       box + p·(c3 + 3·t·c1)
///     flattened  p·(a·3·t·c1 + min(c3, d·3·t·c1))
///
/// where a is the share of indices that the octree's draw list leaves of whole objects, d what its calls cost
/// beside its indices. The numbers are in static_instances.cpp, with what they were measured on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/scenes/scene.h"

namespace rhview {

/// A mesh that static instances place.
struct RepeatedMesh {
    MeshId mesh{};
    std::uint64_t placements = 0;
    std::uint64_t triangles = 0;         ///< of one placement
    std::uint64_t vertices = 0;          ///< that these use
    std::uint64_t bytes_per_vertex = 0;  ///< 12 to 20, by format
    bool two_sided = false;

    /// Vertices and indices of one placement.
    [[nodiscard]] std::uint64_t bytes() const { return 12 * triangles + bytes_per_vertex * vertices; }
    [[nodiscard]] std::uint64_t flattened_bytes() const { return placements * bytes(); }
};

/// By mesh id. Cost: linear in the meshes' indices.
std::vector<RepeatedMesh> repeated_meshes(const Scene& scene);

/// Finite, none negative.
struct InstanceCosts {
    double index_ns = 0.25;
    double draw_ns = 2000.0;  ///< a call of its own, with all state that it has to set
};

/// What all placements of a mesh cost a frame by the model above.
double kept_ns(const RepeatedMesh& mesh, const InstanceCosts& costs);
/// What drawing its copies takes a frame, if they are merged into batches.
double flattened_ns(const RepeatedMesh& mesh, const InstanceCosts& costs);

/// The meshes worth flattening, by id: those that save time, most time per byte first, as long as all of them
/// together take at most `budget_bytes`; one that does not fit is left out and the next is tried. Greedy, as
/// for a knapsack: what it saves is less than the best by at most the saving of one mesh that did not fit.
/// Ties go to the lower id. Cost: a sort.
std::vector<MeshId> choose_flattened(std::span<const RepeatedMesh> meshes, const InstanceCosts& costs,
                                     std::uint64_t budget_bytes);

/// Who decides which meshes are flattened.
enum class InstancePolicy {
    Auto,     ///< `choose_flattened`
    Flatten,  ///< all, whatever they take
    Keep,     ///< none
};

/// A quarter of what a graphics card of 4 GiB holds: replicas may take as much as the indices again, and
/// pictures and textures want the rest.
inline constexpr std::uint64_t kDefaultInstanceBudget = std::uint64_t{1} << 30;

/// The policy, its prices and its budget.
struct InstanceOptions {
    InstancePolicy policy = InstancePolicy::Auto;
    InstanceCosts costs;
    std::uint64_t budget_bytes = kDefaultInstanceBudget;  ///< of flattened placements; `Auto` alone heeds it
};

/// Flattens what `options` say, and writes `Scene::instancing`. Each placement becomes an object of the batch
/// of its material and format; mirrored ones keep their outside outside. Meshes that nothing places any more
/// are removed, other meshes and all objects keep their order, their ids may change. Normals are rounded to
/// ten bits once more. Errors: a batch or pool of more than 2^32 - 2 indices or vertices, more memory than is
/// free (said before anything is changed). `Auto` flattens no more than fits the memory that is free; the
/// budget it came to is in the report. Cost: linear in what is flattened.
Status settle_instances(Scene& scene, const InstanceOptions& options);

}  // namespace rhview
