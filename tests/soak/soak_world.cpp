// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "soak_world.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "catalogue/yard.h"
#include "rhview/scenes/object_motion.h"

namespace rhview {
namespace {

constexpr double kReach = 34.0;  ///< of the yard that objects wander in
constexpr double kTopSpeed = 6.0;
constexpr double kLifeSeconds = 4.0;  ///< of an object, on average
constexpr int kObjects = 80;

/// There and back between -`kReach` and `kReach`.
double folded(double x) {
    const double period = 4.0 * kReach;
    const double in_period = x + kReach - period * std::floor((x + kReach) / period);
    return in_period < 2.0 * kReach ? in_period - kReach : 3.0 * kReach - in_period;
}

Scene soak_scene() {
    Yard yard;
    yard.add_boxes(30, 10.0);
    yard.add_clutter(500);
    for (int i = 0; i < kObjects; ++i) yard.add_object(glm::dvec3(0.0), glm::dmat3(1.0));
    return yard.finish().scene;
}

}  // namespace

SoakWorld::SoakWorld()
    : scene_(soak_scene()),
      wanderers_(scene_.object_count()),
      placements_(scene_.object_count(), glm::dmat4(1.0)),
      groups_(object_groups(scene_)),
      exact_boxes_(scene_.object_count()) {
    for (int i = 0; i < kObjects / 2; ++i) come();
}

void SoakWorld::come() {
    std::size_t object = 0;
    while (object < wanderers_.size() && wanderers_[object].alive) ++object;
    if (object == wanderers_.size()) return;
    const glm::dvec3 direction = uniform_.point(1.0);
    wanderers_[object] = {uniform_.point(kReach), uniform_(0.0, 0.99) * kTopSpeed / 1.8 * direction, time_s_,
                          true};
    // The lowest number that is free is the one that it gets, whose mesh the scene knows.
    const ObjectId number = movers_.add(box_of(object), groups_[object], kTopSpeed);
    RHVIEW_ASSERT(index_of(number) == object);
    static_cast<void>(number);
    ++came_;
}

void SoakWorld::go() {
    const auto first = static_cast<std::size_t>(uniform_(0, static_cast<double>(wanderers_.size())));
    for (std::size_t i = 0; i < wanderers_.size(); ++i) {
        const std::size_t object = (first + i) % wanderers_.size();
        if (!wanderers_[object].alive) continue;
        wanderers_[object].alive = false;
        movers_.remove(ObjectId{static_cast<std::uint32_t>(object)});
        ++went_;
        return;
    }
}

glm::dmat4 SoakWorld::place_of(std::size_t object) const {
    const Wanderer& wanderer = wanderers_[object];
    const glm::dvec3 free = wanderer.start + (time_s_ - wanderer.since_s) * wanderer.velocity;
    return glm::translate(glm::dmat4(1.0), {folded(free.x), folded(free.y), folded(free.z)});
}

Aabb SoakWorld::box_of(std::size_t object) const {
    const ObjectId id{static_cast<std::uint32_t>(object)};
    return transform_box(place_of(object), scene_.meshes[index_of(scene_.object_mesh(id))].bounds);
}

void SoakWorld::begin_frame(std::uint64_t frame) {
    time_s_ = static_cast<double>(frame) * kFrameSeconds;
    const double part = kObjects / 2 * kFrameSeconds / kLifeSeconds;
    if (uniform_(0, 1) < part) go();
    if (uniform_(0, 1) < part) come();
    movers_.begin_frame(time_s_);
    for (const ObjectId object : movers_.due()) movers_.move(object, box_of(index_of(object)));
    for (std::size_t i = 0; i < movers_.slot_count(); ++i)
        slept_ += wanderers_[i].alive && movers_.is_asleep(ObjectId{static_cast<std::uint32_t>(i)}) ? 1 : 0;
}

void SoakWorld::place_planned(const FramePlan& plan) {
    for (const ObjectId object : plan.objects) placements_[index_of(object)] = place_of(index_of(object));
    for (const ConditionalObject& conditional : plan.conditional_objects)
        placements_[index_of(conditional.object)] = place_of(index_of(conditional.object));
}

void SoakWorld::place_all() {
    for (std::size_t i = 0; i < wanderers_.size(); ++i)
        if (wanderers_[i].alive) placements_[i] = place_of(i);
}

void SoakWorld::end_frame(const FramePlan& first, const FramePlan& second) {
    const FramePlan* const plans[] = {&first, &second};
    movers_.end_frame_of_views(plans);
}

FrameInput SoakWorld::input(const View& view, const glm::ivec2& viewport) const {
    FrameInput input;
    input.culling_view = view;
    input.viewport_pixels = viewport;
    movers_.describe(input);
    return input;
}

FrameInput SoakWorld::exact_input(const View& view, const glm::ivec2& viewport) {
    FrameInput exact = input(view, viewport);
    for (std::size_t i = 0; i < exact.object_boxes.size(); ++i) exact_boxes_[i] = box_of(i);
    exact.object_boxes = std::span(exact_boxes_).first(exact.object_boxes.size());
    return exact;
}

View SoakWorld::camera(int number, std::uint64_t frame) {
    const double angle = 0.004 * static_cast<double>(frame) * (number == 0 ? 1.0 : -0.7) + number;
    const double radius = 24.0 + 18.0 * std::sin(0.0013 * static_cast<double>(frame));
    const glm::dvec3 eye(radius * std::cos(angle), 8.0 * std::sin(0.3 * angle), radius * std::sin(angle));
    const glm::dvec3 target(6.0 * std::sin(angle), 0.0, 5.0 * std::cos(2.0 * angle));
    const ClipDepth depth = number == 0 ? ClipDepth::ReversedZeroToOne : ClipDepth::NegativeOneToOne;
    return {look_along(eye, target - eye, {0, 1, 0}), perspective(1.0, 4.0 / 3.0, 0.05, 200.0, depth), depth};
}

}  // namespace rhview
