// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Which nodes get a replica, and its indices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rhview/base/build_progress.h"
#include "rhview/rhoctree/draw_list.h"
#include "rhview/rhoctree/rhoctree.h"

namespace rhview {

/// Gives `octree`, whose pieces are done, the replicas that save most by the costs of `options`.
///
/// Every inner node's part of a batch is a candidate if its size can pay. Each sample view is solved once
/// without replicas; at each candidate the cost of its replica is compared with what the base order cost
/// there, in the context of that view. Of nested candidates the outer one is kept or the inner ones, whatever
/// saves more in total, so each triangle is replicated once at most; then the best savings per byte are
/// taken, as long as the budget lasts. What saves less than its planning costs is left out.
class ReplicaBuilder {
  public:
    /// `cluster_of_triangle`: in base order.
    ReplicaBuilder(std::span<const TriangleBatch> batches, const OctreeOptions& options,
                   std::span<const std::uint8_t> cluster_of_triangle, RhOctree& octree,
                   BuildProgress& progress)
        : batches_(batches),
          options_(options),
          cluster_of_triangle_(cluster_of_triangle),
          octree_(octree),
          progress_(progress) {}

    void build();

  private:
    void add_candidates();
    void bound_candidates();
    void bound_candidate(const OctreeReplica& range, std::vector<NormalCluster>& clusters) const;
    /// The clusters of each replica, one replica after the other, behind those that are there.
    void append(const std::vector<std::vector<NormalCluster>>& clusters_of_replica);
    void count_nodes_replicas();
    void measure_savings();
    void keep_outer_or_inner();
    void keep_within_budget();
    void drop_unchosen();
    void emit_indices();
    void emit_replica(const OctreeReplica& replica, std::vector<NormalCluster>& clusters);

    std::span<const TriangleBatch> batches_;
    const OctreeOptions& options_;
    std::span<const std::uint8_t> cluster_of_triangle_;
    RhOctree& octree_;
    BuildProgress& progress_;
    std::vector<double> saving_ns_;  ///< per candidate: mean over the sample views, less its planning
    std::vector<bool> chosen_;
};

}  // namespace rhview
