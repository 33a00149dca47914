// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Objects of one mesh, level and mirroring in one call: what is counted, and that the depths are those of
// each object drawn alone, bit for bit.

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "occlusion_fixture.h"
#include "random_geometry.h"
#include "rhview/gl/item_buffer.h"
#include "rhview/gl/stepped_executor.h"
#include "rhview/scenes/object_motion.h"
#include "uniform.h"

namespace rhview::gl {
namespace {

constexpr std::uint32_t kObjects = 60;
constexpr std::uint32_t kFullIndices = 300, kCoarseIndices = 90;

glm::dmat4 random_placement(Uniform& uniform, std::uint32_t i, const glm::dvec3& origin) {
    glm::dmat4 place = glm::translate(
        glm::dmat4(1.0), origin + glm::dvec3(uniform(-12, 12), uniform(-9, 9), uniform(-60, -8)));
    place = glm::rotate(place, uniform(0, 6), glm::dvec3(0.3, 1, 0.2));
    return glm::scale(place, glm::dvec3(i % 2 ? -0.6 : 0.6, uniform(0.2, 1.0), 0.6));
}

/// Two meshes, every other object mirrored; a coarser level for one of them.
struct Instances {
    explicit Instances(const glm::dvec3& origin)
        : geometry(51, 2, 400, 20.0f), scene(build(origin)), groups(object_groups(scene)) {
        coarse.assign(geometry.indices[0].begin() + 150, geometry.indices[0].begin() + 150 + kCoarseIndices);
        // The pool's own numbering: `add_mesh` stores vertices in order of first use.
        for (std::size_t i = 0; i < kCoarseIndices; ++i) coarse[i] = scene.meshes[0].indices[150 + i];
        levels = {{coarse, {&level, 1}}};
        buffers.emplace(SceneBuffers::upload(scene, {}, levels).value());
    }

    Scene build(const glm::dvec3& origin) {
        SceneBuilder builder(origin);
        const MaterialId material = builder.add_material({});
        const MaterialId two_sided = builder.add_material({"", glm::vec3(0.5f), true, false});
        const auto piece = [&](std::size_t b) {
            return MeshPiece{geometry.positions, {}, {}, std::span(geometry.indices[b]).first(kFullIndices)};
        };
        const MeshId meshes[2]{*builder.add_mesh(material, piece(0)), *builder.add_mesh(two_sided, piece(1))};
        Uniform uniform(52);
        for (std::uint32_t i = 0; i < kObjects; ++i)
            builder.add_dynamic(meshes[i % 3 == 0 ? 1 : 0], random_placement(uniform, i, origin));
        return builder.finish("instances").value();
    }

    /// All objects; of the first mesh every fourth is coarse.
    [[nodiscard]] FramePlan plan() const {
        FramePlan plan;
        for (std::uint32_t i = 0; i < kObjects; ++i) {
            plan.objects.push_back(ObjectId{i});
            plan.object_levels.push_back(groups[i] < 2 && i % 4 == 0 ? 1 : 0);
        }
        return plan;
    }

    RandomGeometry geometry;
    Scene scene;
    std::vector<std::uint32_t> groups;
    std::vector<std::uint32_t> coarse;
    LevelRange level{0, kCoarseIndices};
    std::vector<MeshLevels> levels;
    std::optional<SceneBuffers> buffers;
};

class Instancing : public OcclusionTest, public testing::WithParamInterface<double> {
  protected:
    void SetUp() override {
        OcclusionTest::SetUp();
        origin_ = GetParam() * glm::dvec3(1.0, -1.0, 2.0);
        view_ = view_at(origin_, {0, 0, -1}, ClipDepth::ReversedZeroToOne);
    }

    glm::dvec3 origin_{0.0};
    View view_;
};

TEST_P(Instancing, one_call_for_each_mesh_level_and_mirroring_counts_all_its_indices) {
    const Instances made(origin_);
    FramePlan plan = made.plan();
    ObjectSorter().sort(made.groups, plan);
    depths_of(plan, *made.buffers, view_);
    std::uint64_t indices = 0;
    for (const std::uint8_t level : plan.object_levels) indices += level == 0 ? kFullIndices : kCoarseIndices;
    // Two meshes, mirrored or not; coarse ones have even numbers: none is mirrored.
    EXPECT_EQ(counters_.draw_calls, 5u);
    EXPECT_EQ(counters_.sub_draws, 5u);
    EXPECT_EQ(counters_.instances, kObjects);
    EXPECT_EQ(counters_.indices, indices);
}

TEST_P(Instancing, depths_are_those_of_each_object_drawn_alone) {
    const Instances made(origin_);
    FramePlan plan = made.plan();
    ObjectSorter().sort(made.groups, plan);
    const std::vector<float> together = depths_of(plan, *made.buffers, view_);
    std::vector<float> nearest(together.size(), 0.0f);
    for (std::size_t i = 0; i < plan.objects.size(); ++i) {
        FramePlan one;
        one.objects = {plan.objects[i]};
        one.object_levels = {plan.object_levels[i]};
        const std::vector<float> alone = depths_of(one, *made.buffers, view_);
        EXPECT_EQ(counters_.draw_calls, 1u);
        for (std::size_t p = 0; p < alone.size(); ++p) nearest[p] = std::max(nearest[p], alone[p]);
    }
    EXPECT_EQ(count_missing_pixels(together, nearest), 0u);
    EXPECT_GT(covered_pixels(together, ClipDepth::ReversedZeroToOne), 1000u);
}

TEST_P(Instancing, a_level_draws_its_own_indices) {
    const Instances made(origin_);
    FramePlan fine = made.plan(), coarse = fine;
    fine.object_levels.clear();
    const std::vector<float> whole = depths_of(fine, *made.buffers, view_);
    const std::vector<float> reduced = depths_of(coarse, *made.buffers, view_);
    EXPECT_GT(count_missing_pixels(reduced, whole), 0u);
    // The same triangles as a mesh of their own.
    SceneBuilder builder(origin_);
    const MaterialId material = builder.add_material({});
    const MeshId part =
        *builder.add_mesh(material, {made.scene.pools[0].positions.span(), {}, {}, made.coarse});
    Uniform uniform(52);
    builder.add_dynamic(part, random_placement(uniform, 0, origin_));
    const Scene other = builder.finish("part").value();
    const SceneBuffers other_buffers = SceneBuffers::upload(other).value();
    // An object of the first mesh, put where the part stands.
    std::vector<glm::dmat4> placements;
    for (std::uint32_t i = 0; i < kObjects; ++i) placements.push_back(other.object_placement(ObjectId{0}));
    FramePlan one, same;
    one.objects = {ObjectId{4}};
    one.object_levels = {1};
    same.objects = {ObjectId{0}};
    DrawOptions options;
    options.placements = placements;
    const std::vector<float> level = depths_of(one, *made.buffers, view_, options);
    EXPECT_EQ(level, depths_of(same, other_buffers, view_));
    EXPECT_GT(covered_pixels(level, ClipDepth::ReversedZeroToOne), 20u);
}

TEST_P(Instancing, what_draws_as_it_finds_draws_the_levels_that_a_plan_would) {
    const Instances made(origin_);
    FramePlan plan = made.plan();
    const std::vector<float> planned = depths_of(plan, *made.buffers, view_);
    SteppedExecutor stepped = SteppedExecutor::create(*executor_).value();
    DrawOptions options;
    options.object_levels = plan.object_levels;
    target_->begin(view_.clip_depth, glm::vec3(0.0f));
    stepped.begin(*made.buffers, view_, options);
    stepped.draw({}, plan.objects);
    const FrameCounters counters = stepped.end();
    std::vector<float> drawn;
    target_->read_depth(drawn);
    EXPECT_EQ(drawn, planned);
    EXPECT_EQ(counters.indices, counters_.indices);
    EXPECT_EQ(counters.instances, kObjects);
    // By mesh and level; mirrored ones stand between those that are not.
    EXPECT_LT(counters.draw_calls, counters_.draw_calls);
}

TEST_P(Instancing, an_item_buffer_sees_objects_at_their_levels) {
    const Instances made(origin_);
    const FramePlan plan = made.plan();
    const std::vector<float> depths = depths_of(plan, *made.buffers, view_);
    ItemBuffer items = ItemBuffer::create(target_->width(), target_->height()).value();
    const auto seen = items.item_pixels({}, 0, *made.buffers, view_, {}, plan.object_levels);
    std::size_t differ = 0, of_coarse = 0;
    for (std::size_t p = 0; p < depths.size(); ++p) {
        differ += (seen[p] != ItemBuffer::kNoItem) != (depths[p] != 0.0f);
        of_coarse += seen[p] != ItemBuffer::kNoItem && plan.object_levels[seen[p]] == 1;
    }
    EXPECT_EQ(differ, 0u);
    EXPECT_GT(of_coarse, 20u);
    const auto whole = items.item_pixels({}, 0, *made.buffers, view_);
    std::size_t of_whole = 0;
    for (const std::uint32_t item : whole)
        of_whole += item != ItemBuffer::kNoItem && plan.object_levels[item] == 1;
    EXPECT_GT(of_whole, of_coarse);
}

TEST_P(Instancing, objects_are_drawn_where_the_frame_places_them) {
    const Instances made(origin_);
    Uniform uniform(77);
    Scene moved = made.scene;
    std::vector<glm::dmat4> placements;
    for (std::uint32_t i = 0; i < kObjects; ++i) {
        // Mirroring may change with the frame too.
        placements.push_back(random_placement(uniform, i + 1, glm::dvec3(0.0)));
        moved.dynamic_objects[i].scene_from_mesh = placements.back();
    }
    const SceneBuffers moved_buffers = SceneBuffers::upload(moved, {}, made.levels).value();
    const FramePlan plan = made.plan();
    DrawOptions options;
    options.placements = placements;
    const std::vector<float> depths = depths_of(plan, *made.buffers, view_, options);
    EXPECT_EQ(depths, depths_of(plan, moved_buffers, view_));
    EXPECT_NE(depths, depths_of(plan, *made.buffers, view_));
}

TEST_P(Instancing, conditional_objects_share_calls_and_miss_no_pixel_either_way) {
    const Instances made(origin_);
    std::vector<glm::dmat4> placements;
    Uniform uniform(78);
    for (std::uint32_t i = 0; i < kObjects; ++i)
        placements.push_back(random_placement(uniform, i, glm::dvec3(0.0)));
    FramePlan all = made.plan();
    ObjectSorter().sort(made.groups, all);
    DrawOptions options;
    options.placements = placements;
    const std::vector<float> whole = depths_of(all, *made.buffers, view_, options);
    for (const Ways ways : kEveryWay) {
        // The first ten at once, the others in queries of five.
        FramePlan plan;
        for (std::size_t i = 0; i < all.objects.size(); ++i) {
            const std::uint32_t id = static_cast<std::uint32_t>(index_of(all.objects[i]));
            if (i < 10) {
                plan.objects.push_back(ObjectId{id});
                plan.object_levels.push_back(all.object_levels[i]);
                continue;
            }
            if (i % 5 == 0) {
                const bool box_pass = ways.box_pass && (!ways.hardware || i % 2 == 0);
                plan.queries.push_back({i, static_cast<std::uint32_t>(plan.query_boxes.size()), 0,
                                        box_pass ? QueryWay::BoxPass : QueryWay::HardwareQuery, false});
            }
            plan.query_boxes.push_back(transform_box(
                placements[id], made.scene.meshes[index_of(made.scene.object_mesh(ObjectId{id}))].bounds));
            ++plan.queries.back().box_count;
            plan.conditional_objects.push_back(
                {ObjectId{id}, static_cast<std::uint32_t>(plan.queries.size() - 1), all.object_levels[i]});
        }
        ObjectSorter().sort(made.groups, plan);
        const std::vector<float> depths = depths_of(plan, *made.buffers, view_, options);
        EXPECT_EQ(count_missing_pixels(depths, whole), 0u);
        EXPECT_EQ(counters_.conditional_instances, kObjects - 10u);
        if (!ways.hardware) {
            EXPECT_LE(counters_.conditional_draws, 4u);  // mesh and mirroring
        }
        EXPECT_LT(counters_.conditional_sub_draws, 25u);
        std::vector<QueryAnswer> list;
        for (const auto& [ticket, answer] : answers()) list.push_back(answer);
        const ExecutedDraws executed = count_executed(plan, *made.buffers, list, placements);
        EXPECT_EQ(executed.unknown_sub_draws, 0u);
        EXPECT_LE(executed.indices, counters_.conditional_indices);
        EXPECT_GT(executed.indices, 0u);
        for (QueryAnswer& answer : list) answer.visible = true;
        const ExecutedDraws seen = count_executed(plan, *made.buffers, list, placements);
        EXPECT_EQ(seen.sub_draws, counters_.conditional_sub_draws);
        EXPECT_EQ(seen.indices, counters_.conditional_indices);
    }
}

INSTANTIATE_TEST_SUITE_P(FromTheOrigin, Instancing, testing::Values(0.0, 1e7));

TEST_F(GlTest, mirrored_instances_keep_their_front_faces) {
    SceneBuilder builder;
    const MeshId mesh = *builder.add_mesh(builder.add_material({}), triangle_piece());
    const glm::dmat4 mirrored = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
    const glm::dmat4 turned = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -10)),
                                          3.14159265358979, glm::dvec3(0, 1, 0));
    for (const glm::dmat4& place : {glm::dmat4(1.0), mirrored, turned, turned * mirrored})
        builder.add_dynamic(mesh, place);
    const SceneBuffers buffers = SceneBuffers::upload(builder.finish("mirrored").value()).value();
    std::vector<std::size_t> covered;
    for (std::uint32_t i = 0; i < 4; ++i) {
        FramePlan plan;
        plan.objects = {ObjectId{i}};
        covered.push_back(covered_pixels(depths_of(plan, buffers, view_at({0, 0, 0}, {0, 0, -1}))));
    }
    EXPECT_GT(covered[0], 500u);
    EXPECT_NEAR(static_cast<double>(covered[1]), static_cast<double>(covered[0]), 40.0);
    EXPECT_EQ(covered[2], 0u);
    EXPECT_EQ(covered[3], 0u);
}

}  // namespace
}  // namespace rhview::gl
