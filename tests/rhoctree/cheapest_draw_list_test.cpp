// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Whole draw lists of random octrees: what they cost, against the min-plus matrices and the simple rules, and
// that every front-facing triangle in view is there.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "balls.h"
#include "draw_list_price.h"
#include "random_geometry.h"
#include "rhview/rhoctree/draw_list.h"
#include "rhview/rhoctree/normal_clusters.h"

namespace rhview {
namespace {

View random_view(Uniform& uniform) {
    const glm::dvec3 eye(uniform(-120, 120), uniform(-30, 30), uniform(-120, 120));
    const glm::dvec3 forward(uniform(-1, 1), uniform(-0.4, 0.4), uniform(-1, 1));
    return {look_along(eye, forward, {0, 1, 0}),
            perspective(uniform(0.1, 2.0), 1.6, 0.1, uniform(20, 400), ClipDepth::NegativeOneToOne),
            ClipDepth::NegativeOneToOne};
}

OctreeOptions options_of(std::uint32_t leaf, std::uint32_t record, double budget,
                         const DrawCosts& costs = {}) {
    OctreeOptions options;
    options.max_leaf_triangles = leaf;
    options.min_record_indices = record;
    options.replica_budget = budget;
    options.costs = costs;
    return options;
}

/// C[i][o]: the least cost to get past something when a base range is open (1) or not (0) before and after.
using Matrix = std::array<std::array<double, 2>, 2>;

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t o = 0; o < 2; ++o) c[i][o] = std::min(a[i][0] + b[0][o], a[i][1] + b[1][o]);
    return c;
}

/// The recursion of min-plus matrices, without any short cut: every node and cluster is looked at.
class MatrixOracle {
  public:
    MatrixOracle(const RhOctree& octree, const Frustum& frustum, const Viewpoint& viewpoint,
                 const DrawCosts& costs, BatchId batch, std::span<const NodeAlternative> alternatives = {})
        : octree_(octree),
          frustum_(frustum),
          viewpoint_(viewpoint),
          costs_(costs),
          batch_(batch),
          alternatives_(alternatives) {}

    [[nodiscard]] double least() const {
        const Matrix c = of_node(0);
        return std::min(c[0][0], c[0][1]);
    }

  private:
    [[nodiscard]] bool is_outside(const Aabb& box) const {
        PlaneMask mask = frustum_.mask;
        return classify(frustum_, box, mask) == Containment::Outside;
    }
    [[nodiscard]] Matrix hidden(double count) const {
        const double s = costs_.index_ns * count;
        return {{{0.0, costs_.draw_ns + s}, {0.0, s}}};
    }
    [[nodiscard]] Matrix shown(double count) const {
        const double s = costs_.index_ns * count;
        return {{{costs_.draw_ns + s, costs_.draw_ns + s}, {s, s}}};
    }
    [[nodiscard]] const NodeAlternative* alternative_of(NodeId node, std::uint32_t piece) const {
        const auto found = std::ranges::find_if(alternatives_, [&](const NodeAlternative& alternative) {
            return alternative.node == node && alternative.piece == piece;
        });
        return found == alternatives_.end() ? nullptr : &*found;
    }
    [[nodiscard]] Matrix offered(const NodeAlternative& alternative, std::uint32_t count) const {
        Matrix c = shown(count);
        const double r = alternative.draw_ns + alternative.index_ns * count;
        for (std::size_t i = 0; i < 2; ++i) c[i][0] = std::min(c[i][0], r);
        return c;
    }
    [[nodiscard]] Matrix of_clusters(std::uint32_t first, std::uint32_t count) const {
        Matrix c = hidden(0);
        for (const NormalCluster& cluster : octree_.clusters().subspan(first, count))
            c = product(c, faces_away(cluster.facing, viewpoint_) ? hidden(cluster.index_count)
                                                                  : shown(cluster.index_count));
        return c;
    }
    [[nodiscard]] Matrix of_node(std::uint32_t id) const {
        const OctreeNode& node = octree_.nodes()[id];
        const auto ranges = octree_.ranges(NodeId{id});
        const auto range = std::ranges::find(ranges, batch_, &DrawRange::batch);
        if (range == ranges.end()) return hidden(0);
        if (is_outside(node.bounds)) return hidden(range->index_count);
        if (const NodeAlternative* whole = alternative_of(NodeId{id}, NodeAlternative::kWhole))
            return offered(*whole, range->index_count);
        const bool leaf = octree_.is_leaf(NodeId{id});
        const std::uint32_t piece_end = leaf ? node.piece_end : octree_.nodes()[id + 1].first_piece;
        const auto pieces = octree_.pieces().subspan(node.first_piece, piece_end - node.first_piece);
        const auto piece = std::ranges::find(pieces, range->first_index, &OctreePiece::first_index);
        Matrix c = hidden(0);
        if (piece != pieces.end() && piece->batch == batch_ && piece->index_count == range->index_count) {
            const auto number = static_cast<std::uint32_t>(&*piece - octree_.pieces().data());
            if (const NodeAlternative* of_piece = alternative_of(NodeId{id}, number))
                c = offered(*of_piece, piece->index_count);
            else
                c = is_outside(piece->bounds) ? hidden(piece->index_count)
                                              : of_clusters(piece->first_cluster, piece->cluster_count);
        } else {
            for (std::uint32_t child = id + 1; child < node.end; child = octree_.nodes()[child].end)
                c = product(c, of_node(child));
        }
        for (const OctreeReplica& replica : octree_.replicas()) {
            if (replica.node != NodeId{id} || replica.batch != batch_) continue;
            const Matrix r = of_clusters(replica.first_cluster, replica.cluster_count);
            for (std::size_t i = 0; i < 2; ++i) c[i][0] = std::min(c[i][0], std::min(r[0][0], r[0][1]));
        }
        return c;
    }

    const RhOctree& octree_;
    const Frustum& frustum_;
    const Viewpoint& viewpoint_;
    DrawCosts costs_;
    BatchId batch_;
    std::span<const NodeAlternative> alternatives_;
};

/// Nodes and pieces of leaves in view, none within another, each with random prices.
std::vector<NodeAlternative> random_alternatives(const RhOctree& octree, const Frustum& frustum,
                                                 const DrawCosts& costs, Uniform& uniform) {
    std::vector<NodeAlternative> alternatives;
    const std::span<const OctreeNode> nodes = octree.nodes();
    for (std::uint32_t i = 0; i < nodes.size();) {
        PlaneMask mask = frustum.mask;
        if (classify(frustum, nodes[i].bounds, mask) == Containment::Outside) {
            i = nodes[i].end;
            continue;
        }
        const auto offer = [&](std::uint32_t piece) {
            const double index_ns = uniform(0, 1) * costs.index_ns;
            alternatives.push_back({NodeId{i}, piece, index_ns, uniform(0, 1.5) * costs.draw_ns});
        };
        if (uniform(0, 1) < 0.15) {
            offer(NodeAlternative::kWhole);
            i = nodes[i].end;
            continue;
        }
        if (octree.is_leaf(NodeId{i}))
            for (std::uint32_t p = nodes[i].first_piece; p < nodes[i].piece_end; ++p)
                if (uniform(0, 1) < 0.3) offer(p);
        ++i;
    }
    return alternatives;
}

/// By first index: corners are not shared. What is left to alternatives counts as drawn.
std::vector<bool> drawn_triangles(const Balls& balls, const RhOctree& octree, const DrawList& list) {
    std::vector<bool> drawn(balls.positions.size(), false);
    const auto mark = [&](const DrawRange& range) {
        for (std::uint32_t k = 0; k < range.index_count; k += 3)
            drawn[octree.indices()[range.first_index + k]] = true;
    };
    for (const DrawRange& range : list.ranges) mark(range);
    for (const AlternativeRange& range : list.alternatives) mark(range.range);
    return drawn;
}

struct Case {
    std::uint32_t leaf;
    std::uint32_t record;
    double budget;
    DrawCosts costs;
};

class CheapestDrawList : public testing::TestWithParam<Case> {};
class CheapestDrawListOfWholeLeaves : public CheapestDrawList {};

TEST_P(CheapestDrawList, equals_the_min_plus_matrices_and_costs_what_it_says) {
    const auto [leaf, record, budget, costs] = GetParam();
    const Balls balls(91, 3, 60, 150);
    const RhOctree octree = build_octree(balls.batches(), options_of(leaf, record, budget, costs)).value();
    Uniform uniform(92);
    DrawListSolver solver;
    DrawList list;
    for (int i = 0; i < 60; ++i) {
        const View view = random_view(uniform);
        const Frustum frustum = make_frustum(view);
        const Viewpoint viewpoint = make_viewpoint(view);
        solver.solve(octree, frustum, viewpoint, costs, list);
        double expected = 0.0;
        std::set<BatchId> drawn;
        for (const DrawRange& range : list.ranges) drawn.insert(range.batch);
        for (std::uint32_t b = 0; b < 3; ++b)
            expected += MatrixOracle(octree, frustum, viewpoint, costs, BatchId{b}).least();
        expected += costs.call_ns * static_cast<double>(drawn.size());
        EXPECT_NEAR(list.predicted_ns, expected, 1e-9 * expected);
        EXPECT_NEAR(list.predicted_ns, price(list.ranges, costs), 1e-9 * expected);
    }
}

TEST_P(CheapestDrawList, leaves_nodes_to_their_alternatives_exactly_where_that_is_cheaper) {
    const auto [leaf, record, budget, costs] = GetParam();
    const Balls balls(99, 3, 60, 150);
    const RhOctree octree = build_octree(balls.batches(), options_of(leaf, record, budget, costs)).value();
    Uniform uniform(100);
    DrawListSolver solver;
    DrawList list;
    std::size_t offered = 0, taken = 0;
    for (int i = 0; i < 60; ++i) {
        const View view = random_view(uniform);
        const Frustum frustum = make_frustum(view);
        const Viewpoint viewpoint = make_viewpoint(view);
        const std::vector<NodeAlternative> alternatives =
            random_alternatives(octree, frustum, costs, uniform);
        solver.solve(octree, frustum, viewpoint, costs, list, alternatives);
        double expected = 0.0, listed = price(list.ranges, costs);
        std::set<BatchId> drawn;
        for (const DrawRange& range : list.ranges) drawn.insert(range.batch);
        for (std::uint32_t b = 0; b < 3; ++b)
            expected += MatrixOracle(octree, frustum, viewpoint, costs, BatchId{b}, alternatives).least();
        expected += costs.call_ns * static_cast<double>(drawn.size());
        std::size_t ranges_offered = 0;
        for (const NodeAlternative& alternative : alternatives)
            ranges_offered +=
                alternative.piece != NodeAlternative::kWhole ? 1 : octree.ranges(alternative.node).size();
        for (const AlternativeRange& range : list.alternatives) {
            const NodeAlternative& alternative = alternatives[range.alternative];
            const auto ranges = octree.ranges(alternative.node);
            EXPECT_NE(std::ranges::find(ranges, range.range), ranges.end());
            listed += alternative.draw_ns + alternative.index_ns * range.range.index_count;
        }
        EXPECT_NEAR(list.predicted_ns, expected, 1e-9 * expected);
        EXPECT_NEAR(list.predicted_ns, listed, 1e-9 * expected);
        offered += ranges_offered;
        taken += list.alternatives.size();
    }
    EXPECT_GT(offered, 30u);
    EXPECT_GT(taken, 0u);
}

TEST_P(CheapestDrawList, shows_every_front_facing_triangle_in_view_or_leaves_it_to_an_alternative) {
    const auto [leaf, record, budget, costs] = GetParam();
    const Balls balls(101, 3, 50, 150);
    const std::vector<TriangleBatch> batches = balls.batches();
    const RhOctree octree = build_octree(batches, options_of(leaf, record, budget, costs)).value();
    Uniform uniform(102);
    DrawListSolver solver;
    DrawList with;
    std::size_t left = 0;
    for (int i = 0; i < 40; ++i) {
        const View view = random_view(uniform);
        const Frustum frustum = make_frustum(view);
        const Viewpoint viewpoint = make_viewpoint(view);
        const std::vector<NodeAlternative> alternatives =
            random_alternatives(octree, frustum, costs, uniform);
        solver.solve(octree, frustum, viewpoint, costs, with, alternatives);
        std::vector<DrawRange> to_show;
        append_ranges_to_show(octree, frustum, viewpoint, to_show);
        const std::vector<bool> drawn = drawn_triangles(balls, octree, with);
        const auto faces_eye = [&](std::uint32_t first) {
            const auto at = [&](std::uint32_t k) {
                return glm::dvec3(balls.positions[octree.indices()[first + k]]);
            };
            return glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), view.eye() - at(0)) > 0.0;
        };
        for (const DrawRange& range : to_show)
            for (std::uint32_t k = 0; k < range.index_count; k += 3)
                ASSERT_TRUE(!faces_eye(range.first_index + k) ||
                            drawn[octree.indices()[range.first_index + k]])
                    << "view " << i;
        left += with.alternatives.size();
    }
    EXPECT_GT(left, 0u);
}

TEST_P(CheapestDrawList, shows_every_front_facing_triangle_in_view) {
    const auto [leaf, record, budget, costs] = GetParam();
    const Balls balls(93, 3, 50, 150);
    const std::vector<TriangleBatch> batches = balls.batches();
    const RhOctree octree = build_octree(batches, options_of(leaf, record, budget, costs)).value();
    Uniform uniform(94);
    DrawListSolver solver;
    DrawList list;
    std::size_t must = 0, of_all = 0;
    for (int i = 0; i < 40; ++i) {
        const View view = random_view(uniform);
        const Frustum frustum = make_frustum(view);
        solver.solve(octree, frustum, make_viewpoint(view), costs, list);
        const std::vector<bool> drawn = drawn_triangles(balls, octree, list);
        const glm::dvec3 eye = view.eye();
        for (const TriangleBatch& batch : batches) {
            for (std::size_t t = 0; t < batch.indices.size(); t += 3) {
                const glm::vec3& a = balls.positions[batch.indices[t]];
                const glm::vec3& b = balls.positions[batch.indices[t + 1]];
                const glm::vec3& c = balls.positions[batch.indices[t + 2]];
                Aabb box;
                for (const glm::vec3& corner : {a, b, c}) box.grow(corner);
                PlaneMask mask = frustum.mask;
                const glm::dvec3 normal = face_normal(a, b, c);
                const bool front = batch.two_sided || glm::dot(normal, eye - glm::dvec3(a)) > 0.0;
                if (!front || classify(frustum, box, mask) == Containment::Outside) continue;
                ++must;
                ASSERT_TRUE(drawn[batch.indices[t]]) << "view " << i << ", triangle " << t;
            }
        }
        of_all += balls.positions.size() / 3;
    }
    EXPECT_GT(must, of_all / 50);
    EXPECT_LT(must, of_all / 2);
}

TEST_P(CheapestDrawListOfWholeLeaves, never_costs_more_than_the_simple_rules) {
    const auto [leaf, record, budget, costs] = GetParam();
    const Balls balls(95, 3, 60, 150);
    const RhOctree octree = build_octree(balls.batches(), options_of(leaf, record, budget, costs)).value();
    Uniform uniform(96);
    DrawListSolver solver;
    DrawList list;
    NodeList nodes;
    double total = 0.0, seed_total = 0.0;
    for (int i = 0; i < 100; ++i) {
        const View view = random_view(uniform);
        const Frustum frustum = make_frustum(view);
        solver.solve(octree, frustum, make_viewpoint(view), costs, list);
        std::vector<DrawRange> seed, leaves;
        seed_draw_list(octree, frustum, nodes);
        append_ranges(octree, nodes, seed);
        leaf_draw_list(octree, frustum, nodes);
        append_ranges(octree, nodes, leaves);
        const auto everything = octree.ranges(NodeId{0});
        const double limit = 1.0 + 1e-12;
        EXPECT_LE(list.predicted_ns, limit * price(seed, costs));
        EXPECT_LE(list.predicted_ns, limit * price(leaves, costs));
        EXPECT_LE(list.predicted_ns, limit * price(everything, costs));
        total += list.predicted_ns;
        seed_total += price(seed, costs);
    }
    EXPECT_LT(total, 0.95 * seed_total);
}

TEST_P(CheapestDrawList, is_the_same_from_any_solver_and_after_any_frame) {
    const auto [leaf, record, budget, costs] = GetParam();
    const Balls balls(97, 3, 60, 150);
    const RhOctree octree = build_octree(balls.batches(), options_of(leaf, record, budget, costs)).value();
    const RhOctree again = build_octree(balls.batches(), options_of(leaf, record, budget, costs)).value();
    Uniform uniform(98);
    DrawListSolver warm;
    DrawList a, b;
    for (int i = 0; i < 30; ++i) {
        const View view = random_view(uniform);
        warm.solve(octree, make_frustum(view), make_viewpoint(view), costs, a);
        DrawListSolver fresh;
        fresh.solve(again, make_frustum(view), make_viewpoint(view), costs, b);
        EXPECT_EQ(a.ranges, b.ranges);
        EXPECT_EQ(a.predicted_ns, b.predicted_ns);
        EXPECT_TRUE(std::ranges::is_sorted(a.ranges, {}, &DrawRange::batch));
    }
}

/// What an own traversal finds out, but for some of the nodes.
void find_some_containment(const RhOctree& octree, const Frustum& frustum, std::uint32_t index,
                           PlaneMask mask, Uniform& uniform, std::vector<PlaneMask>& known) {
    const OctreeNode& node = octree.nodes()[index];
    const bool outside = classify(frustum, node.bounds, mask) == Containment::Outside;
    if (uniform(0.0, 1.0) < 0.6) known[index] = outside ? KnownContainment::kOutside : mask;
    if (outside) return;
    for (std::uint32_t child = index + 1; child < node.end; child = octree.nodes()[child].end)
        find_some_containment(octree, frustum, child, mask, uniform, known);
}

TEST_P(CheapestDrawList, is_the_same_if_some_of_the_tests_are_known) {
    const auto [leaf, record, budget, costs] = GetParam();
    const Balls balls(99, 3, 60, 150);
    const RhOctree octree = build_octree(balls.batches(), options_of(leaf, record, budget, costs)).value();
    Uniform uniform(100);
    DrawListSolver solver;
    DrawList without, with;
    for (int i = 0; i < 30; ++i) {
        const View view = random_view(uniform);
        const Frustum frustum = make_frustum(view);
        std::vector<PlaneMask> known(octree.nodes().size(), KnownContainment::kUnknown);
        find_some_containment(octree, frustum, 0, frustum.mask, uniform, known);
        solver.solve(octree, frustum, make_viewpoint(view), costs, without);
        solver.solve(octree, frustum, make_viewpoint(view), costs, with, {}, {known});
        EXPECT_EQ(with.ranges, without.ranges);
        EXPECT_EQ(with.nodes, without.nodes);
        EXPECT_EQ(with.predicted_ns, without.predicted_ns);
    }
}

const std::array<Case, 7> kWholeLeaves{Case{1, 0, 0.0, {1, 1, 0}},     Case{20, 0, 0.0, {1, 60, 0}},
                                       Case{20, 0, 1.0, {1, 60, 0}},   Case{20, 0, 1.0, {1, 60, 500}},
                                       Case{20, 0, 1.0, {1, 0, 0}},    Case{20, 0, 1.0, {0, 1, 0}},
                                       Case{500, 0, 1.0, {1, 200, 10}}};
// Where records are joined, leaves are finer than what a list can tell apart.
const std::array<Case, 3> kJoinedRecords{Case{50, 60, 1.0, {0.25, 50, 0}}, Case{50, 60, 0.4, {0.25, 50, 0}},
                                         Case{100000, 30, 1.0, {1, 100, 0}}};

INSTANTIATE_TEST_SUITE_P(WholeLeaves, CheapestDrawList, testing::ValuesIn(kWholeLeaves));
INSTANTIATE_TEST_SUITE_P(JoinedRecords, CheapestDrawList, testing::ValuesIn(kJoinedRecords));
INSTANTIATE_TEST_SUITE_P(All, CheapestDrawListOfWholeLeaves, testing::ValuesIn(kWholeLeaves));

TEST(DrawListSolver, free_draws_leave_out_exactly_what_need_not_be_shown) {
    const Balls balls(99, 3, 60, 150);
    const RhOctree octree = build_octree(balls.batches(), options_of(20, 30, 0.0)).value();
    Uniform uniform(100);
    DrawListSolver solver;
    DrawList list;
    std::size_t left_out = 0;
    for (int i = 0; i < 60; ++i) {
        const View view = random_view(uniform);
        solver.solve(octree, make_frustum(view), make_viewpoint(view), {1, 0, 0}, list);
        std::vector<DrawRange> expected, joined;
        append_ranges_to_show(octree, make_frustum(view), make_viewpoint(view), expected);
        std::ranges::sort(expected, {}, &DrawRange::first_index);
        for (const DrawRange& range : expected) {
            if (!joined.empty() && joined.back().batch == range.batch &&
                joined.back().first_index + joined.back().index_count == range.first_index)
                joined.back().index_count += range.index_count;
            else
                joined.push_back(range);
        }
        EXPECT_EQ(list.ranges, joined);
        left_out += joined.size();
    }
    EXPECT_GT(left_out, 1000u);
}

TEST(DrawListSolver, replicas_lower_the_cost_where_much_faces_away) {
    // Triangles that face anywhere, wherever they are: no leaf faces away as a whole. Seen from far enough
    // above, a third of a node's clusters do.
    const RandomGeometry geometry(101, 1, 16000);
    const auto view_from_above = [](Uniform& uniform) {
        const glm::dvec3 eye(uniform(-300, 300), uniform(150, 400), uniform(-300, 300));
        return View{look_along(eye, glm::dvec3(uniform(-60, 60), 0, uniform(-60, 60)) - eye, {0, 1, 0}),
                    perspective(1.0, 1.6, 0.1, 2000.0, ClipDepth::NegativeOneToOne),
                    ClipDepth::NegativeOneToOne};
    };
    // So dear that planning costs nothing beside it.
    const DrawCosts costs{100, 30000, 0};
    std::vector<View> samples;
    Uniform uniform(102);
    for (int i = 0; i < 50; ++i) samples.push_back(view_from_above(uniform));
    OctreeOptions options = options_of(40, 30, 1.0, costs);
    options.sample_views = samples;
    const RhOctree with = build_octree(geometry.batches(), options).value();
    options.replica_budget = 0.0;
    const RhOctree without = build_octree(geometry.batches(), options).value();
    ASSERT_GT(with.replicas().size(), 0u);
    ASSERT_EQ(without.replicas().size(), 0u);
    DrawListSolver solver;
    DrawList list;
    double cost = 0.0, cost_without = 0.0;
    std::uint32_t drawn = 0;
    for (int i = 0; i < 100; ++i) {
        const View view = view_from_above(uniform);
        solver.solve(with, make_frustum(view), make_viewpoint(view), costs, list);
        cost += list.predicted_ns;
        drawn += list.replicas_drawn;
        const double with_ns = list.predicted_ns;
        solver.solve(without, make_frustum(view), make_viewpoint(view), costs, list);
        cost_without += list.predicted_ns;
        EXPECT_LE(with_ns, list.predicted_ns * (1.0 + 1e-12));
    }
    EXPECT_GE(drawn, 100u);
    EXPECT_LT(cost, 0.9 * cost_without);
}

TEST(DrawListSolver, a_mirrored_view_skips_nothing_for_facing_away) {
    const Balls balls(103, 3, 40, 200);
    const RhOctree octree = build_octree(balls.batches(), options_of(30, 0, 1.0, {1, 0, 0})).value();
    Uniform uniform(104);
    DrawListSolver solver;
    DrawList list;
    for (int i = 0; i < 20; ++i) {
        View view = random_view(uniform);
        view.clip_from_camera = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                           glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 0, 1)) *
                                view.clip_from_camera;
        const Frustum frustum = make_frustum(view);
        solver.solve(octree, frustum, make_viewpoint(view), {1, 0, 0}, list);
        std::uint64_t drawn = 0, in_view = 0;
        for (const DrawRange& range : list.ranges) drawn += range.index_count;
        for (const OctreePiece& piece : octree.pieces()) {
            PlaneMask mask = frustum.mask;
            if (classify(frustum, piece.bounds, mask) != Containment::Outside) in_view += piece.index_count;
        }
        EXPECT_EQ(drawn, in_view);
    }
}

TEST(DrawListSolver, an_empty_octree_and_a_view_of_nothing_give_no_range) {
    DrawListSolver solver;
    DrawList list;
    const View view{look_along({0, 0, 1000}, {0, 0, 1}, {0, 1, 0}),
                    perspective(1.0, 1.0, 1.0, 5000.0, ClipDepth::ZeroToOne), ClipDepth::ZeroToOne};
    const RhOctree octree = build_octree(Balls(105, 2, 5, 100).batches(), options_of(30, 0, 1.0)).value();
    for (const RhOctree* one : {&octree, static_cast<const RhOctree*>(nullptr)}) {
        solver.solve(one ? *one : RhOctree(), make_frustum(view), make_viewpoint(view), {1, 10, 100}, list);
        EXPECT_TRUE(list.ranges.empty());
        EXPECT_EQ(list.predicted_ns, 0.0);
    }
}

}  // namespace
}  // namespace rhview
