// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Drawing and asking in turns on real pixels: the rivals miss none, and what is counted is what an executor
// counts.

#include "rhview/gl/stepped_executor.h"

#include <epoxy/gl.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "gl_fixture.h"
#include "query_scene.h"
#include "rhview/baselines/chc.h"
#include "rhview/baselines/chc_plus_plus.h"
#include "rhview/baselines/draw_everything.h"
#include "rhview/baselines/nested_grid.h"

namespace rhview::gl {
namespace {

/// Cells of all sizes with common faces, and objects and instances among them: turned, mirrored, squashed.
CellScene crowded(const glm::dvec3& origin) {
    CellScene made = CellMaker(71).make(500, 20.0, origin);
    SceneBuilder builder(origin);
    const glm::dmat4 to_world = glm::translate(glm::dmat4(1.0), origin);
    const MaterialId material = builder.add_material({"three", glm::vec3(0.8f), true, false});
    const MeshId mesh = builder.add_mesh(material, triangle_piece()).value();
    Uniform uniform(72);
    for (int i = 0; i < 40; ++i) {
        glm::dmat4 place = glm::translate(to_world, uniform.point(20));
        place = glm::rotate(place, uniform(0, 6), glm::dvec3(0.3, 1, 0.2));
        place = glm::scale(place, glm::dvec3(i % 2 ? -0.7 : 0.7, uniform(0.1, 1), 0.5));
        if (i % 3 == 0)
            EXPECT_TRUE(builder.add_instance(mesh, place));
        else
            builder.add_dynamic(mesh, place);
    }
    Scene placed = builder.finish("crowded").value();
    made.scene.materials.insert(made.scene.materials.end(), placed.materials.begin(), placed.materials.end());
    for (SceneMesh& mesh_of : placed.meshes) {
        mesh_of.pool += static_cast<std::uint32_t>(made.scene.pools.size());
        mesh_of.material = MaterialId{static_cast<std::uint32_t>(made.scene.materials.size() - 1)};
    }
    made.scene.pools.insert(made.scene.pools.end(), placed.pools.begin(), placed.pools.end());
    made.scene.meshes = placed.meshes;
    made.scene.dynamic_objects = placed.dynamic_objects;
    made.scene.static_instances = placed.static_instances;
    return made;
}

struct Rival {
    std::unique_ptr<InteractiveMethod> method;
    SceneBuffers buffers;
};

std::vector<StaticObject> objects_of(const CellScene& cells) {
    std::vector<StaticObject> objects;
    for (const Cell& cell : cells.cells) objects.push_back({cell.range, cell.bounds});
    return objects;
}

std::vector<Rival> every_rival(const CellScene& cells) {
    std::vector<Rival> rivals;
    const std::vector<TriangleBatch> batches = cells.scene.triangle_batches();
    const auto add = [&](std::unique_ptr<InteractiveMethod> method, std::span<const std::uint32_t> indices) {
        rivals.push_back({std::move(method), SceneBuffers::upload(cells.scene, indices).value()});
    };
    for (const VisibleQuery way : {VisibleQuery::Geometry, VisibleQuery::Box}) {
        ChcPlusPlusOptions options;
        options.visible_query = way;
        options.visible_frames = 3;
        OrderedTree objects = make_object_tree(objects_of(cells), batches, 20);
        add(std::make_unique<ChcPlusPlus>(objects.tree, options), objects.indices);
        const RhOctree octree = build_octree(batches, {40}).value();
        const auto base = octree.indices().first(octree.base_index_count());
        add(std::make_unique<ChcPlusPlus>(CullTree::of_octree(octree), options), base);
        if (way == VisibleQuery::Box) continue;
        add(std::make_unique<Chc>(objects.tree), objects.indices);
        add(std::make_unique<Chc>(CullTree::of_octree(octree)), base);
    }
    OrderedTree grid = make_nested_grid(batches, {3, 4, 3, 20});
    add(std::make_unique<StopAndWait>(std::move(grid.tree)), grid.indices);
    return rivals;
}

class Stepped : public GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        stepped_.emplace(SteppedExecutor::create(*executor_).value());
    }
    void TearDown() override {
        stepped_.reset();
        GlTest::TearDown();
    }

    std::vector<float> draw(Rival& rival, const FrameInput& input, const DrawOptions& options = {}) {
        target_->begin(input.culling_view.clip_depth, glm::vec3(0.0f));
        stepped_->begin(rival.buffers, input.culling_view, options);
        rival.method->draw(input, *stepped_, drawn_);
        stepped_counters_ = stepped_->end();
        std::vector<float> depths;
        target_->read_depth(depths);
        return depths;
    }

    std::optional<SteppedExecutor> stepped_;
    DrawnFrame drawn_;
    FrameCounters stepped_counters_;
};

struct SteppedCase {
    ClipDepth depth;
    double offset;
    double far;
};

class SteppedOracle : public Stepped, public testing::WithParamInterface<SteppedCase> {};

TEST_P(SteppedOracle, rivals_miss_no_pixel_on_a_walk_with_jumps) {
    const auto [depth, offset, far] = GetParam();
    const glm::dvec3 origin(offset, -offset, 2.0 * offset);
    const CellScene cells = crowded(origin);
    const std::vector<Aabb> boxes = cells.scene.object_boxes();
    ASSERT_EQ(boxes.size(), 40u);
    std::vector<std::uint32_t> counts;
    for (const SceneBatch& batch : cells.scene.batches)
        counts.push_back(static_cast<std::uint32_t>(batch.indices.size()));
    DrawEverything reference(counts, cells.scene.bounds());
    std::vector<Rival> rivals = every_rival(cells);
    Uniform uniform(73);
    FramePlan everything;
    std::uint64_t drawn_indices = 0, all_indices = 0, hidden = 0;
    glm::dvec3 eye(0.0), forward(0.0, 0.0, -1.0);
    for (int i = 0; i < 24; ++i) {
        if (i % 8 == 0) eye = uniform.point(18);
        if (i % 8 == 0) forward = {uniform(-1, 1), uniform(-0.4, 0.4), uniform(-1, 1)};
        eye += 0.3 * glm::normalize(forward);
        forward += uniform.point(0.1);
        const FrameInput input{view_at(origin + eye, forward, depth, far), cells.scene.origin, boxes};
        reference.plan(input, everything);
        for (std::size_t r = 0; r < rivals.size(); ++r) {
            const std::vector<float> culled = draw(rivals[r], input);
            drawn_indices += stepped_counters_.indices;
            hidden += drawn_.hidden_queries;
            const std::vector<float> whole = depths_of(everything, rivals[r].buffers, input.culling_view);
            all_indices += counters_.indices;
            ASSERT_EQ(count_missing_pixels(culled, whole), 0u) << "view " << i << ", rival " << r;
        }
    }
    EXPECT_LT(drawn_indices, all_indices / 2);
    EXPECT_GT(hidden, 24u * rivals.size());
}

INSTANTIATE_TEST_SUITE_P(Views, SteppedOracle,
                         testing::Values(SteppedCase{ClipDepth::NegativeOneToOne, 0.0, 1000.0},
                                         SteppedCase{ClipDepth::ZeroToOne, 0.0, 30.0},
                                         SteppedCase{ClipDepth::ReversedZeroToOne, 0.0, 1000.0},
                                         SteppedCase{ClipDepth::ReversedZeroToOne, 1e6,
                                                     std::numeric_limits<double>::infinity()}));

TEST_F(Stepped, counts_what_the_executor_counts_of_the_recorded_plan) {
    const CellScene cells = crowded(glm::dvec3(0.0));
    const std::vector<Aabb> boxes = cells.scene.object_boxes();
    std::vector<Rival> rivals = every_rival(cells);
    const FrameInput input{view_at({0, 0, 25}, {0, 0, -1}), glm::dvec3(0.0), boxes};
    std::uint64_t plain_calls = 0, multi_calls = 0;
    for (const Submission submission : {Submission::Plain, Submission::MultiDraw}) {
        for (Rival& rival : rivals) {
            const std::vector<float> stepped = draw(rival, input, {submission, {}, nullptr});
            const FrameCounters& counted = stepped_counters_;
            EXPECT_EQ(counted.queries, drawn_.plan.queries.size() + drawn_.geometry_queries);
            EXPECT_EQ(counted.query_boxes, drawn_.plan.query_boxes.size());
            EXPECT_EQ(counted.query_draw_calls, drawn_.plan.queries.size());
            FramePlan plan = drawn_.plan;
            plan.queries.clear();
            EXPECT_EQ(depths_of(plan, rival.buffers, input.culling_view), stepped);
            // One after the other, objects of several steps share a call that had one each.
            const std::uint64_t objects = plan.objects.size();
            EXPECT_EQ(counted.instances, objects);
            EXPECT_EQ(counters_.instances, objects);
            EXPECT_GE(counted.sub_draws, counters_.sub_draws);
            EXPECT_LE(counted.sub_draws, counters_.sub_draws + objects);
            EXPECT_EQ(counted.indices, counters_.indices);
            if (submission == Submission::Plain)
                EXPECT_EQ(counted.draw_calls, counted.sub_draws);
            else
                EXPECT_LE(counted.draw_calls, counted.sub_draws);
            (submission == Submission::Plain ? plain_calls : multi_calls) += counted.draw_calls;
            EXPECT_GE(counted.material_changes, counters_.material_changes);
        }
    }
    EXPECT_LT(multi_calls, plain_calls);
}

TEST_F(Stepped, draws_are_counted_like_the_executors_and_answers_when_they_were_waited_for) {
    SceneBuilder builder;
    const MaterialId material = builder.add_material({"", glm::vec3(0.8f), true, false});
    builder.add_static(material, triangle_piece());
    builder.add_static(material, triangle_piece(), glm::translate(glm::dmat4(1.0), {0, 0, -5}));
    const Scene scene = builder.finish("two").value();
    const SceneBuffers buffers = SceneBuffers::upload(scene).value();
    const View view = view_at({0, 0, 0}, {0, 0, -1});
    target_->begin(view.clip_depth, glm::vec3(0.0f));
    stepped_->begin(buffers, view);
    const std::array near{DrawRange{BatchId{0}, 0, 3}}, far{DrawRange{BatchId{0}, 3, 3}};
    const QueryHandle near_seen = stepped_->draw_and_ask(near, {});
    const std::array boxes{Aabb{{-0.1f, -0.1f, -9}, {0.1f, 0.1f, -8}},
                           Aabb{{-0.1f, -0.1f, -4}, {0.1f, 0.1f, -3}}, Aabb{{3, -0.1f, -9}, {3.1f, 0.1f, -8}},
                           Aabb{{-1, -1, -1}, {1, 1, 1}}};
    std::vector<QueryHandle> handles;
    // Behind it; before it; behind it and beside it; around the eye.
    const std::array queries{BoxQuery{0, 1}, BoxQuery{1, 1}, BoxQuery{0, 1}, BoxQuery{2, 1}, BoxQuery{3, 1}};
    stepped_->ask(queries, boxes, handles);
    const std::array both{BoxQuery{0, 3}};
    stepped_->ask(both, boxes, handles);
    // Smaller than the first, and behind it.
    const QueryHandle far_seen = stepped_->draw_and_ask(far, {});
    finish();
    EXPECT_TRUE(stepped_->has_answer(near_seen));
    EXPECT_TRUE(stepped_->take_answer(near_seen));
    std::vector<bool> seen;
    for (const QueryHandle handle : handles) seen.push_back(stepped_->take_answer(handle));
    EXPECT_EQ(seen, (std::vector<bool>{false, true, false, true, true, true}));
    EXPECT_FALSE(stepped_->take_answer(far_seen));
    EXPECT_EQ(stepped_->answer_counters().blocking_reads, 0u);
    EXPECT_EQ(stepped_->answer_counters().asked, 8u);
    EXPECT_EQ(stepped_->answer_counters().answered, 8u);
    EXPECT_GT(stepped_->device_ms(), 0.0);
    const FrameCounters counters = stepped_->end();
    EXPECT_EQ(counters.draw_calls, 2u);
    EXPECT_EQ(counters.indices, 6u);
    EXPECT_EQ(counters.material_changes, 2u);
    EXPECT_EQ(counters.queries, 8u);
    EXPECT_EQ(counters.query_boxes, 8u);
    EXPECT_EQ(counters.query_draw_calls, 6u);
}

TEST_F(Stepped, state_of_the_application_is_put_back) {
    const CellScene cells = crowded(glm::dvec3(0.0));
    const std::vector<Aabb> boxes = cells.scene.object_boxes();
    std::vector<Rival> rivals = every_rival(cells);
    const FrameInput input{view_at({0, 0, 25}, {0, 0, -1}), glm::dvec3(0.0), boxes};
    target_->begin(input.culling_view.clip_depth, glm::vec3(0.0f));
    for (const bool on : {false, true}) {
        const auto set = [on](GLenum name) { on ? glEnable(name) : glDisable(name); };
        const std::array switches{GL_CULL_FACE, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_DEPTH_CLAMP};
        for (const GLenum name : switches) set(name);
        glDepthMask(on ? GL_TRUE : GL_FALSE);
        glColorMask(GL_TRUE, on, GL_FALSE, on);
        glDepthFunc(on ? GL_GREATER : GL_ALWAYS);
        for (Rival& rival : rivals) {
            stepped_->begin(rival.buffers, input.culling_view);
            rival.method->draw(input, *stepped_, drawn_);
            stepped_->end();
            for (const GLenum name : switches) EXPECT_EQ(glIsEnabled(name) == GL_TRUE, on) << name;
            GLboolean depth_mask = GL_FALSE, mask[4] = {};
            glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask);
            glGetBooleanv(GL_COLOR_WRITEMASK, mask);
            EXPECT_EQ(depth_mask == GL_TRUE, on);
            EXPECT_EQ(mask[0], GL_TRUE);
            EXPECT_EQ(mask[1] == GL_TRUE, on);
            EXPECT_EQ(mask[2], GL_FALSE);
            GLint value = 0;
            glGetIntegerv(GL_DEPTH_FUNC, &value);
            EXPECT_EQ(value, on ? GL_GREATER : GL_ALWAYS);
            for (const GLenum name : {GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING, GL_ARRAY_BUFFER_BINDING}) {
                glGetIntegerv(name, &value);
                EXPECT_EQ(value, 0);
            }
        }
    }
    glDisable(GL_STENCIL_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
}

TEST_F(Stepped, queries_and_box_storage_are_used_again) {
    const CellScene cells = crowded(glm::dvec3(0.0));
    const std::vector<Aabb> boxes = cells.scene.object_boxes();
    std::vector<Rival> rivals = every_rival(cells);
    const FrameInput input{view_at({0, 0, 25}, {0, 0, -1}), glm::dvec3(0.0), boxes};
    std::uint64_t asked = 0;
    std::vector<float> first;
    for (int frame = 0; frame < 60; ++frame) {
        const std::vector<float> depths = draw(rivals.back(), input);
        if (frame == 0) first = depths;
        ASSERT_EQ(depths, first);
        asked += stepped_counters_.queries;
    }
    EXPECT_EQ(stepped_->answer_counters().asked, asked);
    EXPECT_EQ(stepped_->answer_counters().answered, asked);
    EXPECT_GT(asked, 4096u) << "more boxes than the storage holds at once";
}

}  // namespace
}  // namespace rhview::gl
