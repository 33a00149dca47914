// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <limits>
#include <span>

#include "town.h"

namespace rhview {
namespace {

rhview_box box_at(float x, float y, float z) {
    return {{x - 0.5f, y - 0.5f, z - 0.5f}, {x + 0.5f, y + 0.5f, z + 0.5f}};
}

/// No triangles, up to 300 objects, views that look along +x and -x.
class Crowd : public testing::Test {
  protected:
    Crowd() {
        auto options = sized<rhview_scene_options>();
        options.max_objects = 300;
        EXPECT_OK(rhview_scene_create(&options, &scene));
        EXPECT_OK(rhview_scene_build(scene, nullptr));
        ahead = add_view(0.0);
        behind = add_view(3.14159265358979);
    }
    ~Crowd() override {
        rhview_view_destroy(ahead);
        rhview_view_destroy(behind);
        rhview_scene_destroy(scene);
    }

    rhview_view* add_view(double angle) {
        const rhview_costs costs = costs_with_queries();
        const double ends[] = {15.0, 35.0};
        auto options = sized<rhview_view_options>();
        options.costs = &costs;
        options.occlusion = RHVIEW_OCCLUSION_EXACT;
        options.band_ends = ends;
        options.band_count = 2;
        rhview_view* view = nullptr;
        EXPECT_OK(rhview_view_create(scene, &options, &view));
        const rhview_camera camera = camera_at(angle);
        EXPECT_OK(rhview_view_set_camera(view, &camera));
        return view;
    }

    std::uint32_t add(const rhview_box& box, double top_speed, std::uint32_t index_count = 0) {
        auto object = sized<rhview_object>();
        object.box = box;
        object.top_speed = top_speed;
        object.index_count = index_count;
        std::uint32_t number = 0xffffffffu;
        EXPECT_OK(rhview_scene_add_object(scene, &object, &number));
        return number;
    }

    void frame(std::initializer_list<rhview_view*> views) {
        const std::vector<rhview_view*> list(views);
        EXPECT_OK(rhview_scene_begin_frame(scene, time_s));
        EXPECT_OK(rhview_plan_views(list.data(), list.size(), nullptr));
        EXPECT_OK(rhview_scene_end_frame(scene));
        time_s += 0.01;
    }

    std::vector<std::uint32_t> due() {
        const std::uint32_t* numbers = nullptr;
        std::size_t count = 0;
        EXPECT_OK(rhview_scene_due_objects(scene, &numbers, &count));
        std::vector<std::uint32_t> sorted(numbers, numbers + count);
        std::ranges::sort(sorted);
        return sorted;
    }

    static rhview_object_state state_of(const rhview_view* view, std::uint32_t object) {
        auto state = sized<rhview_object_state>();
        EXPECT_OK(rhview_view_object_state(view, object, &state));
        return state;
    }

    rhview_scene* scene = nullptr;
    rhview_view *ahead = nullptr, *behind = nullptr;
    double time_s = 0.0;
};

using Numbers = std::vector<std::uint32_t>;

TEST_F(Crowd, only_what_some_view_shows_and_what_promises_nothing_is_moved_again) {
    add(box_at(10, 0, 0), 1.0);   // ahead
    add(box_at(-10, 0, 0), 1.0);  // behind
    add(box_at(0, 60, 0), 1.0);   // above
    add(box_at(0, 60, 0), 0.0);   // above, without a promise
    EXPECT_EQ(due(), (Numbers{0, 1, 2, 3}));
    frame({ahead, behind});
    EXPECT_EQ(due(), (Numbers{0, 1, 3}));
    frame({ahead});
    EXPECT_EQ(due(), (Numbers{0, 3}));
    time_s += 2.0;  // longer than any volume lasts
    EXPECT_OK(rhview_scene_begin_frame(scene, time_s));
    EXPECT_EQ(due(), (Numbers{0, 1, 2, 3}));
}

TEST_F(Crowd, hidden_objects_that_keep_to_a_range_need_not_be_moved_again) {
    auto object = sized<rhview_object>();
    object.box = box_at(-50, 0, 0);
    object.top_speed = 10.0;
    std::uint32_t rover = 0, captive = 0;
    ASSERT_OK(rhview_scene_add_object(scene, &object, &rover));
    object.has_range = 1;
    object.range = {{-60, -10, -10}, {-40, 10, 10}};
    ASSERT_OK(rhview_scene_add_object(scene, &object, &captive));
    int rover_moves = 0, captive_moves = 0, last_captive_move = 0;
    for (int i = 0; i < 2000; ++i) {
        ASSERT_OK(rhview_scene_begin_frame(scene, time_s));
        for (const std::uint32_t number : due()) {
            ASSERT_OK(rhview_scene_move_object(scene, number, &object.box));
            ++(number == rover ? rover_moves : captive_moves);
            if (number == captive) last_captive_move = i;
        }
        ASSERT_OK(rhview_plan_views(&ahead, 1, nullptr));
        ASSERT_OK(rhview_scene_end_frame(scene));
        time_s += 0.01;
    }
    EXPECT_GT(rover_moves, 3);
    EXPECT_LT(captive_moves, rover_moves);
    EXPECT_LT(last_captive_move, 1000);
}

TEST_F(Crowd, an_object_that_was_removed_in_this_frame_is_not_due) {
    const std::uint32_t first = add(box_at(10, 0, 0), 0.0);
    const std::uint32_t second = add(box_at(12, 0, 0), 0.0);
    EXPECT_OK(rhview_scene_begin_frame(scene, 1.0));
    EXPECT_OK(rhview_scene_remove_object(scene, first));
    const std::uint32_t* numbers = nullptr;
    std::size_t count = 0;
    EXPECT_OK(rhview_scene_due_objects(scene, &numbers, &count));
    EXPECT_EQ(std::vector(numbers, numbers + count), std::vector{second});
}

TEST_F(Crowd, views_tell_what_they_show) {
    add(box_at(10, 0, 0), 0.0);
    add(box_at(30, 0, 0), 0.0);
    add(box_at(-50, 0, 0), 0.0);
    frame({ahead, behind});
    auto changes = sized<rhview_changes>();
    ASSERT_OK(rhview_view_changes(ahead, &changes));
    EXPECT_EQ(Numbers(changes.became_visible, changes.became_visible + changes.became_visible_count),
              (Numbers{0, 1}));
    EXPECT_EQ(changes.became_hidden_count, 0u);
    EXPECT_EQ(state_of(ahead, 0).band, 0u);
    EXPECT_EQ(state_of(ahead, 1).band, 1u);
    EXPECT_EQ(state_of(behind, 2).band, 2u);
    EXPECT_EQ(state_of(behind, 2).is_visible, 1u);
    EXPECT_EQ(state_of(behind, 0).last_seen_frame, RHVIEW_NEVER);

    const rhview_box away = box_at(-10, 0, 0);
    ASSERT_OK(rhview_scene_move_object(scene, 0, &away));
    frame({ahead, behind});
    ASSERT_OK(rhview_view_changes(ahead, &changes));
    EXPECT_EQ(changes.became_visible_count, 0u);
    EXPECT_EQ(Numbers(changes.became_hidden, changes.became_hidden + changes.became_hidden_count),
              Numbers{0});
    EXPECT_EQ(state_of(ahead, 0).last_seen_frame, 0u);
    EXPECT_EQ(state_of(ahead, 1).last_seen_frame, 1u);
    EXPECT_EQ(state_of(behind, 0).last_seen_frame, 1u);
}

TEST_F(Crowd, what_queries_find_hidden_hangs_on_them_and_is_told_hidden) {
    for (int i = 0; i < 200; ++i)
        add(box_at(60, static_cast<float>(i / 20) * 2.0f - 10.0f, static_cast<float>(i % 20) * 2.0f - 20.0f),
            0.0, 30'000);
    std::size_t conditional = 0;
    for (int i = 0; i < 60; ++i) {
        frame({ahead});
        const rhview_plan plan = plan_of(ahead);
        EXPECT_EQ(plan.object_count + plan.conditional_object_count, 200u);
        for (std::size_t c = 0; c < plan.conditional_object_count; ++c)
            EXPECT_LT(plan.conditional_objects[c].query, plan.query_count);
        conditional = plan.conditional_object_count;
        std::vector<rhview_answer> answers;
        for (const rhview_query& query : std::span(plan.queries, plan.query_count))
            answers.push_back({query.ticket, 0, 0});
        ASSERT_OK(rhview_view_absorb(ahead, answers.data(), answers.size()));
    }
    EXPECT_GT(conditional, 190u);
    std::size_t visible = 0;
    for (std::uint32_t i = 0; i < 200; ++i) visible += state_of(ahead, i).is_visible;
    EXPECT_LT(visible, 10u);
}

TEST_F(Crowd, a_number_that_is_given_again_is_another_object_to_a_view_that_was_not_planned_meanwhile) {
    const std::uint32_t first = add(box_at(-10, 0, 0), 0.0);
    frame({behind});
    EXPECT_EQ(state_of(behind, first).is_visible, 1u);
    ASSERT_OK(rhview_scene_remove_object(scene, first));
    EXPECT_EQ(add(box_at(0, 60, 0), 0.0), first);
    frame({ahead});  // `behind` misses the news
    frame({ahead});
    frame({behind});
    EXPECT_EQ(state_of(behind, first).last_seen_frame, RHVIEW_NEVER);
    auto changes = sized<rhview_changes>();
    ASSERT_OK(rhview_view_changes(behind, &changes));
    EXPECT_EQ(changes.became_hidden_count, 0u);
}

TEST_F(Crowd, an_object_that_jumps_is_planned_where_it_is) {
    const std::uint32_t object = add(box_at(0, 60, 0), 1.0);
    frame({ahead});
    EXPECT_EQ(plan_of(ahead).object_count, 0u);
    const rhview_box here = box_at(20, 0, 0);
    ASSERT_OK(rhview_scene_jump_object(scene, object, &here));
    frame({ahead});
    ASSERT_EQ(plan_of(ahead).object_count, 1u);
    EXPECT_EQ(plan_of(ahead).objects[0].object, object);
    EXPECT_EQ(plan_of(ahead).objects[0].level, 0u);
}

TEST_F(Crowd, wrong_objects_are_told) {
    auto object = sized<rhview_object>();
    std::uint32_t number = 0;
    object.box = box_at(0, 0, 0);
    object.box.min[1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(rhview_scene_add_object(scene, &object, &number), RHVIEW_INVALID_ARGUMENT);
    object.box = {{1, 0, 0}, {0, 1, 1}};
    EXPECT_EQ(rhview_scene_add_object(scene, &object, &number), RHVIEW_INVALID_ARGUMENT);
    object.box = box_at(0, 0, 0);
    object.has_range = 1;
    object.range = {{1, 0, 0}, {0, 1, 1}};
    EXPECT_EQ(rhview_scene_add_object(scene, &object, &number), RHVIEW_INVALID_ARGUMENT);
    object.has_range = 0;
    object.top_speed = -1.0;
    EXPECT_EQ(rhview_scene_add_object(scene, &object, &number), RHVIEW_INVALID_ARGUMENT);
    for (int i = 0; i < 300; ++i) add(box_at(0, 0, 0), 1.0);
    object.top_speed = 1.0;
    EXPECT_EQ(rhview_scene_add_object(scene, &object, &number), RHVIEW_WRONG_STATE);
    ASSERT_OK(rhview_scene_remove_object(scene, 7));
    EXPECT_EQ(rhview_scene_remove_object(scene, 7), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_scene_move_object(scene, 7, &object.box), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_scene_move_object(scene, 300, &object.box), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(rhview_scene_move_object(scene, 8, nullptr), RHVIEW_INVALID_ARGUMENT);
    ASSERT_OK(rhview_scene_begin_frame(scene, 5.0));
    EXPECT_EQ(rhview_scene_begin_frame(scene, 4.0), RHVIEW_INVALID_ARGUMENT);
    EXPECT_EQ(add(box_at(0, 0, 0), 1.0), 7u);
}

}  // namespace
}  // namespace rhview
