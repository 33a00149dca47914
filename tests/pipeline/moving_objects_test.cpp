// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/moving_objects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "fake_gpu.h"
#include "rhview/base/assert.h"
#include "rhview/pipeline/rhview_planner.h"
#include "seen_before_wall.h"
#include "uniform.h"

namespace rhview {
namespace {

const Aabb kUnitBox{glm::vec3(-0.5f), glm::vec3(0.5f)};

Aabb box_at(const glm::dvec3& centre, double half = 0.5) {
    return {glm::vec3(centre - half), glm::vec3(centre + half)};
}

FramePlan plan_of(std::initializer_list<std::uint32_t> objects) {
    FramePlan plan;
    for (const std::uint32_t object : objects) plan.objects.push_back(ObjectId{object});
    return plan;
}

bool is_due(const MovingObjects& objects, ObjectId object) {
    return std::ranges::count(objects.due(), object) == 1;
}

Aabb volume_of(const MovingObjects& objects, ObjectId object) {
    FrameInput input;
    objects.describe(input);
    return input.object_boxes[index_of(object)];
}

TEST(MovingObjects, one_that_any_view_of_the_frame_draws_stays_awake) {
    MovingObjects objects;
    for (std::uint32_t i = 0; i < 3; ++i) objects.add(kUnitBox, 0, 1.0);
    const FramePlan first = plan_of({0}), second = plan_of({0, 2});
    const FramePlan* const plans[] = {&first, &second};
    objects.begin_frame(0.0);
    objects.end_frame_of_views(plans);
    EXPECT_FALSE(objects.is_asleep(ObjectId{0}));
    EXPECT_TRUE(objects.is_asleep(ObjectId{1}));
    EXPECT_FALSE(objects.is_asleep(ObjectId{2}));
    objects.begin_frame(0.1);
    objects.end_frame_of_views({});
    EXPECT_TRUE(objects.is_asleep(ObjectId{0}));
    EXPECT_TRUE(objects.is_asleep(ObjectId{2}));
}

TEST(MovingObjects, numbers_of_removed_objects_are_given_again_the_lowest_first) {
    MovingObjects objects;
    for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(objects.add(kUnitBox, i, 1.0), ObjectId{i});
    objects.remove(ObjectId{3});
    objects.remove(ObjectId{1});
    EXPECT_EQ(objects.add(kUnitBox, 7, 1.0), ObjectId{1});
    FrameInput input;
    objects.describe(input);
    EXPECT_FALSE(input.is_alive(3));
    EXPECT_TRUE(input.is_alive(1));
    EXPECT_EQ(input.object_groups[1], 7u);
    EXPECT_EQ(objects.add(kUnitBox, 8, 1.0), ObjectId{3});
    EXPECT_EQ(objects.add(kUnitBox, 8, 1.0), ObjectId{5});
    objects.begin_frame(0.0);
    EXPECT_EQ(objects.due().size(), 6u);
    for (std::uint32_t i = 0; i < 6; ++i) EXPECT_TRUE(is_due(objects, ObjectId{i}));
}

TEST(MovingObjects, what_is_not_drawn_sleeps_in_a_volume_that_holds_it_until_it_expires) {
    MovingObjects objects;
    const ObjectId seen = objects.add(kUnitBox, 0, 2.0), hidden = objects.add(box_at({9, 0, 0}), 0, 2.0);
    objects.begin_frame(1.0);
    for (const ObjectId object : {seen, hidden})
        objects.move(object, object == seen ? kUnitBox : box_at({9, 0, 0}));
    objects.end_frame(plan_of({0}));
    EXPECT_FALSE(objects.is_asleep(seen));
    ASSERT_TRUE(objects.is_asleep(hidden));
    // First period 0.25 s, a quarter more or less: at least 0.375 m at 2 m/s.
    const Aabb volume = volume_of(objects, hidden);
    EXPECT_LE(volume.min.x, 8.5f - 0.375f);
    EXPECT_GE(volume.min.x, 8.5f - 0.7f);
    objects.begin_frame(1.1);
    EXPECT_TRUE(is_due(objects, seen));
    EXPECT_FALSE(is_due(objects, hidden));
    objects.end_frame(plan_of({0}));
    EXPECT_EQ(volume_of(objects, hidden), volume);
    objects.begin_frame(1.4);
    EXPECT_TRUE(is_due(objects, hidden));
}

TEST(MovingObjects, periods_grow_when_they_expire_unseen_and_shrink_when_the_volume_is_drawn) {
    MovingObjects objects;
    const ObjectId object = objects.add(kUnitBox, 0, 1.0);
    double time = 0.0;
    std::size_t told = 0;
    for (; time < 100.0; time += 0.05) {
        objects.begin_frame(time);
        if (is_due(objects, object)) {
            objects.move(object, kUnitBox);
            ++told;
        }
        objects.end_frame({});
    }
    EXPECT_GT(told, 80u);
    EXPECT_LT(told, 150u);  // of 2,000 frames
    const auto size = [&] { return volume_of(objects, object).extent().x; };
    const float long_asleep = size();
    EXPECT_GT(long_asleep, 1.0f + 2.0f * 0.75f);
    // Drawn: awake, and for a shorter time asleep.
    objects.end_frame(plan_of({0}));
    EXPECT_FALSE(objects.is_asleep(object));
    objects.begin_frame(time += 0.05);
    objects.move(object, kUnitBox);
    objects.end_frame({});
    EXPECT_LT(size() - 1.0f, 0.6f * (long_asleep - 1.0f));
}

TEST(MovingObjects, without_a_promise_an_object_never_sleeps) {
    for (const double speed : {std::numeric_limits<double>::infinity(), std::nan("")}) {
        MovingObjects objects;
        const ObjectId object = objects.add(kUnitBox, 0, speed);
        for (int frame = 0; frame < 5; ++frame) {
            objects.begin_frame(frame);
            EXPECT_TRUE(is_due(objects, object));
            objects.move(object, box_at({100.0 * frame, 0, 0}));
            objects.end_frame({});
        }
        EXPECT_EQ(objects.broken_promises(), 0u);
    }
}

TEST(MovingObjects, one_that_never_leaves_a_hidden_range_is_not_touched_again) {
    MovingObjects objects;
    const Aabb range = box_at({0, 0, 0}, 5.0);
    const ObjectId object = objects.add(kUnitBox, 0, MotionPromise{1.0, range});
    int told = 0;
    for (int frame = 0; frame < 6000; ++frame) {
        objects.begin_frame(frame / 60.0);
        for (const ObjectId due : objects.due()) objects.move(due, kUnitBox), ++told;
        objects.end_frame({});
        const Aabb volume = volume_of(objects, object);
        ASSERT_LE(volume.extent().x, range.extent().x + 1e-4f) << "no volume is larger than the range";
    }
    EXPECT_EQ(told, 2) << "when it is new, and once when its first volume expires";
    EXPECT_TRUE(glm::all(glm::lessThanEqual(volume_of(objects, object).min, range.min)));
}

TEST(MovingObjects, a_range_that_is_seen_is_tried_more_and_more_rarely) {
    MovingObjects objects;
    const Aabb range = box_at({0, 0, 0}, 5.0);
    const ObjectId object = objects.add(kUnitBox, 0, MotionPromise{1.0, range});
    std::vector<int> seen;
    for (int frame = 0; frame < 60 * 60; ++frame) {
        objects.begin_frame(frame / 60.0);
        for (const ObjectId due : objects.due()) objects.move(due, kUnitBox);
        // All beyond x = 4 can be seen.
        const bool drawn = volume_of(objects, object).max.x > 4.0f;
        if (drawn) seen.push_back(frame);
        objects.end_frame(drawn ? plan_of({0}) : plan_of({}));
    }
    ASSERT_GE(seen.size(), 4u);
    EXPECT_LE(seen.size(), 8u);
    for (std::size_t i = 2; i < seen.size(); ++i) EXPECT_GT(seen[i] - seen[i - 1], seen[i - 1] - seen[i - 2]);
}

int asserts = 0;
void count_assert(const char*, const char*, int) {
    ++asserts;
}

TEST(MovingObjects, a_broken_promise_is_asserted_and_the_object_is_new_again) {
    const AssertHandler before = set_assert_handler(count_assert);
    asserts = 0;
    MovingObjects objects;
    const ObjectId object = objects.add(kUnitBox, 0, 1.0);
    objects.begin_frame(0.0);
    objects.end_frame({});
    objects.begin_frame(10.0);
    objects.move(object, box_at({11.0, 0, 0}));
    set_assert_handler(before);
    EXPECT_EQ(objects.broken_promises(), 1u);
#if RHVIEW_ENABLE_ASSERTS
    EXPECT_EQ(asserts, 1);
#endif
    FrameInput input;
    objects.describe(input);
    ASSERT_EQ(input.new_objects.size(), 1u);
    EXPECT_EQ(input.new_objects[0], object);
    EXPECT_EQ(input.object_boxes[0], box_at({11.0, 0, 0}));
}

// What is asleep must not go on where a clock that jumped back thinks it is.
TEST(MovingObjects, all_are_due_when_a_clock_jumps_back_or_has_no_number) {
    const AssertHandler before = set_assert_handler(count_assert);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const double jump : {-5.0, 9.0, std::numeric_limits<double>::quiet_NaN(), -kInfinity, kInfinity}) {
        asserts = 0;
        MovingObjects objects;
        for (int i = 0; i < 4; ++i) objects.add(kUnitBox, 0, i == 3 ? 0.0 : 2.0);
        objects.remove(ObjectId{2});
        objects.begin_frame(10.0);
        objects.end_frame({});
        ASSERT_TRUE(objects.is_asleep(ObjectId{0}));
        objects.begin_frame(jump);
        for (const std::uint32_t object : {0u, 1u, 3u}) {
            ASSERT_TRUE(is_due(objects, ObjectId{object})) << jump;
            objects.move(ObjectId{object}, object == 3 ? kUnitBox : box_at({300.0, 0, 0}));
        }
        EXPECT_EQ(objects.due().size(), 3u);
        EXPECT_EQ(objects.broken_promises(), 0u) << jump;
#if RHVIEW_ENABLE_ASSERTS
        EXPECT_EQ(asserts, 1);
#endif
        // From then on it is a clock like any other.
        objects.end_frame({});
        const double now = std::isfinite(jump) ? jump : 10.0;
        objects.begin_frame(now + 0.01);
        EXPECT_TRUE(objects.is_asleep(ObjectId{0})) << jump;
        const Aabb volume = volume_of(objects, ObjectId{0});
        EXPECT_GT(volume.max.x, 300.5f);
        EXPECT_LT(volume.max.x, 310.0f) << jump;
        objects.begin_frame(now + 1000.0);
        EXPECT_TRUE(is_due(objects, ObjectId{0}));
    }
    set_assert_handler(before);
}

TEST(MovingObjects, a_clock_that_stands_still_or_jumps_forward_keeps_promises) {
    MovingObjects objects;
    const ObjectId object = objects.add(kUnitBox, 0, 2.0);
    objects.begin_frame(1.0);
    objects.end_frame({});
    const Aabb volume = volume_of(objects, object);
    for (int i = 0; i < 100; ++i) {
        objects.begin_frame(1.0);
        objects.end_frame({});
        EXPECT_EQ(volume_of(objects, object), volume);
    }
    objects.begin_frame(1e9);
    ASSERT_TRUE(is_due(objects, object));
    objects.move(object, box_at({1.9e9, 0, 0}));
    EXPECT_EQ(objects.broken_promises(), 0u);
}

TEST(MovingObjects, one_that_leaves_its_range_is_asserted_and_has_none_from_then_on) {
    const AssertHandler before = set_assert_handler(count_assert);
    asserts = 0;
    MovingObjects objects;
    const ObjectId object = objects.add(kUnitBox, 0, MotionPromise{100.0, box_at({0, 0, 0}, 2.0)});
    objects.begin_frame(0.0);
    objects.end_frame({});
    objects.begin_frame(1.0);
    objects.move(object, box_at({5.0, 0, 0}));
    EXPECT_EQ(objects.broken_promises(), 1u);
    for (int frame = 0; frame < 200; ++frame) {
        objects.begin_frame(1.0 + frame / 60.0);
        for (const ObjectId due : objects.due()) objects.move(due, box_at({5.0, 0, 0}));
        objects.end_frame({});
        EXPECT_GE(volume_of(objects, object).max.x, 5.5f);
    }
    set_assert_handler(before);
    EXPECT_EQ(objects.broken_promises(), 1u);
#if RHVIEW_ENABLE_ASSERTS
    EXPECT_EQ(asserts, 1);
#endif
}

/// Objects of a world in which all beyond x = 20 is hidden, as they are and as the application tells them.
class RandomWorld {
  public:
    explicit RandomWorld(std::uint32_t seed)
        : random_(seed), planner_(octree_, DrawCosts{1.0, 60.0, 0.0}, options()) {}

    static OcclusionOptions options() {
        OcclusionOptions options;
        options.costs = {{.query_ns = 300.0, .box_ns = 30.0, .pixel_ns = 1e-3, .draw_ns = 80.0},
                         {.query_ns = 10.0, .box_ns = 90.0, .pixel_ns = 1e-3, .draw_ns = 60.0}};
        static const std::vector<std::uint32_t> indices(20'000, 90);
        options.object_indices = indices;
        return options;
    }

    void change_something() {
        const double what = random_(0, 1);
        if (alive_.size() < 200 || (what < 0.1 && alive_.size() < 3000)) return add();
        auto object = alive_.lower_bound(ObjectId{static_cast<std::uint32_t>(random_(0, 3000))});
        if (object == alive_.end()) object = alive_.begin();
        if (what < 0.19) {
            objects_.remove(object->first);
            alive_.erase(object);
        } else if (what < 0.22) {
            object->second.centre = object->second.kept_in(random_.point(60.0));
            objects_.teleport(object->first, box_at(object->second.centre));
        } else {
            // Nobody is told, unless it is due.
            const glm::dvec3 step = random_.point(object->second.left / std::sqrt(3.0));
            object->second.centre = object->second.kept_in(object->second.centre + step);
            object->second.left = 0.0;
        }
    }

    void frame(double time_s) {
        objects_.begin_frame(time_s);
        for (const ObjectId object : objects_.due()) {
            ASSERT_TRUE(alive_.contains(object));
            due_.push_back(object);
        }
        ASSERT_EQ(std::set<ObjectId>(due_.begin(), due_.end()).size(), due_.size());
        for (const ObjectId object : due_) objects_.move(object, box_at(alive_[object].centre));
        asleep += alive_.size() - due_.size();
        due_.clear();
        FrameInput input;
        input.culling_view = {look_along({10 * std::sin(time_s), 0, 0},
                                         {std::cos(0.3 * time_s), 0, std::sin(0.3 * time_s)}, {0, 1, 0}),
                              perspective(1.0, 1.5, 0.1, 500.0, ClipDepth::ReversedZeroToOne),
                              ClipDepth::ReversedZeroToOne};
        objects_.describe(input);
        planner_.absorb(gpu_.next_frame());
        planner_.plan(input, plan_);
        ask_before_wall(plan_, gpu_);
        check(make_frustum(input.culling_view));
        objects_.end_frame(plan_);
        for (auto& [object, state] : alive_) state.left = kSpeed * kStep * 0.999;
    }

    static constexpr double kSpeed = 3.0, kStep = 1.0 / 30;
    std::uint64_t asleep = 0, conditional = 0, visible = 0;

  private:
    struct State {
        glm::dvec3 centre{0.0};
        double left = 0.0;  ///< how far it may still go
        glm::dvec3 low{-60.0}, high{60.0};

        [[nodiscard]] glm::dvec3 kept_in(const glm::dvec3& place) const {
            return glm::clamp(place, low, high);
        }
    };

    void add() {
        const glm::dvec3 centre = random_.point(60.0);
        const auto group = static_cast<std::uint32_t>(random_(0, 6));
        // Every other one has a range that it never leaves.
        const bool ranged = random_(0, 1) < 0.5;
        State state{centre, 0.0};
        if (ranged) state.low = centre - 4.0, state.high = centre + 4.0;
        const ObjectId object =
            ranged ? objects_.add(box_at(centre), group, MotionPromise{kSpeed, box_at(centre, 4.5)})
                   : objects_.add(box_at(centre), group, kSpeed);
        ASSERT_FALSE(alive_.contains(object));
        alive_[object] = state;
    }

    /// All that may be seen is drawn exactly once, and what hangs on a query is in its boxes.
    void check(const Frustum& frustum) {
        std::vector<int> drawn(objects_.slot_count());
        std::vector<const PlannedQuery*> query(objects_.slot_count());
        for (const ObjectId object : plan_.objects) ++drawn[index_of(object)];
        for (const ConditionalObject& object : plan_.conditional_objects) {
            ++drawn[index_of(object.object)];
            query[index_of(object.object)] = &plan_.queries[object.query];
            ++conditional;
        }
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            const auto object = alive_.find(ObjectId{static_cast<std::uint32_t>(i)});
            ASSERT_LE(drawn[i], object == alive_.end() ? 0 : 1);
            if (object == alive_.end()) continue;
            const Aabb box = box_at(object->second.centre);
            PlaneMask mask = frustum.mask;
            if (classify(frustum, box, mask) == Containment::Outside) continue;
            ASSERT_EQ(drawn[i], 1);
            ++visible;
            if (query[i] == nullptr) continue;
            const auto boxes = std::span(plan_.query_boxes).subspan(query[i]->first_box, query[i]->box_count);
            ASSERT_TRUE(std::ranges::any_of(boxes, [&](const Aabb& asked) {
                return glm::all(glm::lessThanEqual(asked.min, box.min)) &&
                       glm::all(glm::lessThanEqual(box.max, asked.max));
            }));
        }
    }

    Uniform random_;
    RhOctree octree_ = build_octree({}, {}).value();
    RhviewPlanner planner_;
    MovingObjects objects_;
    FakeGpu gpu_;
    FramePlan plan_;
    std::map<ObjectId, State> alive_;
    std::vector<ObjectId> due_;
};

TEST(MovingObjects, over_a_million_moves_insertions_and_removals_what_is_visible_is_drawn_exactly_once) {
    RandomWorld world(9);
    constexpr int kFrames = 1000, kChanges = 1000;
    for (int frame = 0; frame < kFrames; ++frame) {
        for (int change = 0; change < kChanges; ++change) world.change_something();
        world.frame(frame * RandomWorld::kStep);
        if (testing::Test::HasFatalFailure()) FAIL() << "frame " << frame;
    }
    EXPECT_GT(world.visible, 100'000u);
    EXPECT_GT(world.conditional, 3'000u);
    EXPECT_GT(world.asleep, 500'000u);
}

}  // namespace
}  // namespace rhview
