// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The octree's sections, as they stand in a baked file (docs/files.md).
#pragma once

#include <cstdint>
#include <span>

#include "rhview/rhoctree/baked_octree.h"

namespace rhview {

inline constexpr SectionTag kOctreeInfo = section_tag("OINF");
inline constexpr SectionTag kOctreeBatches = section_tag("OBAT");
inline constexpr SectionTag kOctreeNodes = section_tag("ONOD");
inline constexpr SectionTag kOctreeRanges = section_tag("ORNG");
inline constexpr SectionTag kOctreePieces = section_tag("OPCE");
inline constexpr SectionTag kOctreeReplicas = section_tag("OREP");
inline constexpr SectionTag kOctreeClusters = section_tag("OCLU");
inline constexpr SectionTag kOctreeIndices = section_tag("OIDX");

/// Section OINF: one record.
struct OctreeInfoRecord {
    std::uint64_t base_index_count = 0;
    std::uint32_t batch_count = 0;
    std::uint32_t leaf_count = 0;
    std::uint32_t max_leaf_triangles = 0;
    std::uint32_t min_record_indices = 0;
    std::uint32_t count_leaf_per_batch = 0;  ///< 0 or 1
    std::uint32_t normal_order = 0;          ///< 0 or 1
    double replica_budget = 0.0;
    double index_ns = 0.0;  ///< the costs that replicas were chosen by
    double draw_ns = 0.0;
    double call_ns = 0.0;
};
static_assert(sizeof(OctreeInfoRecord) == 64);

/// Section OBAT: one record per batch, in base order.
struct OctreeBatchRecord {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    std::uint64_t vertex_count = 0;
};
static_assert(sizeof(OctreeBatchRecord) == 16);

// The other sections are the arrays as they are. No record has padding: its bytes are the fields' alone. A
// field more or less is another version of the section.
static_assert(sizeof(OctreeNode) == 24 + 8 * 4);
static_assert(sizeof(DrawRange) == 3 * 4);
static_assert(sizeof(OctreePiece) == 24 + 5 * 4);
static_assert(sizeof(OctreeReplica) == 6 * 4);
static_assert(sizeof(NormalCluster) == 8 * 4 + 4);

/// Whether `octree` can be planned with and drawn: an error names the section and the record.
Status check_octree(const RhoFile& file, const RhOctree& octree, std::span<const DrawRange> ranges,
                    std::span<const OctreeBatchRecord> batches);

}  // namespace rhview
