// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// An octree as sections of a baked file (`.rho`), ready to plan with as it is mapped.
///
/// The arrays stay in the mapped file, which lives as long as an octree or copy of it does. Layout:
/// docs/files.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/base/rho_file.h"
#include "rhview/base/rho_writer.h"
#include "rhview/base/triangle_batch.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// What a baked octree was built of.
struct BakedBatch {
    std::uint32_t index_count = 0;
    std::uint64_t vertex_count = 0;  ///< every index is below
};

/// An octree from a file, and what it was built of.
struct BakedOctree {
    RhOctree octree;
    /// What it was built with: the fields that a file can hold.
    OctreeOptions options;
    std::vector<BakedBatch> batches;
};

/// Adds the sections of `octree`, built of `batches` with `options`. The octree stays as it is until the
/// writer has finished.
void add_octree_sections(RhoWriter& writer, const RhOctree& octree, std::span<const TriangleBatch> batches,
                         const OctreeOptions& options);

/// Reads them, and checks all that planning and drawing rely on to stay inside their arrays and to end:
/// depth-first links and depth, ranges that children make up, pieces and clusters that cover the base order,
/// replicas behind it, finite boxes inside their parents' and finite cones, index values below the vertex
/// counts. Whether a box or cone holds its triangles, and a replica its node's, is as the checksums say.
/// Errors: those of `RhoFile`, or the record that is wrong. Cost: one pass over the sections for the
/// checksums, one over the indices, on all of oneTBB's threads, one over the other records.
Result<BakedOctree> read_octree_sections(const RhoFile& file);

}  // namespace rhview
