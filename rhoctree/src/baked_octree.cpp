// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/rhoctree/baked_octree.h"

#include <cmath>

#include "octree_file.h"

namespace rhview {
namespace {

constexpr std::uint32_t kVersion = 1;  // of every section of an octree

OctreeInfoRecord info_of(const RhOctree& octree, const OctreeOptions& options) {
    OctreeInfoRecord info;
    info.base_index_count = octree.base_index_count();
    info.batch_count = static_cast<std::uint32_t>(octree.batch_count());
    info.leaf_count = static_cast<std::uint32_t>(octree.leaf_count());
    info.max_leaf_triangles = options.max_leaf_triangles;
    info.min_record_indices = options.min_record_indices;
    info.count_leaf_per_batch = options.count_leaf_per_batch ? 1 : 0;
    info.normal_order = options.normal_order ? 1 : 0;
    info.replica_budget = options.replica_budget;
    info.index_ns = options.costs.index_ns;
    info.draw_ns = options.costs.draw_ns;
    info.call_ns = options.costs.call_ns;
    return info;
}

OctreeOptions options_of(const OctreeInfoRecord& info) {
    OctreeOptions options;
    options.max_leaf_triangles = info.max_leaf_triangles;
    options.min_record_indices = info.min_record_indices;
    options.count_leaf_per_batch = info.count_leaf_per_batch == 1;
    options.normal_order = info.normal_order == 1;
    options.replica_budget = info.replica_budget;
    options.costs = {info.index_ns, info.draw_ns, info.call_ns};
    return options;
}

std::vector<OctreeBatchRecord> records_of(std::span<const TriangleBatch> batches) {
    std::vector<OctreeBatchRecord> records;
    std::uint32_t first = 0;
    for (const TriangleBatch& batch : batches) {
        const auto count = static_cast<std::uint32_t>(batch.indices.size());
        records.push_back({first, count, batch.positions.size()});
        first += count;
    }
    return records;
}

template <class T>
std::vector<std::byte> bytes_of(std::span<const T> records) {
    const std::span<const std::byte> bytes = std::as_bytes(records);
    return {bytes.begin(), bytes.end()};
}

/// Reads one section after the other; the first error stays.
class SectionReader {
  public:
    explicit SectionReader(const RhoFile& file) : file_(file) {}

    template <class T>
    void read(SectionTag tag, MappableArray<T>& target) {
        if (!status_) return;
        if (Result<MappableArray<T>> records = file_.array<T>(tag, kVersion))
            target = std::move(records).value();
        else
            status_ = records.error();
    }
    [[nodiscard]] const Status& status() const { return status_; }

  private:
    const RhoFile& file_;
    Status status_ = success();
};

}  // namespace

/// What may touch an octree's arrays: they go to a file as they are, and come back as views of it.
class OctreeFile {
  public:
    static void add(RhoWriter& writer, const RhOctree& octree) {
        writer.add_array<OctreeNode>(kOctreeNodes, kVersion, octree.nodes_.span());
        writer.add_array<DrawRange>(kOctreeRanges, kVersion, octree.ranges_.span());
        writer.add_array<OctreePiece>(kOctreePieces, kVersion, octree.pieces_.span());
        writer.add_array<OctreeReplica>(kOctreeReplicas, kVersion, octree.replicas_.span());
        writer.add_array<NormalCluster>(kOctreeClusters, kVersion, octree.clusters_.span());
        writer.add_array<std::uint32_t>(kOctreeIndices, kVersion, octree.indices_.span());
    }

    static Result<RhOctree> read(const RhoFile& file, const OctreeInfoRecord& info,
                                 std::span<const OctreeBatchRecord> batches) {
        RhOctree octree;
        SectionReader reader(file);
        reader.read(kOctreeNodes, octree.nodes_);
        reader.read(kOctreeRanges, octree.ranges_);
        reader.read(kOctreePieces, octree.pieces_);
        reader.read(kOctreeReplicas, octree.replicas_);
        reader.read(kOctreeClusters, octree.clusters_);
        reader.read(kOctreeIndices, octree.indices_);
        if (!reader.status()) return reader.status().error();
        octree.base_index_count_ = static_cast<std::size_t>(info.base_index_count);
        octree.batch_count_ = info.batch_count;
        octree.leaf_count_ = info.leaf_count;
        if (Status status = check_octree(file, octree, octree.ranges_.span(), batches); !status)
            return status.error();
        return octree;
    }
};

void add_octree_sections(RhoWriter& writer, const RhOctree& octree, std::span<const TriangleBatch> batches,
                         const OctreeOptions& options) {
    const OctreeInfoRecord info = info_of(octree, options);
    writer.add_owned(kOctreeInfo, kVersion, bytes_of(std::span(&info, 1)));
    writer.add_owned(kOctreeBatches, kVersion, bytes_of<OctreeBatchRecord>(records_of(batches)));
    OctreeFile::add(writer, octree);
}

Result<BakedOctree> read_octree_sections(const RhoFile& file) {
    MappableArray<OctreeInfoRecord> info;
    MappableArray<OctreeBatchRecord> batches;
    SectionReader reader(file);
    reader.read(kOctreeInfo, info);
    reader.read(kOctreeBatches, batches);
    if (!reader.status()) return reader.status().error();
    if (info.size() != 1) return file.error(kOctreeInfo, "it does not hold one record");
    if (info[0].count_leaf_per_batch > 1 || info[0].normal_order > 1)
        return file.error(kOctreeInfo, "an option is neither on nor off");
    for (const double value : {info[0].replica_budget, info[0].index_ns, info[0].draw_ns, info[0].call_ns})
        if (!(value >= 0.0 && std::isfinite(value)))
            return file.error(kOctreeInfo, "a budget or cost is negative or not finite");
    if (info[0].batch_count != batches.size())
        return file.error(kOctreeBatches, "it does not hold as many batches as section OINF says");
    Result<RhOctree> octree = OctreeFile::read(file, info[0], batches.span());
    if (!octree) return octree.error();
    BakedOctree baked;
    baked.octree = std::move(octree).value();
    baked.options = options_of(info[0]);
    for (const OctreeBatchRecord& batch : batches)
        baked.batches.push_back({batch.index_count, batch.vertex_count});
    return baked;
}

}  // namespace rhview
