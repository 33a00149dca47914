// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// CHC, CHC++ and the nested grid on a device that answers exactly, sooner or later.

#include <gtest/gtest.h>

#include <functional>

#include "fake_device.h"
#include "rhview/baselines/chc.h"
#include "rhview/baselines/chc_plus_plus.h"
#include "rhview/baselines/nested_grid.h"
#include "tile_world.h"

namespace rhview {
namespace {

/// A method over a world, and a device with the same indices.
struct Rival {
    std::string name;
    std::vector<TriangleBatch> batches;
    std::vector<std::uint32_t> indices;
    std::unique_ptr<InteractiveMethod> method;
    FakeDevice device;
    DrawnFrame drawn;

    void draw(std::span<const Aabb> objects = {}) {
        device.begin_frame(batches, indices, objects);
        method->draw({FakeDevice::view(), glm::dvec3(0.0), objects}, device, drawn);
    }
};

using Make = std::function<std::unique_ptr<InteractiveMethod>(CullTree)>;

std::unique_ptr<InteractiveMethod> make_chc(CullTree tree) {
    return std::make_unique<Chc>(std::move(tree));
}

Make make_plus_plus(const ChcPlusPlusOptions& options = {}) {
    return [options](CullTree tree) { return std::make_unique<ChcPlusPlus>(std::move(tree), options); };
}

Rival over_objects(const TileWorld& world, std::uint32_t latency, const Make& make, std::uint32_t leaf = 2) {
    const std::vector<TriangleBatch> batches = world.batches();
    OrderedTree tree = make_object_tree(world.objects(), batches, leaf);
    return {"bvh", batches, tree.indices, make(std::move(tree.tree)), FakeDevice(latency), {}};
}

Rival over_octree(const TileWorld& world, std::uint32_t latency, const Make& make) {
    const std::vector<TriangleBatch> batches = world.batches();
    const RhOctree octree = build_octree(batches, {20}).value();
    const std::span<const std::uint32_t> base = octree.indices().first(octree.base_index_count());
    return {
        "octree", batches, {base.begin(), base.end()}, make(CullTree::of_octree(octree)), FakeDevice(latency),
        {}};
}

Rival nested_grid(const TileWorld& world, std::uint32_t latency) {
    const std::vector<TriangleBatch> batches = world.batches();
    OrderedTree tree = make_nested_grid(batches, {2, 6, 3, 30});
    return {"grid",
            batches,
            tree.indices,
            std::make_unique<StopAndWait>(std::move(tree.tree)),
            FakeDevice(latency),
            {}};
}

std::vector<Rival> every_rival(const TileWorld& world, std::uint32_t latency) {
    ChcPlusPlusOptions few;
    few.batch = 3;
    few.visible_frames = 2;
    few.visible_query = VisibleQuery::Box;
    std::vector<Rival> rivals;
    rivals.push_back(over_objects(world, latency, make_chc));
    rivals.push_back(over_octree(world, latency, make_chc));
    rivals.push_back(over_objects(world, latency, make_plus_plus(), 20));
    rivals.push_back(over_octree(world, latency, make_plus_plus()));
    rivals.push_back(over_objects(world, latency, make_plus_plus(few)));
    rivals.push_back(over_octree(world, latency, make_plus_plus(few)));
    rivals.push_back(nested_grid(world, latency));
    return rivals;
}

/// Boxes that go round in the view, some of them in front of everything.
std::vector<Aabb> moving_objects(int frame) {
    std::vector<Aabb> boxes;
    for (int i = 0; i < 30; ++i) {
        const double angle = 0.1 * frame * (1 + i % 3) + i;
        const glm::vec3 centre(70 * std::cos(angle), 70 * std::sin(angle), i % 5 == 0 ? 20.0 : -15.0 * i);
        const glm::vec3 half(i % 5 == 0 ? 25.0f : 3.0f);
        boxes.push_back({centre - half, centre + half});
    }
    return boxes;
}

class Rivals : public testing::TestWithParam<std::uint32_t> {};

TEST_P(Rivals, miss_no_pixel_and_draw_nothing_twice_while_everything_moves) {
    TileWorld world(3);
    world.scatter(11, 600, 12, 300);
    for (Rival& rival : every_rival(world, GetParam())) {
        std::size_t drawn = 0, hidden = 0;
        for (int frame = 0; frame < 25; ++frame) {
            // The objects jump once, and once their number changes.
            std::vector<Aabb> objects = moving_objects(frame < 12 ? frame : frame + 40);
            if (frame >= 18) objects.resize(12);
            rival.draw(objects);
            EXPECT_FALSE(rival.device.drew_something_twice()) << rival.name;
            drawn += rival.device.drawn_triangles();
            hidden += rival.drawn.hidden_queries;
            ASSERT_EQ(rival.device.missing_pixels(), 0u) << rival.name << ", frame " << frame;
        }
        EXPECT_LT(drawn, 25 * 2 * 612u * 9 / 10) << rival.name;
        EXPECT_GT(hidden, 25u) << rival.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Latencies, Rivals, testing::Values(0, 7, 100000));

TEST(Rivals, record_what_they_drew_and_asked) {
    TileWorld world(2);
    world.scatter(12, 300, 8, 200);
    for (Rival& rival : every_rival(world, 5)) {
        for (int frame = 0; frame < 6; ++frame) {
            const std::vector<Aabb> objects = moving_objects(frame);
            rival.draw(objects);
            const FramePlan& plan = rival.drawn.plan;
            EXPECT_EQ(rival.device.log().draws, plan.opaque.size() + plan.objects.size());
            EXPECT_EQ(rival.device.log().box_queries, plan.queries.size());
            EXPECT_EQ(rival.device.log().geometry_queries, rival.drawn.geometry_queries);
            std::size_t triangles = 0, boxes = 0;
            for (const DrawRange& range : plan.opaque) triangles += range.index_count / 3;
            EXPECT_EQ(triangles, rival.device.drawn_triangles());
            for (const ObjectId object : plan.objects)
                EXPECT_TRUE(rival.device.drew_object(index_of(object)));
            for (const PlannedQuery& query : plan.queries) {
                EXPECT_EQ(query.first_box, boxes);
                boxes += query.box_count;
            }
            EXPECT_EQ(plan.query_boxes.size(), boxes);
            EXPECT_FALSE(rival.method->bounds_of(plan.chosen.at(0)).is_empty());
        }
    }
}

/// A wall over the whole view, and tiles behind it.
TileWorld behind_a_wall(int tiles) {
    TileWorld world(1);
    world.scatter(13, tiles, 0, 200);
    world.add(0, glm::vec3(0, 0, 50), 96.0f);
    return world;
}

TEST(ChcPlusPlus, asks_about_what_stays_hidden_with_few_queries) {
    const TileWorld world = behind_a_wall(500);
    // Roots that are not hidden as a whole: the wall is among them. Without a hierarchy, leaf by leaf.
    std::vector<CullNode> nodes;
    std::vector<DrawRange> ranges;
    for (const StaticObject& object : world.objects()) {
        CullNode node;
        node.bounds = object.bounds;
        node.end = static_cast<std::uint32_t>(nodes.size()) + 1;
        node.first_range = static_cast<std::uint32_t>(ranges.size());
        node.range_count = 1;
        nodes.push_back(node);
        ranges.push_back(object.range);
    }
    const std::vector<TriangleBatch> batches = world.batches();
    const auto flat = [&](const Make& make) {
        return Rival{"flat",
                     batches,
                     {batches[0].indices.begin(), batches[0].indices.end()},
                     make(CullTree::of_nodes(nodes, ranges)),
                     FakeDevice(20),
                     {}};
    };
    Rival chc = flat(make_chc), plus_plus = flat(make_plus_plus());
    std::size_t of_chc = 0, of_plus_plus = 0;
    for (int frame = 0; frame < 30; ++frame) {
        chc.draw();
        plus_plus.draw();
        EXPECT_EQ(plus_plus.device.missing_pixels(), 0u);
        // The first answers are to single nodes; certainty grows, and queries with it.
        if (frame < 10) continue;
        of_chc += chc.device.log().box_queries;
        of_plus_plus += plus_plus.device.log().box_queries;
        EXPECT_EQ(plus_plus.device.drawn_triangles(), 2u);
    }
    EXPECT_GE(of_chc, 20u * 500);
    EXPECT_LT(of_plus_plus, of_chc / 5);
}

TEST(ChcPlusPlus, asks_in_batches_where_chc_asks_one_by_one) {
    TileWorld world(1);
    world.scatter(14, 400, 10, 200);
    Rival chc = over_objects(world, 20, make_chc), plus_plus = over_objects(world, 20, make_plus_plus());
    for (int frame = 0; frame < 5; ++frame) {
        chc.draw();
        plus_plus.draw();
        EXPECT_EQ(chc.device.log().box_batches, chc.device.log().box_queries);
        EXPECT_LE(4 * plus_plus.device.log().box_batches, chc.device.log().box_batches);
    }
}

TEST(ChcPlusPlus, a_visible_leaf_is_asked_about_once_in_so_many_frames) {
    TileWorld world(1);
    for (int x = -8; x < 8; ++x)
        for (int y = -8; y < 8; ++y) world.add(0, glm::vec3(11 * x + 5, 11 * y + 5, 0), 5.0f);
    for (const VisibleQuery way : {VisibleQuery::Geometry, VisibleQuery::Box}) {
        ChcPlusPlusOptions options;
        options.visible_query = way;
        Rival rival = over_objects(world, 0, make_plus_plus(options));
        std::size_t asked = 0, most = 0;
        for (int frame = 0; frame < 110; ++frame) {
            rival.draw();
            EXPECT_EQ(rival.device.drawn_triangles(), 512u);
            if (frame < 11) continue;
            const FakeDevice::Log& log = rival.device.log();
            EXPECT_EQ(way == VisibleQuery::Box ? log.geometry_queries : log.box_queries, 0u);
            asked += log.geometry_queries + log.box_queries;
            most = std::max(most, log.geometry_queries + log.box_queries);
        }
        // Every 11th frame (10 are assumed), not all in the same.
        EXPECT_NEAR(static_cast<double>(asked), 256 * 99.0 / 11.0, 256.0);
        EXPECT_LT(most, 60u);
    }
}

TEST(ChcPlusPlus, what_is_revealed_is_drawn_in_the_same_frame) {
    const TileWorld world = [] {
        TileWorld tiles(1);
        tiles.scatter(15, 300, 0, 200);
        return tiles;
    }();
    for (const std::uint32_t latency : {0u, 50u}) {
        Rival rival = over_octree(world, latency, make_plus_plus());
        const std::vector<Aabb> closed{{glm::vec3(-96, -96, 40), glm::vec3(96, 96, 41)}};
        const std::vector<Aabb> open{{glm::vec3(-96, -96, 40), glm::vec3(0, 96, 41)}};
        for (int frame = 0; frame < 20; ++frame) rival.draw(closed);
        EXPECT_LT(rival.device.drawn_triangles(), 100u);
        EXPECT_LE(rival.device.log().box_queries, 6u);
        rival.draw(open);
        EXPECT_GT(rival.device.drawn_triangles(), 200u);
        EXPECT_EQ(rival.device.missing_pixels(), 0u);
    }
}

TEST(ChcPlusPlus, leaves_no_answer_lying_about) {
    TileWorld world(2);
    world.scatter(16, 300, 10, 200);
    for (Rival& rival : every_rival(world, 9)) {
        for (int frame = 0; frame < 60; ++frame) {
            rival.draw(moving_objects(frame));
            // Only queries of visible leaves may be under way, each leaf's once.
            EXPECT_LE(rival.device.outstanding(), rival.drawn.plan.chosen.size() + 60u);
        }
    }
}

TEST(Chc, asks_a_visible_leaf_with_its_own_triangles_in_every_frame) {
    TileWorld world(1);
    for (int x = -4; x < 4; ++x) world.add(0, glm::vec3(20 * x + 10, 0, 0), 8.0f);
    Rival rival = over_objects(world, 4, make_chc);
    rival.draw();
    for (int frame = 0; frame < 5; ++frame) {
        rival.draw();
        EXPECT_EQ(rival.device.log().geometry_queries, 8u);
        EXPECT_EQ(rival.device.log().box_queries, 0u);
        EXPECT_EQ(rival.device.drawn_triangles(), 16u);
    }
}

TEST(Chc, asks_about_the_largest_hidden_nodes_only) {
    const TileWorld world = behind_a_wall(500);
    Rival rival = over_objects(world, 4, make_chc);
    for (int frame = 0; frame < 15; ++frame) rival.draw();
    EXPECT_LT(rival.device.log().box_queries, 20u);
    EXPECT_EQ(rival.device.drawn_triangles(), 2u);
}

TEST(StopAndWait, waits_for_every_answer_before_it_goes_on) {
    TileWorld world(2);
    world.scatter(17, 500, 10, 200);
    Rival rival = nested_grid(world, 30);
    for (int frame = 0; frame < 3; ++frame) {
        rival.draw();
        EXPECT_EQ(rival.device.log().waits, rival.device.log().box_queries);
        EXPECT_EQ(rival.device.log().most_outstanding, 1u);
        EXPECT_EQ(rival.device.outstanding(), 0u);
        EXPECT_GT(rival.device.log().box_queries, 50u);
    }
}

}  // namespace
}  // namespace rhview
