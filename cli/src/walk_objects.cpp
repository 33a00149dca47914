// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "walk_objects.h"

#include <algorithm>

#include "rhview/base/prefetch.h"
#include "rhview/pipeline/query_boxes.h"

namespace rhview::cli {
namespace {

/// A turn about the vertical multiplies sums of magnitudes along rows, and those of its inverse, by up to √2
/// each; and rounding.
constexpr double kTurning = 2.0 + 1e-9;

}  // namespace

WalkObjects::WalkObjects(const Scene& scene) : scene_(scene), groups_(object_groups(scene)), ways_(scene) {
    place_all(0.0);
    for (std::size_t i = 0; i < placements_.scene_from_mesh.size(); ++i) {
        const double growth = rounding_growth(placements_.scene_from_mesh[i]);
        const bool turns = i < scene.dynamic_objects.size();
        largest_growth_ = std::max(largest_growth_, turns ? kTurning * growth : growth);
    }
}

void WalkObjects::begin(bool sleeping) {
    place_all(0.0);
    movers_.reset();
    if (scene_.dynamic_objects.empty() || !sleeping) return;
    movers_.emplace();
    for (std::uint32_t i = 0; i < scene_.object_count(); ++i)
        movers_->add(placements_.boxes[i], groups_[i],
                     MotionPromise{top_speed(scene_, ObjectId{i}), motion_range(scene_, ObjectId{i})});
}

void WalkObjects::move(double time_s) {
    if (!movers_) return place_all(time_s);
    movers_->begin_frame(time_s);
    for (const ObjectId object : movers_->due()) {
        const Aabb& bounds = scene_.meshes[index_of(scene_.object_mesh(object))].bounds;
        const bool stands = index_of(object) >= scene_.dynamic_objects.size();
        movers_->move(object, stands ? placements_.boxes[index_of(object)]
                                     : transform_box(ways_.placement_at(object, time_s), bounds));
    }
}

FrameInput WalkObjects::input(const View& view, glm::ivec2 viewport) const {
    FrameInput input;
    input.culling_view = view;
    input.scene_origin = scene_.origin;
    input.object_boxes = placements_.boxes;
    input.object_groups = groups_;
    input.viewport_pixels = viewport;
    return input;
}

FrameInput WalkObjects::planner_input(const View& view, glm::ivec2 viewport) const {
    FrameInput planned = input(view, viewport);
    if (movers_) movers_->describe(planned);
    return planned;
}

void WalkObjects::place_planned(const FramePlan& plan, double time_s) {
    if (!movers_) return;
    place(plan.objects.size(), time_s, [&](std::size_t i) { return plan.objects[i]; });
    movers_->end_frame(plan);
}

void WalkObjects::place_late(const FramePlan& plan, std::span<const std::uint32_t> places, double time_s) {
    place(places.size(), time_s, [&](std::size_t i) { return plan.conditional_objects[places[i]].object; });
}

void WalkObjects::place(std::size_t count, double time_s, const auto& object_at) {
    for (std::size_t i = 0; i < count; ++i) {
        if (i + kPrefetchSteps < count) ways_.prefetch(object_at(i + kPrefetchSteps));
        placements_.scene_from_mesh[index_of(object_at(i))] = ways_.placement_at(object_at(i), time_s);
    }
}

std::size_t WalkObjects::count_mesh_levels(const FramePlan& plan) {
    mesh_levels_.clear();
    for (std::size_t i = 0; i < plan.objects.size(); ++i)
        mesh_levels_.push_back(std::uint64_t{groups_[index_of(plan.objects[i])]} << 8 |
                               plan.level_of_object(i));
    std::ranges::sort(mesh_levels_);
    const auto repeated = std::ranges::unique(mesh_levels_);
    return mesh_levels_.size() - repeated.size();
}

}  // namespace rhview::cli
