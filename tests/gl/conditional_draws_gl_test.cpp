// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Which conditional draws are drawn, what is counted, what comes back, and the cases that must never be
// called hidden.

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <utility>

#include "occlusion_fixture.h"

namespace rhview::gl {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A wall 10 m ahead of the origin, a triangle 5 m ahead, twice as an object: what hangs on a query is in
/// view whatever its box says, so that a picture tells whether it was drawn.
class Decisions : public OcclusionTest, public testing::WithParamInterface<Ways> {
  protected:
    void SetUp() override {
        OcclusionTest::SetUp();
        SceneBuilder builder;
        const MaterialId material = builder.add_material({"", glm::vec3(0.8f), true, false});
        builder.add_static(material, triangle_piece(), glm::scale(glm::dmat4(1.0), {20, 20, 2}));
        builder.add_static(material, triangle_piece(), glm::translate(glm::dmat4(1.0), {-2, 0, 0}));
        builder.add_static(material, triangle_piece(), glm::translate(glm::dmat4(1.0), {-2, 2, 0}));
        const MeshId mesh = builder.add_mesh(material, triangle_piece()).value();
        for (const double y : {0.0, -2.0})
            builder.add_dynamic(mesh, glm::translate(glm::dmat4(1.0), {2, y, 0}));
        scene_ = builder.finish("decisions").value();
        buffers_ = SceneBuffers::upload(*scene_).value();
    }

    QueryWay way(std::size_t query) const {
        if (GetParam().hardware && GetParam().box_pass)
            return query % 2 == 0 ? QueryWay::BoxPass : QueryWay::HardwareQuery;
        return GetParam().box_pass ? QueryWay::BoxPass : QueryWay::HardwareQuery;
    }

    /// The wall, and query after query with one of the ranges and objects each, in turn.
    FramePlan plan_of(const std::vector<Aabb>& boxes) const {
        FramePlan plan;
        plan.opaque = {{BatchId{0}, 0, 3}};
        plan.query_boxes = boxes;
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            plan.queries.push_back({70 + i, i, 1, way(i), false});
            if (i < 2) plan.conditional.push_back({{BatchId{0}, 3 + 3 * i, 3}, i});
            if (i >= 2 && i < 4) plan.conditional_objects.push_back({ObjectId{i - 2}, i});
        }
        return plan;
    }

    /// By number: whether the range or object is in the picture that was drawn last.
    std::vector<bool> drawn(const FramePlan& plan, const View& view, const DrawOptions& options = {}) {
        const std::vector<float> depths = depths_of(plan, *buffers_, view, options);
        std::vector<bool> result;
        for (const auto& [x, y] :
             {std::pair{80 - 44, 60}, {80 - 44, 60 + 44}, {80 + 44, 60}, {80 + 44, 60 - 44}}) {
            const float d = depths[static_cast<std::size_t>(y) * 160 + static_cast<std::size_t>(x)];
            result.push_back(std::abs(0.2 * 10.0 / 9.99 / (1.0 - d) / 2.0 - 5.0) < 1.0 && d < 0.985f);
        }
        return result;
    }

    std::optional<Scene> scene_;
    std::optional<SceneBuffers> buffers_;
};

const Aabb kHidden{{-1, -1, -14}, {1, 1, -12}};
const Aabb kSeen{{-1, -1, -9}, {1, 1, -8}};

/// Box i is seen where bit i is set.
std::pair<std::vector<Aabb>, std::vector<bool>> four_boxes(unsigned mask) {
    std::pair<std::vector<Aabb>, std::vector<bool>> four;
    for (unsigned i = 0; i < 4; ++i) {
        four.second.push_back((mask >> i & 1) != 0);
        four.first.push_back(four.second.back() ? kSeen : kHidden);
    }
    return four;
}

TEST_P(Decisions, a_draw_is_drawn_if_and_only_if_its_query_sees_something) {
    const View view = view_at({0, 0, 0}, {0, 0, -1});
    for (unsigned mask = 0; mask < 16; ++mask) {
        const auto [boxes, expected] = four_boxes(mask);
        const FramePlan plan = plan_of(boxes);
        EXPECT_EQ(drawn(plan, view), expected) << mask;
        EXPECT_EQ(counters_.draw_calls, 1u);
        EXPECT_EQ(counters_.indices, 3u);
        EXPECT_EQ(counters_.conditional_sub_draws, 4u);
        EXPECT_EQ(counters_.conditional_indices, 12u);
        EXPECT_EQ(counters_.queries, 4u);
        EXPECT_EQ(counters_.query_boxes, 4u);
        const auto known = answers();
        for (unsigned i = 0; i < 4; ++i) EXPECT_EQ(known.at(70 + i).visible, expected[i]);
    }
}

/// Objects that nobody places before they are asked for.
struct LatePlaces {
    explicit LatePlaces(const Scene& scene)
        : objects(scene.dynamic_objects), placements(objects.size(), elsewhere()) {}

    static glm::dmat4 elsewhere() { return glm::translate(glm::dmat4(1.0), {0, 0, 1e4}); }
    static void prepare(void* context, std::span<std::uint32_t> places) {
        auto& late = *static_cast<LatePlaces*>(context);
        ++late.calls;
        for (const std::uint32_t place : places) {
            late.named.push_back(place);
            late.placements[place] = late.objects[place].scene_from_mesh;
        }
        std::ranges::reverse(places);
    }

    std::span<const DynamicObject> objects;
    std::vector<glm::dmat4> placements;
    std::vector<std::uint32_t> named;
    int calls = 0;
};

TEST_P(Decisions, late_objects_are_placed_unless_found_hidden_and_drawn_if_and_only_if_seen) {
    const View view = view_at({0, 0, 0}, {0, 0, -1});
    std::uint64_t found = 0;
    for (unsigned mask = 0; mask < 16; ++mask) {
        const auto [boxes, expected] = four_boxes(mask);
        LatePlaces late(*scene_);
        DrawOptions options;
        options.placements = late.placements;
        options.late = {LatePlaces::prepare, &late};
        EXPECT_EQ(drawn(plan_of(boxes), view, options), expected) << mask;
        EXPECT_EQ(late.named.size() + counters_.found_hidden, 2u);
        EXPECT_EQ(late.calls, late.named.empty() ? 0 : 1);
        EXPECT_EQ(counters_.conditional_instances, late.named.size());
        EXPECT_EQ(counters_.conditional_sub_draws, 2 + late.named.size());
        for (const std::uint32_t place : {0u, 1u}) {
            EXPECT_LE(std::ranges::count(late.named, place), 1);
            if (expected[2 + place]) {
                EXPECT_EQ(std::ranges::count(late.named, place), 1);
            }
        }
        found += counters_.found_hidden;
        const auto known = answers();
        ASSERT_EQ(known.size(), 4u);
        for (unsigned i = 0; i < 4; ++i) EXPECT_EQ(known.at(70 + i).visible, expected[i]);
    }
    // A software renderer has answered once it has drawn what hangs on the first of the queries.
    EXPECT_EQ(found, 16u);
}

TEST_P(Decisions, of_late_objects_that_hang_alone_none_is_missing) {
    const View view = view_at({0, 0, 0}, {0, 0, -1});
    for (const bool seen : {false, true}) {
        LatePlaces late(*scene_);
        FramePlan plan = plan_of({kHidden, kHidden, seen ? kSeen : kHidden, kSeen});
        plan.conditional.clear();
        DrawOptions options;
        options.placements = late.placements;
        options.late = {LatePlaces::prepare, &late};
        EXPECT_EQ(drawn(plan, view, options), (std::vector<bool>{false, false, seen, true}));
        EXPECT_EQ(answers().size(), 4u);
    }
}

TEST_P(Decisions, executed_draws_are_counted_when_the_answers_are_known) {
    const FramePlan plan = plan_of({kSeen, kHidden, kSeen, kHidden});
    drawn(plan, view_at({0, 0, 0}, {0, 0, -1}));
    ExecutedDraws executed = count_executed(plan, *buffers_, {});
    EXPECT_EQ(executed.sub_draws, 0u);
    EXPECT_EQ(executed.unknown_sub_draws, 4u);
    EXPECT_EQ(executed.unknown_indices, 12u);
    std::vector<QueryAnswer> list{{3, true, 0}};
    finish();
    executor_->poll_answers(list);
    std::ranges::reverse(list);
    executed = count_executed(plan, *buffers_, list);
    EXPECT_EQ(executed.sub_draws, 2u);
    EXPECT_EQ(executed.indices, 6u);
    EXPECT_EQ(executed.unknown_sub_draws, 0u);
}

TEST_P(Decisions, calls_are_one_per_run_or_one_per_batch) {
    FramePlan plan = plan_of({kSeen, kHidden});
    plan.conditional[1].query = 0;
    depths_of(plan, *buffers_, view_at({0, 0, 0}, {0, 0, -1}),
              {.submission = Submission::MultiDraw, .colour = {}});
    EXPECT_EQ(counters_.conditional_draws, 1u);
    EXPECT_EQ(counters_.indirect_calls, way(0) == QueryWay::BoxPass ? 1u : 0u);
    EXPECT_EQ(counters_.conditional_sub_draws, 2u);
    EXPECT_EQ(counters_.query_draw_calls, way(0) == way(1) && way(0) == QueryWay::BoxPass ? 1u : 2u);
    answers();
}

TEST_P(Decisions, several_boxes_of_a_query_are_seen_if_one_of_them_is) {
    const View view = view_at({0, 0, 0}, {0, 0, -1});
    for (std::uint32_t seen = 0; seen < 4; ++seen) {
        FramePlan plan = plan_of({kHidden, kHidden, kHidden});
        plan.queries.resize(1);
        plan.conditional.resize(1);
        plan.conditional_objects.clear();
        plan.queries[0].box_count = 3;
        if (seen < 3) plan.query_boxes[seen] = kSeen;
        EXPECT_EQ(drawn(plan, view)[0], seen < 3);
        EXPECT_EQ(answers().at(70).visible, seen < 3);
    }
}

TEST_P(Decisions, what_cannot_be_tested_is_seen) {
    struct Case {
        const char* name;
        Aabb box;
    };
    const Case cases[] = {
        {"eye inside", {{-3, -3, -20}, {3, 3, 3}}},
        {"eye on a face", {{-3, -3, -3}, {3, 3, 0}}},
        {"crossing the near plane beside the view", {{50, -3, -30}, {60, 3, 30}}},
        {"crossing the near plane below it", {{-3, -9, -30}, {3, -8, -0.05f}}},
        {"between eye and near plane", {{-0.01f, -0.01f, -0.06f}, {0.01f, 0.01f, -0.05f}}},
        {"empty", {}},
        {"not a number", {{kNan, -1, -14}, {1, 1, -12}}},
        {"without end", {{-1, -1, -std::numeric_limits<float>::infinity()}, {1, 1, -12}}},
        {"behind", {{-1, -1, 12}, {1, 1, 14}}},
    };
    for (const auto& [name, box] : cases)
        for (const ClipDepth depth :
             {ClipDepth::NegativeOneToOne, ClipDepth::ZeroToOne, ClipDepth::ReversedZeroToOne}) {
            depths_of(plan_of({box, kHidden}), *buffers_, view_at({0, 0, 0}, {0, 0, -1}, depth));
            const auto known = answers();
            EXPECT_TRUE(known.at(70).visible) << name;
            EXPECT_FALSE(known.at(71).visible) << name;
        }
}

TEST_P(Decisions, flat_and_pointlike_boxes_are_seen_in_front_and_hidden_behind) {
    const View view = view_at({0, 0, 0}, {0, 0, -1});
    for (const float z : {-8.0f, -12.0f}) {
        // Where a line and a point lie on the sample of a pixel.
        const auto s = static_cast<float>(0.5 * -z * std::tan(0.5) / 60.0);
        const std::vector<Aabb> boxes{{{-1, -1, z}, {1, 1, z}},
                                      {{0.35f, -1, z - 1}, {0.35f, 1, z}},
                                      {{-1, s, z}, {1, s, z}},
                                      {{s, s, z}, {s, s, z}}};
        depths_of(plan_of(boxes), *buffers_, view);
        const auto known = answers();
        for (std::uint64_t i = 0; i < 4; ++i) EXPECT_EQ(known.at(70 + i).visible, z > -10.0f) << i;
    }
}

TEST_P(Decisions, an_orthographic_view_tests_along_its_direction) {
    View view = view_at({0, 0, 0}, {0, 0, -1});
    for (const ClipDepth depth : {ClipDepth::NegativeOneToOne, ClipDepth::ReversedZeroToOne}) {
        view.clip_depth = depth;
        view.clip_from_camera = orthographic(16.0, 12.0, 0.1, 100.0, depth);
        depths_of(plan_of({kSeen, kHidden, {{-1, -1, -10}, {1, 1, 2}}}), *buffers_, view);
        const auto known = answers();
        EXPECT_TRUE(known.at(70).visible);
        EXPECT_FALSE(known.at(71).visible);
        EXPECT_TRUE(known.at(72).visible);
    }
}

TEST_P(Decisions, interleaved_views_keep_their_answers_apart) {
    const View front = view_at({0, 0, 0}, {0, 0, -1}), back = view_at({0, 0, -25}, {0, 0, 1});
    std::map<std::uint64_t, QueryAnswer> known;
    for (std::uint64_t frame = 0; frame < 20; ++frame) {
        FramePlan plan = plan_of({kSeen, kHidden, kSeen, kHidden});
        for (PlannedQuery& query : plan.queries) query.ticket += 100 * frame;
        depths_of(plan, *buffers_, frame % 2 == 0 ? front : back);
        known.merge(answers());
    }
    ASSERT_EQ(known.size(), 80u);
    for (const auto& [ticket, answer] : known) {
        const bool from_behind = (ticket - 70) / 100 % 2 != 0;
        EXPECT_EQ(answer.visible, ((ticket - 70) % 100 % 2 == 0) != from_behind) << ticket;
    }
    EXPECT_EQ(executor_->answer_counters().asked, 80u);
    EXPECT_EQ(executor_->answer_counters().answered, 80u);
}

TEST_P(Decisions, no_query_or_fifty_thousand) {
    const View view = view_at({0, 0, 0}, {0, 0, -1});
    depths_of(FramePlan{}, *buffers_, view);
    EXPECT_EQ(counters_.queries + counters_.conditional_draws + counters_.query_draw_calls, 0u);
    EXPECT_TRUE(answers().empty());
    FramePlan plan = plan_of(std::vector<Aabb>(50'000, kHidden));
    for (std::size_t i = 0; i < plan.query_boxes.size(); i += 5) plan.query_boxes[i] = kSeen;
    depths_of(plan, *buffers_, view);
    EXPECT_EQ(counters_.queries, 50'000u);
    const auto known = answers();
    ASSERT_EQ(known.size(), 50'000u);
    for (const auto& [ticket, answer] : known) ASSERT_EQ(answer.visible, (ticket - 70) % 5 == 0) << ticket;
}

TEST_P(Decisions, state_of_the_application_is_put_back) {
    GLuint buffers[4] = {};
    glGenBuffers(4, buffers);
    for (GLuint i = 0; i < 3; ++i) {
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffers[i]);
        glBufferData(GL_SHADER_STORAGE_BUFFER, 1024, nullptr, GL_STATIC_DRAW);
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, i, buffers[i], 256 * i, 256);
    }
    for (const GLenum target : {GL_SHADER_STORAGE_BUFFER, GL_DRAW_INDIRECT_BUFFER, GL_COPY_READ_BUFFER,
                                GL_COPY_WRITE_BUFFER, GL_ARRAY_BUFFER})
        glBindBuffer(target, buffers[3]);
    target_->begin(ClipDepth::NegativeOneToOne, glm::vec3(0));
    glColorMaski(0, GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
    glColorMaski(3, GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 0, 0xff);
    executor_->draw(plan_of({kSeen, kHidden, kSeen, kHidden}), *buffers_, view_at({0, 0, 0}, {0, 0, -1}));
    GLboolean mask[4] = {};
    glGetBooleani_v(GL_COLOR_WRITEMASK, 0, mask);
    EXPECT_TRUE(mask[0] && !mask[1] && mask[2] && !mask[3]);
    glGetBooleani_v(GL_COLOR_WRITEMASK, 3, mask);
    EXPECT_TRUE(!mask[0] && mask[1] && !mask[2] && mask[3]);
    EXPECT_TRUE(glIsEnabled(GL_STENCIL_TEST));
    EXPECT_FALSE(glIsEnabled(GL_DEPTH_CLAMP));
    EXPECT_FALSE(glIsEnabled(GL_CULL_FACE));
    for (GLuint i = 0; i < 3; ++i) {
        GLint name = 0;
        GLint64 start = 0, size = 0;
        glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, i, &name);
        glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, i, &start);
        glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, i, &size);
        EXPECT_EQ(static_cast<GLuint>(name), buffers[i]);
        EXPECT_EQ(start, 256 * i);
        EXPECT_EQ(size, 256);
    }
    for (const GLenum binding : {GL_SHADER_STORAGE_BUFFER_BINDING, GL_DRAW_INDIRECT_BUFFER_BINDING,
                                 GL_COPY_READ_BUFFER_BINDING, GL_COPY_WRITE_BUFFER_BINDING,
                                 GL_ARRAY_BUFFER_BINDING, GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING}) {
        GLint name = 0;
        glGetIntegerv(binding, &name);
        const bool is_buffer = binding != GL_CURRENT_PROGRAM && binding != GL_VERTEX_ARRAY_BINDING;
        EXPECT_EQ(static_cast<GLuint>(name), is_buffer ? buffers[3] : 0u) << binding;
    }
    glDeleteBuffers(4, buffers);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_STENCIL_TEST);
    answers();
}

TEST_P(Decisions, nothing_waits_for_answers_that_are_not_asked_for_in_time) {
    const View view = view_at({0, 0, 0}, {0, 0, -1});
    std::vector<QueryAnswer> list;
    for (std::uint64_t frame = 0; frame < 100; ++frame) {
        FramePlan plan = plan_of({kSeen, kHidden});
        for (PlannedQuery& query : plan.queries) query.ticket = 2 * frame + query.first_box;
        target_->begin(view.clip_depth, glm::vec3(0));
        executor_->draw(plan, *buffers_, view);
        if (frame % 3 == 0) executor_->poll_answers(list);
    }
    executor_->wait_for_answers(list);
    ASSERT_EQ(list.size(), 200u);
    std::ranges::sort(list, {}, &QueryAnswer::ticket);
    for (std::uint64_t i = 0; i < 200; ++i) {
        EXPECT_EQ(list[i].ticket, i);
        EXPECT_EQ(list[i].visible, i % 2 == 0);
    }
    EXPECT_EQ(executor_->answer_counters().lost, 0u);
}

INSTANTIATE_TEST_SUITE_P(Ways, Decisions, testing::ValuesIn(kEveryWay));

using Answers = OcclusionTest;

TEST_F(Answers, box_passes_that_nobody_fetches_are_given_up_as_visible) {
    const CellScene cells = CellMaker(5).make(20, 5.0);
    const SceneBuffers buffers = SceneBuffers::upload(cells.scene).value();
    QueryPlanner planner{.hardware = false};
    std::size_t asked = 0, first_frames = 0;
    for (int frame = 0; frame < 20; ++frame) {
        const FramePlan plan = planner.plan(cells.cells);
        depths_of(plan, buffers, view_at({0, 0, 20}, {0, 0, -1}));
        asked += plan.queries.size();
        if (frame < 4) first_frames += plan.queries.size();
    }
    EXPECT_EQ(answers().size(), asked);
    EXPECT_EQ(executor_->answer_counters().lost, first_frames);
}

TEST_F(Answers, samples_are_counted_where_a_query_asks_for_them) {
    SceneBuilder builder;
    builder.add_static(builder.add_material({}), triangle_piece());
    const SceneBuffers buffers = SceneBuffers::upload(builder.finish("one").value()).value();
    FramePlan plan;
    // Faces the eye squarely: 2 m at 8 m, 60 / tan(0.5) pixels per metre at 1 m.
    plan.query_boxes = {{{-1, -1, -9}, {1, 1, -8}}, {{-1, -1, -9}, {1, 1, -8}}};
    plan.queries = {{7, 0, 1, QueryWay::HardwareQuery, true}, {8, 1, 1, QueryWay::HardwareQuery, false}};
    depths_of(plan, buffers, view_at({0, 0, 0}, {0, 0, -1}));
    const auto known = answers();
    const double side = 2.0 / 8.0 * 60.0 / std::tan(0.5);
    EXPECT_NEAR(static_cast<double>(known.at(7).samples), side * side, 2.0 * side);
    EXPECT_EQ(known.at(8).samples, 0u);
    EXPECT_TRUE(known.at(8).visible);
}

bool never(std::uint32_t, std::uint64_t&) {
    return false;
}

std::uint32_t late_name = 0;
bool all_but_one(std::uint32_t name, std::uint64_t& samples) {
    return name != late_name && QueryPool::poll_device(name, samples);
}

TEST_F(Answers, a_query_that_never_returns_counts_as_visible_and_is_reported) {
    QueryPool pool(8, never);
    std::vector<QueryAnswer> list;
    std::size_t frame = 0;
    for (; frame < 100 && list.empty(); ++frame) {
        pool.begin_frame();
        if (frame == 0) {
            pool.begin(41, true);
            pool.end();
        }
        pool.poll(list);
    }
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(frame, 10u);
    EXPECT_EQ(list[0].ticket, 41u);
    EXPECT_TRUE(list[0].visible);
    EXPECT_EQ(pool.counters().lost, 1u);
    EXPECT_EQ(pool.counters().answered, 0u);
    EXPECT_EQ(pool.in_flight(), 0u);
    EXPECT_EQ(pool.counters().blocking_reads, 0u);
}

TEST_F(Answers, a_lost_query_holds_up_the_later_ones_for_a_few_frames_only) {
    QueryPool pool(50, all_but_one);
    std::vector<QueryAnswer> list;
    for (std::uint64_t frame = 0; frame < 20; ++frame) {
        pool.begin_frame();
        const std::uint32_t name = pool.begin(frame, false);
        pool.end();
        if (frame == 0) late_name = name;
        finish();
        pool.poll(list);
    }
    EXPECT_EQ(list.size(), 19u);
    EXPECT_EQ(pool.in_flight(), 1u);
    EXPECT_LE(pool.objects(), 8u);
}

TEST_F(Answers, query_objects_are_used_again) {
    QueryPool pool;
    std::vector<QueryAnswer> list;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        pool.begin_frame();
        for (const bool counts : {false, true}) {
            pool.begin(2 * i + counts, counts);
            pool.end();
        }
        finish();
        pool.poll(list);
    }
    EXPECT_EQ(list.size(), 2000u);
    EXPECT_LE(pool.objects(), 4u);
    for (const QueryAnswer& answer : list) EXPECT_FALSE(answer.visible) << "nothing was drawn";
}

TEST_F(Answers, waiting_is_counted) {
    QueryPool pool(8, never);
    std::vector<QueryAnswer> list;
    pool.begin(1, false);
    pool.end();
    pool.wait(list);
    EXPECT_EQ(list.size(), 1u);
    EXPECT_EQ(pool.counters().blocking_reads, 1u);
}

}  // namespace
}  // namespace rhview::gl
