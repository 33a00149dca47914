// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "octree_builder.h"
#include "replicas.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

Result<RhOctree> build_octree(std::span<const TriangleBatch> batches, const OctreeOptions& options) {
    BuildProgress progress(options.progress);
    progress.begin_phase(0.05, 1);
    if (Status status = check_batches(batches); !status) return status.error();
    const TriangleIds ids(batches);
    std::vector<MortonTriangle> triangles =
        sort_by_morton_code(batches, ids, options.max_leaf_triangles, progress);
    if (progress.stopped()) return BuildProgress::stopped_error();
    OctreeBuilder builder(batches, ids, triangles, options, progress);
    builder.build();
    if (progress.stopped()) return BuildProgress::stopped_error();
    std::vector<MortonTriangle>().swap(triangles);
    RhOctree octree = builder.take();
    if (options.replica_budget > 0.0 && options.normal_order && !octree.nodes().empty())
        ReplicaBuilder(batches, options, builder.cluster_of_triangle(), octree, progress).build();
    if (progress.stopped()) return BuildProgress::stopped_error();
    progress.begin_phase(0.0, 1);
    return octree;
}

}  // namespace rhview
