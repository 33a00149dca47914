// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/frustum/box_hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/allocations.h"
#include "random_boxes.h"

namespace rhview {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

struct Shape {
    HierarchySplit split;
    std::uint32_t width;
    std::uint32_t max_leaf_boxes;
};

class HierarchyOfEveryShape : public testing::TestWithParam<Shape> {
  protected:
    static HierarchyOptions options() {
        return {GetParam().split, GetParam().width, GetParam().max_leaf_boxes};
    }
};

/// The visible boxes by id, from the flat batch.
std::vector<bool> flat_answer(const Frustum& frustum, std::span<const Aabb> boxes) {
    std::vector<std::uint64_t> words(visibility_words(boxes.size()));
    cull_boxes(frustum, boxes, words);
    std::vector<bool> visible;
    for (std::size_t i = 0; i < boxes.size(); ++i) visible.push_back(words[i / 64] >> (i % 64) & 1u);
    return visible;
}

std::vector<bool> hierarchy_answer(const Frustum& frustum, const BoxHierarchy& tree) {
    std::vector<OrderRange> ranges;
    tree.cull(frustum, ranges);
    std::vector<bool> visible(tree.order().size());
    for (std::size_t r = 0; r < ranges.size(); ++r) {
        EXPECT_GT(ranges[r].count, 0u);
        if (r > 0) {
            EXPECT_GT(ranges[r].first, ranges[r - 1].first + ranges[r - 1].count) << "not merged";
        }
        for (std::uint32_t i = 0; i < ranges[r].count; ++i)
            visible[index_of(tree.order()[ranges[r].first + i])] = true;
    }
    return visible;
}

void expect_sound(const BoxHierarchy& tree, const HierarchyOptions& options, std::size_t count) {
    const std::span<const HierarchyNode> nodes = tree.nodes();
    std::vector<int> seen(count);
    for (const ObjectId id : tree.order()) ++seen.at(index_of(id));
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(count));
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        const HierarchyNode& node = nodes[i];
        ASSERT_LT(node.depth, 64u);
        if (node.escape == i + 1) {
            EXPECT_LE(node.count, options.max_leaf_boxes);
            EXPECT_GE(node.count, 1u);
            continue;
        }
        std::uint32_t children = 0, first = node.first;
        for (std::uint32_t child = i + 1; child < node.escape; child = nodes[child].escape) {
            EXPECT_EQ(nodes[child].first, first);
            EXPECT_EQ(nodes[child].depth, node.depth + 1);
            first += nodes[child].count;
            ++children;
        }
        EXPECT_EQ(first, node.first + node.count);
        EXPECT_GE(children, 2u);
        EXPECT_LE(children, options.width);
    }
}

TEST_P(HierarchyOfEveryShape, shows_exactly_what_the_flat_batch_shows_also_after_boxes_moved) {
    Uniform uniform(1);
    for (const double offset : {0.0, 1e7}) {
        const glm::dvec3 middle(offset);
        std::vector<Aabb> boxes = random_boxes(uniform, 3000, middle, 100.0, 0.01, 10.0);
        BoxHierarchy tree(boxes, options());
        expect_sound(tree, options(), boxes.size());
        std::size_t shown = 0, total = 0;
        for (int v = 0; v < 40; ++v) {
            if (v == 20) {
                for (std::size_t i = 0; i < boxes.size(); i += 3) {
                    const glm::vec3 way(uniform.point(40.0));
                    boxes[i] = {boxes[i].min + way, boxes[i].max + way};
                }
                tree.refit(boxes);
            }
            const View view =
                random_view(uniform, middle + uniform.point(100.0), static_cast<ClipDepth>(v % 3));
            const Frustum frustum = make_frustum(view);
            const std::vector<bool> visible = hierarchy_answer(frustum, tree);
            ASSERT_EQ(visible, flat_answer(frustum, boxes)) << "view " << v;
            shown += static_cast<std::size_t>(std::count(visible.begin(), visible.end(), true));
            total += boxes.size();
        }
        EXPECT_GT(shown, total / 20);
        EXPECT_LT(shown, total * 19 / 20);
    }
}

TEST_P(HierarchyOfEveryShape, holds_boxes_without_a_number_without_an_end_inverted_and_all_in_one_place) {
    Uniform uniform(2);
    std::vector<Aabb> boxes = random_boxes(uniform, 300, glm::dvec3(0.0), 50.0, 0.1, 5.0);
    for (const float odd : {kNan, kInf, -kInf})
        for (int axis = 0; axis < 3; ++axis) {
            boxes.push_back({glm::vec3(30), glm::vec3(31)});
            boxes.back().min[axis] = odd;
            boxes.push_back({glm::vec3(30), glm::vec3(31)});
            boxes.back().max[axis] = odd;
        }
    boxes.push_back({});
    boxes.push_back({glm::vec3(5), glm::vec3(-5)});
    boxes.insert(boxes.end(), 200, Aabb{glm::vec3(7), glm::vec3(7)});
    const BoxHierarchy tree(boxes, options());
    expect_sound(tree, options(), boxes.size());
    for (int v = 0; v < 60; ++v) {
        const Frustum frustum =
            make_frustum(random_view(uniform, uniform.point(60.0), static_cast<ClipDepth>(v % 3)));
        ASSERT_EQ(hierarchy_answer(frustum, tree), flat_answer(frustum, boxes));
    }
}

TEST_P(HierarchyOfEveryShape, of_no_box_shows_none_and_of_one_box_that_box) {
    const BoxHierarchy none({}, options());
    std::vector<OrderRange> ranges{{1, 2}};
    const View view{glm::dmat4(1.0), perspective(1.0, 1.0, 1.0, 100.0, ClipDepth::ZeroToOne),
                    ClipDepth::ZeroToOne};
    EXPECT_EQ(none.cull(make_frustum(view), ranges).nodes, 0u);
    EXPECT_TRUE(ranges.empty());
    const std::vector<Aabb> boxes{{glm::vec3(-1, -1, -11), glm::vec3(1, 1, -9)}};
    const BoxHierarchy one(boxes, options());
    one.cull(make_frustum(view), ranges);
    EXPECT_EQ(ranges, (std::vector<OrderRange>{{0, 1}}));
}

TEST_P(HierarchyOfEveryShape, gives_a_scene_that_is_all_inside_as_one_range_after_one_test) {
    Uniform uniform(4);
    const BoxHierarchy tree(random_boxes(uniform, 2000, glm::dvec3(0, 0, -500), 50.0, 0.1, 5.0), options());
    const View view{glm::dmat4(1.0), perspective(1.0, 1.0, 1.0, 1000.0, ClipDepth::ZeroToOne),
                    ClipDepth::ZeroToOne};
    std::vector<OrderRange> ranges;
    EXPECT_EQ(tree.cull(make_frustum(view), ranges).nodes, 1u);
    EXPECT_EQ(ranges, (std::vector<OrderRange>{{0, 2000}}));
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, HierarchyOfEveryShape,
    testing::Values(Shape{HierarchySplit::Mean, 2, 1}, Shape{HierarchySplit::Mean, 4, 8},
                    Shape{HierarchySplit::Mean, 8, 64}, Shape{HierarchySplit::Median, 2, 16},
                    Shape{HierarchySplit::Median, 4, 64}, Shape{HierarchySplit::Median, 8, 3},
                    Shape{HierarchySplit::SurfaceArea, 2, 32}, Shape{HierarchySplit::SurfaceArea, 4, 1},
                    Shape{HierarchySplit::SurfaceArea, 8, 17}));

TEST(BoxHierarchy, a_warm_culling_allocates_nothing) {
    Uniform uniform(9);
    const std::vector<Aabb> boxes = random_boxes(uniform, 3000, glm::dvec3(0.0), 100.0, 0.1, 10.0);
    BoxHierarchy tree(boxes);
    const BoxArrays arrays(boxes);
    std::vector<std::uint64_t> words(visibility_words(boxes.size()));
    std::vector<OrderRange> ranges(boxes.size());
    const Frustum frustum = make_frustum(random_view(uniform, glm::dvec3(0.0), ClipDepth::ZeroToOne));
    const long before = allocations();
    tree.cull(frustum, ranges);
    tree.refit(boxes);
    cull_boxes(frustum, arrays.spans(), words);
    EXPECT_EQ(allocations(), before);
}

TEST(BoxHierarchy, after_boxes_moved_its_nodes_are_as_tight_as_their_boxes) {
    Uniform uniform(10);
    std::vector<Aabb> boxes = random_boxes(uniform, 1000, glm::dvec3(0.0), 100.0, 0.1, 10.0);
    BoxHierarchy tree(boxes);
    const auto expect_tight = [&](const char* when) {
        for (const HierarchyNode& node : tree.nodes()) {
            Aabb bounds;
            for (const ObjectId id : tree.order().subspan(node.first, node.count))
                bounds.grow(boxes[index_of(id)]);
            ASSERT_EQ(node.bounds.min, bounds.min) << when;
            ASSERT_EQ(node.bounds.max, bounds.max) << when;
        }
    };
    expect_tight("made");
    const std::vector<Aabb> before = boxes;
    for (const std::size_t stride : {1000u, 300u, 31u, 1u}) {
        for (std::size_t i = stride == 1000u ? 999 : 0; i < boxes.size(); i += stride) {
            const glm::vec3 way(uniform.point(40.0));
            boxes[i] = {boxes[i].min + way, boxes[i].max + way};
        }
        tree.refit(boxes);
        expect_tight("moved");
        tree.refit(boxes);
        expect_tight("stood still");
    }
    for (const std::size_t i : {5u, 700u}) boxes[i].min.y = std::numeric_limits<float>::quiet_NaN();
    tree.refit(boxes);
    tree.refit(boxes);
    EXPECT_EQ(tree.nodes()[0].bounds.max.x, std::numeric_limits<float>::infinity());
    boxes = before;
    tree.refit(boxes);
    expect_tight("back");
}

TEST(BoxHierarchy, of_boxes_in_a_geometric_row_is_not_deeper_than_its_bound) {
    // Each mean leaves one box on the far side: a tree by means alone would be as deep as there are boxes.
    std::vector<Aabb> boxes;
    for (int i = 0; i < 250; ++i) {
        const float x = std::ldexp(1.0f, i - 125);
        boxes.push_back({glm::vec3(x, 0, 0), glm::vec3(x, 0, 0)});
    }
    const HierarchyOptions options{HierarchySplit::Mean, 2, 1};
    expect_sound(BoxHierarchy(boxes, options), options, boxes.size());
}

}  // namespace
}  // namespace rhview
