// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The shortest path against a search through every list, on random small trees.

#include "rhview/rhoctree/range_route.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "uniform.h"

namespace rhview {
namespace {

/// A node of a random tree over leaves of one batch; hidden leaves are those that nothing has to show.
struct Tree {
    struct Leaf {
        std::uint32_t first = 0;
        std::uint32_t count = 0;
        bool visible = false;
    };
    struct Replica {
        std::size_t first_leaf = 0, end_leaf = 0;  ///< of its node
        double cost_ns = 0.0;
    };
    /// Depth first: node i's subtree ends before `end`.
    struct Node {
        std::size_t first_leaf = 0, end_leaf = 0;
        std::size_t end = 0;
        int replica = -1;
    };
    std::vector<Leaf> leaves;
    std::vector<Node> nodes;
    std::vector<Replica> replicas;
};

std::uint32_t whole(Uniform& uniform, std::uint32_t low, std::uint32_t high) {
    return std::min(high, static_cast<std::uint32_t>(uniform(low, high + 1.0)));
}

void add_node(Tree& tree, std::size_t first, std::size_t end, Uniform& uniform, double most_ns) {
    const std::size_t id = tree.nodes.size();
    tree.nodes.push_back({first, end, 0, -1});
    if (tree.replicas.size() < 5 && uniform(0, 1) < 0.5) {
        tree.nodes[id].replica = static_cast<int>(tree.replicas.size());
        tree.replicas.push_back({first, end, std::floor(uniform(0.0, most_ns))});
    }
    while (end - first > 1) {
        const std::size_t next =
            whole(uniform, static_cast<std::uint32_t>(first + 1), static_cast<std::uint32_t>(end));
        if (next == end && first == tree.nodes[id].first_leaf) continue;
        add_node(tree, first, next, uniform, most_ns);
        first = next;
    }
    if (end - first == 1 && first != tree.nodes[id].first_leaf) add_node(tree, first, end, uniform, most_ns);
    tree.nodes[id].end = tree.nodes.size();
}

Tree random_tree(Uniform& uniform, double most_ns) {
    Tree tree;
    const std::size_t leaves = whole(uniform, 1, 12);
    std::uint32_t first = 3 * whole(uniform, 0, 2);
    for (std::size_t i = 0; i < leaves; ++i) {
        tree.leaves.push_back({first, 3 * whole(uniform, 1, 30), uniform(0, 1) < 0.55});
        first += tree.leaves.back().count;
    }
    add_node(tree, 0, leaves, uniform, most_ns);
    return tree;
}

/// The least cost of what is neither drawn by a replica in `drawn` nor hidden: base ranges over every choice
/// of gaps to bridge.
double cheapest_base(const Tree& tree, const std::vector<bool>& shown, const DrawCosts& costs) {
    std::vector<Tree::Leaf> runs;
    for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
        if (!tree.leaves[i].visible || shown[i]) continue;
        runs.push_back(tree.leaves[i]);
    }
    if (runs.empty()) return 0.0;
    double best = std::numeric_limits<double>::infinity();
    for (std::uint32_t bridged = 0; bridged < 1u << (runs.size() - 1); ++bridged) {
        double cost = costs.draw_ns;
        for (std::size_t i = 0; i < runs.size(); ++i) {
            cost += costs.index_ns * runs[i].count;
            if (i == 0) continue;
            const std::uint32_t gap = runs[i].first - runs[i - 1].first - runs[i - 1].count;
            cost += bridged >> (i - 1) & 1u ? costs.index_ns * gap : costs.draw_ns;
        }
        best = std::min(best, cost);
    }
    return best;
}

double exhaustive(const Tree& tree, const DrawCosts& costs) {
    double best = std::numeric_limits<double>::infinity();
    for (std::uint32_t chosen = 0; chosen < 1u << tree.replicas.size(); ++chosen) {
        std::vector<bool> shown(tree.leaves.size(), false);
        double cost = 0.0;
        for (std::size_t r = 0; r < tree.replicas.size(); ++r) {
            if (!(chosen >> r & 1u)) continue;
            cost += tree.replicas[r].cost_ns;
            for (std::size_t i = tree.replicas[r].first_leaf; i < tree.replicas[r].end_leaf; ++i)
                shown[i] = true;
        }
        best = std::min(best, cost + cheapest_base(tree, shown, costs));
    }
    return best;
}

void walk(const Tree& tree, std::size_t id, const DrawCosts& costs, RangeRoute& route, RangeLog& log) {
    const Tree::Node& node = tree.nodes[id];
    RangeRoute::ReplicaEntry entry;
    if (node.replica >= 0) entry = route.enter_replica(log);
    if (node.end == id + 1)
        for (std::size_t i = node.first_leaf; i < node.end_leaf; ++i)
            if (tree.leaves[i].visible) route.show(tree.leaves[i].first, tree.leaves[i].count, costs, log);
    for (std::size_t child = id + 1; child < node.end; child = tree.nodes[child].end)
        walk(tree, child, costs, route, log);
    if (node.replica >= 0)
        route.leave_replica(entry, static_cast<std::uint32_t>(node.replica),
                            tree.replicas[static_cast<std::size_t>(node.replica)].cost_ns, log);
}

struct Listed {
    double cost_ns = 0.0;
    std::size_t bridged = 0;
    std::size_t replicas = 0;
    bool covers = true;
    bool in_order = true;
};

/// What the list that ends at `place` costs, counted from its ranges, and whether it shows all that is
/// visible.
Listed price(const Tree& tree, std::uint32_t place, const RangeLog& log, const DrawCosts& costs) {
    Listed listed;
    std::vector<bool> shown(tree.leaves.size(), false);
    std::uint32_t later = std::numeric_limits<std::uint32_t>::max();
    for (; place != RangeLog::kNone; place = log[place].previous) {
        const RangeLog::Entry& entry = log[place];
        if (entry.is_replica()) {
            const Tree::Replica& replica = tree.replicas[entry.end];
            listed.cost_ns += replica.cost_ns;
            ++listed.replicas;
            for (std::size_t i = replica.first_leaf; i < replica.end_leaf; ++i) shown[i] = true;
            continue;
        }
        listed.in_order = listed.in_order && entry.first < entry.end && entry.end <= later;
        later = entry.first;
        listed.cost_ns += costs.draw_ns + costs.index_ns * (entry.end - entry.first);
        for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
            const Tree::Leaf& leaf = tree.leaves[i];
            if (leaf.first < entry.first || leaf.first + leaf.count > entry.end) continue;
            shown[i] = true;
            listed.bridged += !leaf.visible;
        }
    }
    for (std::size_t i = 0; i < tree.leaves.size(); ++i)
        listed.covers = listed.covers && (!tree.leaves[i].visible || shown[i]);
    return listed;
}

TEST(RangeRoute, equals_the_exhaustive_minimum_and_its_list_costs_what_it_says) {
    Uniform uniform(81);
    // Whole numbers: sums are exact, so equal means equal. The last two: only indices cost, only draws cost.
    constexpr std::array<DrawCosts, 7> kCosts{DrawCosts{1, 1, 0},  DrawCosts{1, 20, 0},  DrawCosts{1, 100, 0},
                                              DrawCosts{2, 45, 0}, DrawCosts{1, 1e6, 0}, DrawCosts{1, 0, 0},
                                              DrawCosts{0, 1, 0}};
    std::size_t bridged = 0, replicas = 0, lists = 0;
    for (int i = 0; i < 6000; ++i) {
        const DrawCosts costs = kCosts[static_cast<std::size_t>(i) % kCosts.size()];
        const Tree tree = random_tree(uniform, 2.0 * costs.draw_ns + 200.0 * costs.index_ns);
        RangeLog log;
        RangeRoute route;
        walk(tree, 0, costs, route, log);
        ASSERT_EQ(route.cost_ns(), exhaustive(tree, costs)) << "tree " << i;
        const Listed listed = price(tree, route.finish(log), log, costs);
        EXPECT_EQ(listed.cost_ns, route.cost_ns()) << "tree " << i;
        EXPECT_TRUE(listed.covers) << "tree " << i;
        EXPECT_TRUE(listed.in_order) << "tree " << i;
        bridged += listed.bridged;
        replicas += listed.replicas;
        lists += route.cost_ns() > 0.0;
    }
    // The cases are not all of one kind.
    EXPECT_GT(bridged, 1000u);
    EXPECT_GT(replicas, 1000u);
    EXPECT_GT(lists, 4000u);
}

TEST(RangeRoute, two_batches_share_a_log_and_keep_apart) {
    const DrawCosts costs{1, 10, 0};
    RangeLog log;
    RangeRoute even, odd;
    for (std::uint32_t i = 0; i < 20; ++i) (i % 2 ? odd : even).show(40 * i, 3, costs, log);
    for (RangeRoute* route : {&even, &odd}) {
        EXPECT_EQ(route->cost_ns(), 10 * (10 + 3));
        std::uint32_t expected = route == &odd ? 19 : 18;
        for (std::uint32_t place = route->finish(log); place != RangeLog::kNone;
             place = log[place].previous) {
            EXPECT_EQ(log[place].first, 40 * expected);
            expected -= 2;
        }
        EXPECT_LT(static_cast<std::int32_t>(expected), 0);
    }
}

TEST(RangeRoute, a_gap_worth_exactly_a_draw_is_bridged) {
    const DrawCosts costs{2, 12, 0};
    RangeLog log;
    RangeRoute tie, longer;
    tie.show(0, 3, costs, log);
    tie.show(9, 3, costs, log);
    longer.show(0, 3, costs, log);
    longer.show(10, 3, costs, log);
    EXPECT_EQ(log[tie.finish(log)].previous, RangeLog::kNone);
    EXPECT_NE(log[longer.finish(log)].previous, RangeLog::kNone);
}

TEST(RangeRoute, an_equally_dear_replica_is_not_drawn) {
    const DrawCosts costs{1, 10, 0};
    for (const double replica_ns : {12.0, 13.0}) {
        RangeLog log;
        RangeRoute route;
        const auto entry = route.enter_replica(log);
        route.show(0, 3, costs, log);
        route.leave_replica(entry, 7, replica_ns, log);
        EXPECT_EQ(route.cost_ns(), std::min(replica_ns, 13.0));
        EXPECT_EQ(log[route.finish(log)].is_replica(), replica_ns < 13.0);
    }
}

TEST(RangeRoute, nothing_to_show_is_no_range) {
    RangeLog log;
    RangeRoute route;
    const auto entry = route.enter_replica(log);
    route.leave_replica(entry, 0, 0.0, log);
    EXPECT_EQ(route.cost_ns(), 0.0);
    EXPECT_EQ(route.finish(log), RangeLog::kNone);
}

}  // namespace
}  // namespace rhview
