// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/visibility_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "allocations.h"
#include "fake_gpu.h"
#include "rhview/pipeline/rhview_planner.h"

namespace rhview {
namespace {

constexpr std::uint64_t kNever = ObjectSighting::kNever;

std::vector<ObjectId> ids(std::initializer_list<std::uint32_t> numbers) {
    std::vector<ObjectId> objects;
    for (const std::uint32_t number : numbers) objects.push_back(ObjectId{number});
    return objects;
}

std::vector<ObjectId> listed(std::span<const ObjectId> objects) {
    return {objects.begin(), objects.end()};
}

/// A report, and plans written by hand. Objects stand along z, ten metres apart, the eye at 0.
class Reported : public testing::Test {
  protected:
    Reported() {
        for (int i = 0; i < 6; ++i) {
            const float z = -10.0f * static_cast<float>(i + 1);
            boxes.push_back({glm::vec3(-1, -1, z - 1), glm::vec3(1, 1, z)});
        }
    }

    void frame(std::initializer_list<std::uint32_t> at_once,
               std::initializer_list<std::pair<std::uint64_t, std::uint32_t>> asked = {}) {
        plan.clear();
        plan.objects = ids(at_once);
        for (const auto& [ticket, object] : asked) {
            const auto same = std::ranges::find(plan.queries, ticket, &PlannedQuery::ticket);
            const auto query = static_cast<std::uint32_t>(same - plan.queries.begin());
            if (same == plan.queries.end()) plan.queries.push_back({.ticket = ticket});
            plan.conditional_objects.push_back({ObjectId{object}, query, 3});
        }
        input.object_boxes = boxes;
        report.update(input, plan);
    }

    std::vector<Aabb> boxes;
    FrameInput input;
    FramePlan plan;
    VisibilityReport report{{.band_ends = {15.0, 35.0}, .band_hysteresis = 0.2, .max_answer_frames = 4}};
};

TEST_F(Reported, what_is_drawn_at_once_became_visible_and_what_is_left_out_became_hidden) {
    frame({0, 2});
    EXPECT_EQ(listed(report.became_visible()), ids({0, 2}));
    EXPECT_TRUE(report.became_hidden().empty());
    frame({2});
    EXPECT_TRUE(report.became_visible().empty());
    EXPECT_EQ(listed(report.became_hidden()), ids({0}));
    frame({2});
    EXPECT_TRUE(report.became_visible().empty());
    EXPECT_TRUE(report.became_hidden().empty());
    EXPECT_EQ(report.sighting(ObjectId{0}).last_seen_frame, 0u);
    EXPECT_EQ(report.sighting(ObjectId{1}).last_seen_frame, kNever);
    EXPECT_EQ(report.sighting(ObjectId{2}).last_seen_frame, 2u);
    EXPECT_TRUE(report.sighting(ObjectId{2}).visible);
    EXPECT_EQ(report.frame(), 3u);
}

TEST_F(Reported, what_hangs_on_a_query_stays_what_it_was_until_the_answer) {
    frame({0});
    frame({}, {{7, 0}, {7, 1}, {8, 2}});
    EXPECT_TRUE(report.became_hidden().empty());
    EXPECT_TRUE(report.sighting(ObjectId{0}).visible);
    const QueryAnswer answers[] = {{7, false}, {8, true}};
    report.absorb(answers);
    frame({}, {{9, 0}, {10, 1}, {11, 2}});
    EXPECT_EQ(listed(report.became_visible()), ids({2}));
    EXPECT_EQ(listed(report.became_hidden()), ids({0}));
    EXPECT_EQ(report.sighting(ObjectId{0}).last_seen_frame, 0u);
    EXPECT_EQ(report.sighting(ObjectId{2}).last_seen_frame, 1u);
    EXPECT_EQ(report.sighting(ObjectId{2}).level, 3);
}

TEST_F(Reported, an_old_answer_changes_nothing_that_is_known_from_later) {
    frame({}, {{1, 0}, {2, 1}});
    frame({0});
    const QueryAnswer answers[] = {{1, false}, {2, true}};
    report.absorb(answers);
    frame({0});
    EXPECT_TRUE(report.sighting(ObjectId{0}).visible);
    EXPECT_EQ(report.sighting(ObjectId{0}).last_seen_frame, 2u);
    // It was seen then, and is out of the view since.
    EXPECT_FALSE(report.sighting(ObjectId{1}).visible);
    EXPECT_EQ(report.sighting(ObjectId{1}).last_seen_frame, 0u);
}

TEST_F(Reported, answers_that_nobody_asked_for_or_that_come_too_late_are_ignored) {
    frame({}, {{1, 0}});
    for (std::uint64_t i = 0; i < 4; ++i) frame({}, {{10 + i, 0}});
    const QueryAnswer answers[] = {{1, true}, {99, true}};
    report.absorb(answers);
    frame({}, {{20, 0}});
    EXPECT_FALSE(report.sighting(ObjectId{0}).visible);
    EXPECT_EQ(report.sighting(ObjectId{0}).last_seen_frame, kNever);
}

TEST_F(Reported, an_object_that_is_new_or_elsewhere_begins_hidden_whatever_its_number_was_told_before) {
    frame({0}, {{1, 1}});
    const std::vector<ObjectId> elsewhere = ids({1});
    const std::vector<std::uint64_t> alive{0b111110};
    input.new_objects = elsewhere;
    input.object_alive = alive;
    frame({}, {{2, 1}});
    EXPECT_TRUE(report.became_hidden().empty());  // 0 is gone
    EXPECT_EQ(report.sighting(ObjectId{0}).last_seen_frame, kNever);
    input.new_objects = {};
    const QueryAnswer old[] = {{1, true}};
    report.absorb(old);
    frame({}, {{3, 1}});
    EXPECT_FALSE(report.sighting(ObjectId{1}).visible);
    const QueryAnswer newer[] = {{2, true}};
    report.absorb(newer);
    frame({}, {{4, 1}});
    EXPECT_EQ(listed(report.became_visible()), ids({1}));
    EXPECT_EQ(report.sighting(ObjectId{1}).last_seen_frame, 1u);
}

TEST_F(Reported, bands_are_left_outwards_late_and_inwards_at_once) {
    frame({});
    EXPECT_EQ(report.sighting(ObjectId{0}).band, 0);  // at 10 m
    EXPECT_EQ(report.sighting(ObjectId{1}).band, 1);  // at 20 m
    EXPECT_EQ(report.sighting(ObjectId{5}).band, 2);  // at 60 m
    input.scene_origin = {0, 0, -7};
    frame({});
    EXPECT_EQ(report.sighting(ObjectId{0}).band, 0);  // at 17 m, less than 15 + 20 %
    EXPECT_EQ(report.sighting(ObjectId{2}).band, 1);  // at 37 m
    input.scene_origin = {0, 0, -9};
    frame({});
    EXPECT_EQ(report.sighting(ObjectId{0}).band, 1);  // at 19 m
    input.scene_origin = {0, 0, -4.5};
    frame({});
    EXPECT_EQ(report.sighting(ObjectId{0}).band, 0);  // at 14.5 m
}

TEST_F(Reported, an_object_that_is_not_there_was_never_seen) {
    frame({0, 17});
    EXPECT_EQ(report.sighting(ObjectId{17}).last_seen_frame, kNever);
    EXPECT_EQ(listed(report.became_visible()), ids({0}));
}

TEST_F(Reported, a_warm_report_allocates_nothing) {
    const auto walk = [&] {
        for (std::uint64_t i = 0; i < 12; ++i) {
            const QueryAnswer answer{2 * i, i % 2 == 0};
            report.absorb({&answer, 1});
            plan.queries = {};
            report.update(input, plan);
        }
    };
    frame({0, 1, 2}, {{0, 3}, {1, 4}});
    frame({3, 4, 5}, {{2, 1}, {3, 2}});
    frame({0, 1, 2, 3, 4, 5});
    frame({});
    plan.conditional_objects.clear();
    walk();
    const long before = allocations();
    walk();
    EXPECT_EQ(allocations(), before);
}

TEST(VisibilityReport, agrees_with_a_planner_and_a_device_about_what_is_behind_a_wall) {
    // 200 objects ahead; a device that sees nothing of those beyond x = 0 once the wall stands.
    const RhOctree nothing;
    std::vector<Aabb> boxes;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 centre(static_cast<float>(i % 20) - 9.75f, static_cast<float>(i / 20) - 5.0f, -40.0f);
        boxes.push_back({centre - 0.2f, centre + 0.2f});
    }
    const std::vector<std::uint32_t> indices(boxes.size(), 30'000);
    OcclusionOptions options;
    options.costs.hardware = {.query_ns = 10.0};
    options.costs.box_pass = {.query_ns = 1e300};
    options.object_indices = indices;
    RhviewPlanner planner(nothing, {1.0, 60.0, 0.0}, options);
    VisibilityReport report;
    FakeGpu gpu({.latency = 2});
    FrameInput input;
    input.culling_view.camera_from_world = look_along({0, 0, 0}, {0, 0, -1}, {0, 1, 0});
    input.culling_view.clip_from_camera = perspective(1.0, 1.5, 0.1, 100.0, ClipDepth::NegativeOneToOne);
    input.object_boxes = boxes;
    FramePlan plan;
    std::size_t turned = 0;
    for (int frame = 0; frame < 100; ++frame) {
        const auto answers = gpu.next_frame();
        planner.absorb(answers);
        report.absorb(answers);
        planner.plan(input, plan);
        report.update(input, plan);
        turned += report.became_hidden().size();
        for (const PlannedQuery& query : plan.queries) {
            const auto asked = std::span(plan.query_boxes).subspan(query.first_box, query.box_count);
            gpu.ask({query.ticket,
                     frame < 10 || std::ranges::any_of(asked, [](const Aabb& b) { return b.min.x < 0.0f; })});
        }
    }
    std::size_t hidden = 0;
    for (std::uint32_t i = 0; i < 200; ++i) {
        const ObjectSighting sighting = report.sighting(ObjectId{i});
        const bool in_sight = boxes[i].min.x < 0.0f;
        EXPECT_TRUE(sighting.visible || !in_sight) << i;
        hidden += !in_sight && !sighting.visible;
    }
    EXPECT_GE(hidden, 95u);
    EXPECT_GE(turned, 95u);
}

}  // namespace
}  // namespace rhview
