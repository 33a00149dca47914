// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/rhoctree/baked_octree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <random>

#include "../plan_everything.h"
#include "../rho_bytes.h"
#include "random_geometry.h"

namespace rhview {
namespace {

/// The octree of `geometry` as a baked file's bytes.
RhoBytes baked(const RandomGeometry& geometry, const RhOctree& octree, const OctreeOptions& options) {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / (std::string("rhview_octree_") + info->name() + ".rho");
    {
        Result<RhoWriter> writer = RhoWriter::create(file);
        EXPECT_TRUE(writer.ok());
        add_octree_sections(*writer, octree, geometry.batches(), options);
        EXPECT_TRUE(writer->finish().ok());
    }
    const auto bytes = FileBytes::open(file).value();
    std::filesystem::remove(file);
    return {{bytes->bytes().begin(), bytes->bytes().end()}};
}

Result<BakedOctree> read(const RhoBytes& file) {
    const Result<RhoFile> parsed = RhoFile::parse(FileBytes::copy_of(file.bytes), "x.rho");
    if (!parsed) return parsed.error();
    return read_octree_sections(*parsed);
}

/// From far above, where a good part of the triangles faces away: replicas pay.
std::vector<View> views_from_above() {
    std::vector<View> views;
    for (const double x : {-200.0, 0.0, 150.0}) {
        View view;
        const glm::dvec3 eye(x, 300.0, 40.0);
        view.camera_from_world = look_along(eye, -eye, {0.0, 1.0, 0.0});
        view.clip_from_camera = perspective(1.0, 1.5, 0.1, 2000.0, view.clip_depth);
        views.push_back(view);
    }
    return views;
}

/// Batches, options and octree of a small file with everything in it.
struct Small {
    RandomGeometry geometry{11, 3, 300};
    std::vector<View> views = views_from_above();
    OctreeOptions options{.max_leaf_triangles = 20,
                          .replica_budget = 0.5,
                          .costs = {.index_ns = 100.0, .draw_ns = 3000.0},
                          .sample_views = views};
    RhOctree octree = build_octree(geometry.batches(), options).value();
    RhoBytes file = baked(geometry, octree, options);
};

TEST(BakedOctree, comes_back_as_it_was_and_plans_the_same) {
    const Small small;
    const Result<BakedOctree> back = read(small.file);
    ASSERT_TRUE(back.ok()) << back.error().message;
    const RhOctree& octree = back->octree;
    EXPECT_TRUE(std::ranges::equal(octree.indices(), small.octree.indices()));
    EXPECT_EQ(octree.nodes().size(), small.octree.nodes().size());
    EXPECT_EQ(octree.pieces().size(), small.octree.pieces().size());
    EXPECT_EQ(octree.clusters().size(), small.octree.clusters().size());
    EXPECT_EQ(octree.batch_count(), small.octree.batch_count());
    EXPECT_EQ(octree.leaf_count(), small.octree.leaf_count());
    EXPECT_EQ(octree.base_index_count(), small.octree.base_index_count());
    EXPECT_EQ(back->options.max_leaf_triangles, 20u);
    EXPECT_EQ(back->options.costs, small.options.costs);
    EXPECT_EQ(back->options.replica_budget, 0.5);
    EXPECT_GT(octree.replicas().size(), 0u);
    EXPECT_EQ(octree.replicas().size(), small.octree.replicas().size());
    ASSERT_EQ(back->batches.size(), 3u);
    for (const BakedBatch& batch : back->batches) {
        EXPECT_EQ(batch.index_count, 900u);
        EXPECT_EQ(batch.vertex_count, small.geometry.positions.size());
    }
    EXPECT_EQ(plan_everything(octree), plan_everything(small.octree));
    // What was read can be baked again, to the same bytes.
    EXPECT_EQ(baked(small.geometry, octree, back->options).bytes, small.file.bytes);
}

TEST(BakedOctree, outlives_the_file_it_was_read_from_and_copies_share_it) {
    const Small small;
    RhOctree copy;
    {
        const Result<BakedOctree> back = read(small.file);
        ASSERT_TRUE(back.ok());
        copy = back->octree;
        EXPECT_EQ(copy.indices().data(), back->octree.indices().data());
    }
    EXPECT_EQ(plan_everything(copy), plan_everything(small.octree));
}

TEST(BakedOctree, without_triangles_is_one_too) {
    const RandomGeometry nothing(1, 2, 0);
    const RhOctree octree = build_octree(nothing.batches()).value();
    const Result<BakedOctree> back = read(baked(nothing, octree, {}));
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_TRUE(back->octree.nodes().empty());
    EXPECT_EQ(back->octree.batch_count(), 2u);
}

template <class T>
void edit(RhoBytes& file, const char* tag, std::size_t record, const std::function<void(T&)>& change) {
    const std::size_t offset = file.offset_of(tag) + record * sizeof(T);
    T value = file.get<T>(offset);
    change(value);
    file.set(offset, value);
}

TEST(BakedOctree, records_that_contradict_each_other_are_told_by_name) {
    const Small small;
    const auto node = [](std::size_t i, std::function<void(OctreeNode&)> change) {
        return [=](RhoBytes& file) { edit<OctreeNode>(file, "ONOD", i, change); };
    };
    const auto range = [](std::size_t i, std::function<void(DrawRange&)> change) {
        return [=](RhoBytes& file) { edit<DrawRange>(file, "ORNG", i, change); };
    };
    const auto piece = [](std::size_t i, std::function<void(OctreePiece&)> change) {
        return [=](RhoBytes& file) { edit<OctreePiece>(file, "OPCE", i, change); };
    };
    const auto replica = [](std::size_t i, std::function<void(OctreeReplica&)> change) {
        return [=](RhoBytes& file) { edit<OctreeReplica>(file, "OREP", i, change); };
    };
    ASSERT_GT(small.octree.replicas().size(), 0u);
    const std::uint32_t replica_index = small.octree.replicas()[0].first_index;
    const auto index = [](const char* tag, std::size_t i, std::uint32_t value) {
        return [=](RhoBytes& file) { file.set(file.offset_of(tag) + 4 * i, value); };
    };
    const auto last = static_cast<std::uint32_t>(small.octree.nodes().size() - 1);
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<std::pair<std::function<void(RhoBytes&)>, const char*>> cases{
        {node(1, [](OctreeNode& n) { n.end = 1; }), "node 1: its subtree ends before it begins"},
        {node(1, [](OctreeNode& n) { n.end = 0; }), "node 1: its subtree ends before it begins"},
        {node(1, [&](OctreeNode& n) { n.end = last + 2; }), "node 1: its subtree leaves its parent's"},
        {node(0, [](OctreeNode& n) { n.end = 1; }), "node 1: it belongs to no subtree"},
        {node(last, [](OctreeNode& n) { n.end = 0xffffffffu; }), "its subtree leaves its parent's"},
        {node(2, [](OctreeNode& n) { n.bounds.min.x = kNan; }), "node 2: its box is none"},
        {node(2, [](OctreeNode& n) { n.bounds.max.y = 1e30f; }), "node 2: its box leaves its parent's"},
        {node(0, [](OctreeNode& n) { n.bounds.max.y = INFINITY; }), "node 0: its box is none"},
        {node(3, [](OctreeNode& n) { n.first_range = 0xfffffff0u; }),
         "node 3: its ranges are not in section ORNG"},
        {node(3, [](OctreeNode& n) { n.range_count = 0xffffffffu; }),
         "node 3: its ranges are not in section ORNG"},
        {node(3, [](OctreeNode& n) { n.triangle_count += 1; }), "node 3: its ranges hold another number"},
        {node(3, [](OctreeNode& n) { n.first_piece = 0xffffffffu; }), "out of order"},
        {node(3, [](OctreeNode& n) { n.piece_end = 0; }), "out of order"},
        {node(0, [](OctreeNode& n) { n.piece_end = 7; }), "node 0: its pieces or replicas are out of order"},
        {node(4, [](OctreeNode& n) { n.first_replica += 1; }), "its pieces or replicas are out of order"},
        {node(4, [](OctreeNode& n) { n.replica_end = 0x80000000u; }), "node 4: its pieces or replicas"},
        {range(0, [](DrawRange& r) { r.batch = BatchId{3}; }), "range 0: its batch is not in the list"},
        {range(1, [](DrawRange& r) { r.batch = BatchId{0}; }), "range"},
        {range(0, [](DrawRange& r) { r.first_index = 0xfffffffdu; }), "range 0: it leaves its batch"},
        {range(0, [](DrawRange& r) { r.index_count = 0xffffffffu; }), "range 0: it leaves its batch"},
        {range(0, [](DrawRange& r) { r.index_count = 0; }), "range 0: it leaves its batch"},
        {piece(5, [](OctreePiece& p) { p.batch = BatchId{9}; }), "piece 5: it is not its node's range"},
        {piece(5, [](OctreePiece& p) { p.first_index += 3; }), "piece 5: it is not its node's range"},
        {piece(5, [](OctreePiece& p) { p.index_count = 0; }), "piece 5: it is not its node's range"},
        {piece(5, [](OctreePiece& p) { p.first_cluster = 0xfffffffeu; }), "piece 5: its clusters are not in"},
        {piece(5, [](OctreePiece& p) { p.cluster_count = 0xffffffffu; }), "piece 5: its clusters are not in"},
        {piece(5, [](OctreePiece& p) { p.cluster_count = 0; }), "piece 5: its clusters are not in"},
        {piece(5, [](OctreePiece& p) { p.bounds.min.z = -1e9f; }), "piece 5: its box leaves its node's"},
        {[](RhoBytes& file) {
             edit<NormalCluster>(file, "OCLU", 0, [](NormalCluster& c) { c.index_count += 3; });
         },
         "its clusters don't make it up"},
        {[](RhoBytes& file) {
             edit<NormalCluster>(file, "OCLU", 0, [](NormalCluster& c) { c.index_count += 1; });
         },
         "no whole triangles"},
        {[](RhoBytes& file) {
             edit<NormalCluster>(file, "OCLU", 7, [](NormalCluster& c) { c.facing.apex.x = kNan; });
         },
         "cluster 7: its cone is not finite"},
        {replica(0, [](OctreeReplica& r) { r.node = NodeId{0xffffffffu}; }),
         "replica 0: it is not of its node's"},
        {replica(0, [](OctreeReplica& r) { r.batch = BatchId{3}; }), "replica 0: it is not of its node's"},
        {replica(0, [](OctreeReplica& r) { r.index_count -= 3; }), "replica 0: it is not of its node's"},
        {replica(0, [](OctreeReplica& r) { r.first_index = 0; }), "replica 0: it does not follow"},
        {replica(0, [](OctreeReplica& r) { r.first_cluster = 0x7fffffffu; }),
         "replica 0: its clusters are not"},
        {replica(0, [](OctreeReplica& r) { r.cluster_count -= 1; }),
         "replica 0: its clusters don't make it up"},
        {index("OIDX", replica_index, 2700), "section OIDX: replica 0: an index is not below"},
        {index("OIDX", 17, 0xffffffffu), "section OIDX: batch 0: an index is not below"},
        {index("OIDX", 17, 2700), "section OIDX: batch 0: an index is not below its number of vertices"},
        {index("OBAT", 0, 3), "section OBAT: batch 0: it leaves a gap"},
        {index("OBAT", 1, 901), "section OBAT: batch 0: its index count is no multiple of three"},
        {index("OBAT", 1, 903), "section OBAT: batch 1: it leaves a gap"},
        {index("OBAT", 9, 903), "the batches don't make up the base order"},
        {index("OBAT", 2, 0), "section OIDX: batch 0: an index is not below"},
        {index("OINF", 0, 3), "the batches don't make up the base order"},
        {index("OINF", 2, 4), "as many batches as section OINF says"},
        {index("OINF", 3, 1), "another number of leaves"},
        {index("OINF", 9, 0x7ff80000), "negative or not finite"},
        {index("OINF", 6, 2), "neither on nor off"},
    };
    for (const auto& [damage, words] : cases) {
        RhoBytes file = small.file;
        damage(file);
        file.repair();
        const Result<BakedOctree> back = read(file);
        if (back.ok()) {
            ADD_FAILURE() << "accepted, though " << words;
            continue;
        }
        EXPECT_NE(back.error().message.find(words), std::string::npos)
            << back.error().message << " lacks " << words;
        EXPECT_EQ(back.error().message.rfind("x.rho: ", 0), 0u);
    }
}

TEST(BakedOctree, deeper_than_levels_is_refused_before_anyone_recurses) {
    // A chain of nodes, each the only child of the one before.
    const RandomGeometry geometry(3, 1, 1);
    const RhOctree octree = build_octree(geometry.batches()).value();
    ASSERT_EQ(octree.nodes().size(), 1u);
    RhoBytes file = baked(geometry, octree, {});
    std::vector<OctreeNode> chain(100'000, octree.nodes()[0]);
    for (OctreeNode& node : chain) node.end = static_cast<std::uint32_t>(chain.size());
    file.replace("ONOD", std::as_bytes(std::span(chain)));
    file.repair();
    const Result<BakedOctree> back = read(file);
    ASSERT_FALSE(back.ok());
    EXPECT_NE(back.error().message.find("deeper than an octree can be"), std::string::npos);
}

TEST(BakedOctree, wild_records_with_checksums_that_fit_are_refused_or_plan_in_bounds) {
    const Small small;
    std::mt19937 random(5);
    const std::size_t content = small.file.offset_of("OINF");
    int refused = 0, planned = 0;
    constexpr int kRounds = 6000;
    for (int round = 0; round < kRounds; ++round) {
        RhoBytes file = small.file;
        for (unsigned change = 0; change <= random() % 3; ++change) {
            const std::size_t place = content + random() % (file.bytes.size() - content);
            switch (random() % 3) {
                case 0:
                    file.bytes[place] ^= static_cast<std::byte>(1 << static_cast<int>(random() % 8));
                    break;
                case 1:
                    file.bytes[place] = static_cast<std::byte>(random() >> 13);
                    break;
                default:
                    file.set<std::uint32_t>(std::min(place / 4 * 4, file.bytes.size() - 4),
                                            static_cast<std::uint32_t>(random() % 1000));
            }
        }
        file.repair();
        const Result<BakedOctree> back = read(file);
        if (back.ok()) plan_everything(back->octree);
        ++(back.ok() ? planned : refused);
    }
    // Boxes, cones and index values may differ and still be some scene's.
    EXPECT_GT(refused, kRounds / 4);
    EXPECT_GT(planned, kRounds / 10);
}

TEST(BakedOctree, cut_short_anywhere_is_told) {
    const Small small;
    for (std::size_t size = 0; size < small.file.bytes.size(); size += size < 1024 ? 1 : 97) {
        RhoBytes cut = small.file;
        cut.bytes.resize(size);
        EXPECT_FALSE(read(cut).ok()) << size;
        cut.repair();
        EXPECT_FALSE(read(cut).ok()) << size;
    }
}

TEST(BakedOctree, missing_sections_are_told) {
    const Small small;
    for (const char* tag : {"OINF", "OBAT", "ONOD", "ORNG", "OPCE", "OREP", "OCLU", "OIDX"}) {
        RhoBytes file = small.file;
        ASSERT_LT(file.find(tag), file.section_count()) << tag;
        file.bytes[RhoBytes::entry(file.find(tag))] = std::byte{'X'};
        file.repair();
        const Result<BakedOctree> back = read(file);
        ASSERT_FALSE(back.ok());
        EXPECT_NE(back.error().message.find(std::string("section ") + tag + " is missing"),
                  std::string::npos);
    }
}

}  // namespace
}  // namespace rhview
