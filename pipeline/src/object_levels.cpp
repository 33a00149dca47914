// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/pipeline/object_levels.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>

#include "rhview/base/assert.h"
#include "rhview/lod/projected_error.h"

namespace rhview {
namespace {

float error_px_of(std::span<const LodChain> chains, const LodObject& object, std::uint32_t level) {
    return static_cast<float>(
        projected_error_px(chains[object.chain].levels[level].error, object.pixels_per_unit));
}

}  // namespace

ObjectLevels::ObjectLevels(std::span<const LodChain> chains, std::span<const LevelledObject> objects)
    : chains_(chains), objects_(objects.begin(), objects.end()), selector_(chains) {
    for (const LodChain& chain : chains) RHVIEW_ASSERT(chain.levels.size() <= 255);
    for (LevelledObject& object : objects_) {
        if (object.chain == LevelledObject::kNoChain) continue;
        RHVIEW_ASSERT(object.chain < chains.size());
        if (chains[object.chain].levels.size() < 2) object.chain = LevelledObject::kNoChain;
    }
}

void ObjectLevels::set_object(ObjectId object, const LevelledObject& levelled) {
    RHVIEW_ASSERT(levelled.chain == LevelledObject::kNoChain || levelled.chain < chains_.size());
    if (index_of(object) >= objects_.size()) objects_.resize(index_of(object) + 1);
    objects_[index_of(object)] = levelled;
}

/// Null: of full detail, always.
const LevelledObject* ObjectLevels::find(ObjectId object) const {
    if (index_of(object) >= objects_.size()) return nullptr;
    const LevelledObject& levelled = objects_[index_of(object)];
    return levelled.chain != LevelledObject::kNoChain ? &levelled : nullptr;
}

std::uint32_t ObjectLevels::indices(ObjectId object, std::uint32_t whole) const {
    return index_of(object) < levels_.size() ? indices_at(object, levels_[index_of(object)], whole) : whole;
}

std::uint32_t ObjectLevels::indices_at(ObjectId object, std::uint8_t level, std::uint32_t whole) const {
    const LevelledObject* levelled = find(object);
    return levelled == nullptr ? whole : chains_[levelled->chain].levels[level].index_count;
}

ObjectLevels::Lens ObjectLevels::lens_of(const FrameInput& input) {
    return {input.culling_view.clip_from_eye_relative(), input.culling_view.eye() - input.scene_origin,
            static_cast<double>(input.viewport_pixels.x), static_cast<double>(input.viewport_pixels.y)};
}

double ObjectLevels::pixels_per_scene_unit(const Lens& lens, const Aabb& box, double& size_px) {
    BoundingSphere sphere = sphere_of(box);
    sphere.centre -= lens.eye;
    const double pixels = pixels_per_unit(lens.clip_from_relative, sphere, lens.width_px, lens.height_px);
    const double radius_px = pixels * sphere.radius;
    size_px = std::min(std::numbers::pi * radius_px * radius_px, lens.width_px * lens.height_px);
    return pixels;
}

void ObjectLevels::begin(const FrameInput& input) {
    for (const std::uint32_t object : given_levels_) levels_[object] = 0, errors_px_[object] = 0.0f;
    given_levels_.clear();
    levels_.resize(input.object_boxes.size(), 0);
    errors_px_.resize(input.object_boxes.size(), 0.0f);
    for (const ObjectId object : input.new_objects) {
        selector_.forget(static_cast<std::uint32_t>(object));
        fragments_.forget(object);
    }
}

void ObjectLevels::add(const FrameInput& input, const Lens& lens, const LevelOptions& options,
                       ObjectId object) {
    const LevelledObject* levelled = find(object);
    if (levelled == nullptr) return;
    LodObject& asked = asked_.emplace_back();
    asked.slot = static_cast<std::uint32_t>(object);
    asked.chain = levelled->chain;
    asked.pixels_per_unit =
        levelled->scale * pixels_per_scene_unit(lens, input.object_boxes[index_of(object)], asked.size_px);
    if (options.policy == LodPolicy::Fragments) asked.fragments = fragments_.of(object);
}

void ObjectLevels::select(const LevelOptions& options) {
    selection_options_.policy = options.policy;
    selection_options_.max_error_px = options.max_error_px;
    selection_options_.triangles_per_fragment = options.triangles_per_fragment;
    selection_options_.budget_ns = options.budget_ns;
    selection_options_.costs = options.costs;
    selector_.select(asked_, selection_options_, selection_);
    for (std::size_t i = 0; i < asked_.size(); ++i) {
        const std::uint32_t level = selection_.levels[i], object = asked_[i].slot;
        if (level == 0) continue;
        set_level(object, static_cast<std::uint8_t>(level), error_px_of(chains_, asked_[i], level));
    }
}

void ObjectLevels::set_level(std::uint32_t object, std::uint8_t level, float error_px) {
    levels_[object] = level;
    errors_px_[object] = error_px;
    given_levels_.push_back(object);
}

LevelSummary ObjectLevels::choose(const FrameInput& input, const LevelOptions& options) {
    begin(input);
    const Lens lens = lens_of(input);
    in_view_.clear();
    append_visible_objects(make_frustum(input.culling_view, input.scene_origin), input.object_boxes, in_view_,
                           input.object_alive);
    asked_.clear();
    for (const ObjectId object : in_view_) add(input, lens, options, object);
    select(options);
    return {selection_.max_error_px, selection_.cost_ns, selection_.indices, selection_.bound_met,
            selection_.budget_met};
}

LevelSummary ObjectLevels::select_at_once(const FrameInput& input, const LevelOptions& options,
                                          const FramePlan& plan) {
    begin(input);
    const Lens lens = lens_of(input);
    asked_.clear();
    for (const ObjectId object : plan.objects) add(input, lens, options, object);
    select(options);
    const LevelSummary summary{selection_.max_error_px, selection_.cost_ns, selection_.indices,
                               selection_.bound_met, selection_.budget_met};
    late_lens_ = lens;
    late_options_ = options;
    late_options_.budget_ns = std::numeric_limits<double>::infinity();
    if (std::isfinite(options.budget_ns) && std::isfinite(summary.max_error_px))
        late_options_.max_error_px = std::max(options.max_error_px, summary.max_error_px);
    if (options.policy == LodPolicy::Fragments) fragments_.expect(plan);
    return summary;
}

LevelSummary ObjectLevels::choose_at_once(const FrameInput& input, const LevelOptions& options,
                                          FramePlan& plan) {
    const LevelSummary summary = select_at_once(input, options, plan);
    plan.object_levels.clear();
    if (given_levels_.empty()) return summary;
    for (const ObjectId object : plan.objects) plan.object_levels.push_back(levels_[index_of(object)]);
    sorter_.sort_at_once(input.object_groups, plan);
    return summary;
}

LevelSummary ObjectLevels::choose(const FrameInput& input, const LevelOptions& options, FramePlan& plan) {
    const LevelSummary summary = select_at_once(input, options, plan);
    asked_.clear();
    for (const ConditionalObject& object : plan.conditional_objects)
        add(input, late_lens_, late_options_, object.object);
    select(late_options_);
    plan.object_levels.clear();
    if (given_levels_.empty()) return summary;
    for (const ObjectId object : plan.objects) plan.object_levels.push_back(levels_[index_of(object)]);
    for (ConditionalObject& object : plan.conditional_objects)
        object.level = levels_[index_of(object.object)];
    sorter_.sort(input.object_groups, plan);
    return summary;
}

void ObjectLevels::choose_late(const FrameInput& input, FramePlan& plan, std::span<std::uint32_t> places) {
    for (const std::uint32_t place : places) {
        ConditionalObject& object = plan.conditional_objects[place];
        asked_.clear();
        add(input, late_lens_, late_options_, object.object);
        if (asked_.empty() || !(late_options_.max_error_px > 0.0)) continue;
        object.level =
            level_within(*find(object.object), asked_[0].pixels_per_unit, late_options_.max_error_px);
        if (object.level > 0)
            set_level(asked_[0].slot, object.level, error_px_of(chains_, asked_[0], object.level));
    }
    places_.assign(places.begin(), places.end());
    sorter_.sort_places(input.object_groups, plan.conditional_objects, places_);
    std::ranges::copy(places_, places.begin());
}

std::uint8_t ObjectLevels::level_within(const LevelledObject& object, double pixels_per_unit,
                                        double max_error_px) const {
    const std::span<const LodLevel> levels = chains_[object.chain].levels;
    std::uint8_t level = 0;
    while (level + std::size_t{1} < levels.size() &&
           projected_error_px(levels[level + std::size_t{1}].error, pixels_per_unit) <= max_error_px)
        ++level;
    return level;
}

std::uint8_t ObjectLevels::level_by_bound(const FrameInput& input, ObjectId object) const {
    const LevelledObject* levelled = find(object);
    if (levelled == nullptr || !(late_options_.max_error_px > 0.0)) return 0;
    double size_px = 0.0;
    const double pixels =
        levelled->scale * pixels_per_scene_unit(late_lens_, input.object_boxes[index_of(object)], size_px);
    return level_within(*levelled, pixels, late_options_.max_error_px);
}

void ObjectLevels::complete(const FrameInput& input, const LevelOptions& options, const FramePlan& plan,
                            std::vector<std::uint8_t>& levels) const {
    levels.assign(input.object_boxes.size(), 0);
    const Lens lens = lens_of(input);
    for (std::uint32_t i = 0; i < levels.size(); ++i) {
        const LevelledObject* object = find(ObjectId{i});
        if (object == nullptr || !(options.max_error_px > 0.0)) continue;
        double size_px = 0.0;
        const double pixels = object->scale * pixels_per_scene_unit(lens, input.object_boxes[i], size_px);
        levels[i] = level_within(*object, pixels, options.max_error_px);
    }
    for (std::size_t i = 0; i < plan.objects.size(); ++i)
        levels[index_of(plan.objects[i])] = plan.level_of_object(i);
    for (const ConditionalObject& object : plan.conditional_objects)
        levels[index_of(object.object)] = object.level;
}

}  // namespace rhview
