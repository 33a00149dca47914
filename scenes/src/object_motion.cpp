// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/object_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "rhview/base/assert.h"
#include "rhview/base/prefetch.h"
#include "shapes.h"

namespace rhview {
namespace {

/// The speeds of the segments are rounded up by this.
constexpr double kRoundingUp = 1.0 + 1e-9;
/// Of the largest coordinate: more than rounding to float and a placement's arithmetic take.
constexpr double kBoxRounding = 1e-6;

struct Pose {
    glm::dvec3 offset{0.0};
    double turns = 0.0;
};

double time_within(double period_s, double time_s) {
    const double time = std::fmod(time_s, period_s);
    return time < 0.0 ? time + period_s : time;
}

/// The first key after a time of the way; null at its very end.
const MotionKey* key_after(const ObjectMotion& motion, double time) {
    const auto next =
        std::upper_bound(motion.keys.begin(), motion.keys.end(), time,
                         [](double wanted, const MotionKey& key) { return wanted < key.time_s; });
    return next == motion.keys.end() ? nullptr : &*next;
}

Pose pose_at(const ObjectMotion& motion, double time_s) {
    const double time = time_within(motion.keys.back().time_s, time_s);
    const MotionKey* next = key_after(motion, time);
    if (next == nullptr) return {};
    const MotionKey& a = *(next - 1);
    const MotionKey& b = *next;
    const double t = (time - a.time_s) / (b.time_s - a.time_s);
    return {a.offset + t * (b.offset - a.offset), a.turns + t * (b.turns - a.turns)};
}

const DynamicObject* moving_object(const Scene& scene, ObjectId object) {
    if (index_of(object) >= scene.dynamic_objects.size()) return nullptr;
    const DynamicObject& dynamic = scene.dynamic_objects[index_of(object)];
    return dynamic.motion == DynamicObject::kStill ? nullptr : &dynamic;
}

glm::dmat4 moved(const glm::dmat4x3& start, const Pose& pose) {
    const CosSin turn = cos_sin_of_turns(pose.turns);
    glm::dmat4 placement(start);
    for (int column = 0; column < 3; ++column) {
        const glm::dvec3 axis(start[column]);
        placement[column].x = turn.cos * axis.x + turn.sin * axis.z;
        placement[column].z = turn.cos * axis.z - turn.sin * axis.x;
    }
    placement[3] += glm::dvec4(pose.offset, 0.0);
    return placement;
}

/// How far corners of the mesh's box are from the axis that the object turns about.
double reach_of(const Scene& scene, const DynamicObject& object) {
    const Aabb& box = scene.meshes[index_of(object.mesh)].bounds;
    double reach = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                               corner & 4 ? box.max.z : box.min.z);
        const glm::dvec3 arm = glm::dmat3(object.scene_from_mesh) * place;
        reach = std::max(reach, std::sqrt(arm.x * arm.x + arm.z * arm.z));
    }
    return reach;
}

}  // namespace

glm::dmat4 placement_at(const Scene& scene, ObjectId object, double time_s) {
    const DynamicObject* moving = moving_object(scene, object);
    if (moving == nullptr) return scene.object_placement(object);
    return moved(glm::dmat4x3(moving->scene_from_mesh), pose_at(scene.motions[moving->motion], time_s));
}

double top_speed(const Scene& scene, ObjectId object) {
    const DynamicObject* moving = moving_object(scene, object);
    if (moving == nullptr) return 0.0;
    const double swing = 2.0 * std::numbers::pi * reach_of(scene, *moving);
    const std::vector<MotionKey>& keys = scene.motions[moving->motion].keys;
    double speed = 0.0;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        const double way = glm::length(keys[i].offset - keys[i - 1].offset) +
                           swing * std::abs(keys[i].turns - keys[i - 1].turns);
        speed = std::max(speed, way / (keys[i].time_s - keys[i - 1].time_s));
    }
    return speed * kRoundingUp;
}

Aabb motion_range(const Scene& scene, ObjectId object) {
    const Aabb& bounds = scene.meshes[index_of(scene.object_mesh(object))].bounds;
    const Aabb start = transform_box(scene.object_placement(object), bounds);
    const DynamicObject* moving = moving_object(scene, object);
    if (moving == nullptr) return start;
    const glm::dvec3 centre(moving->scene_from_mesh[3]);
    const double reach = reach_of(scene, *moving) * kRoundingUp;
    glm::dvec3 low(start.min), high(start.max);
    const auto grow = [&](const glm::dvec3& offset) {
        low = glm::min(low, glm::dvec3(start.min) + offset);
        high = glm::max(high, glm::dvec3(start.max) + offset);
        // It turns about the vertical through its origin.
        for (const int axis : {0, 2}) {
            low[axis] = std::min(low[axis], centre[axis] + offset[axis] - reach);
            high[axis] = std::max(high[axis], centre[axis] + offset[axis] + reach);
        }
    };
    for (const MotionKey& key : scene.motions[moving->motion].keys) grow(key.offset);
    const glm::dvec3 farthest = glm::max(glm::abs(low), glm::abs(high));
    const double margin = kBoxRounding * std::max({farthest.x, farthest.y, farthest.z});
    return {glm::vec3(low - margin), glm::vec3(high + margin)};
}

ObjectWays::ObjectWays(const Scene& scene) : scene_(scene) {
    parts_.resize(scene.dynamic_objects.size());
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const DynamicObject& object = scene.dynamic_objects[i];
        parts_[i].start = glm::dmat4x3(object.scene_from_mesh);
        parts_[i].motion = object.motion;
        if (object.motion != DynamicObject::kStill)
            parts_[i].period_s = scene.motions[object.motion].keys.back().time_s;
    }
}

/// At the very end of its way an object is where it starts.
void ObjectWays::find_part(Part& part, double time) const {
    const MotionKey* next = key_after(scene_.motions[part.motion], time);
    const MotionKey& b = next == nullptr ? scene_.motions[part.motion].keys.front() : *next;
    const MotionKey& a = next == nullptr ? b : *(next - 1);
    part.from_s = next == nullptr ? time : a.time_s;
    part.to_s = next == nullptr ? time + 1.0 : b.time_s;
    part.offset = a.offset;
    part.step = b.offset - a.offset;
    part.turns = a.turns;
    part.turns_step = b.turns - a.turns;
}

glm::dmat4 ObjectWays::placement_at(ObjectId object, double time_s) {
    if (index_of(object) >= parts_.size()) return scene_.object_placement(object);
    Part& part = parts_[index_of(object)];
    if (part.motion == DynamicObject::kStill) return glm::dmat4(part.start);
    const double time = time_within(part.period_s, time_s);
    if (!(time >= part.from_s && time < part.to_s)) find_part(part, time);
    const double t = (time - part.from_s) / (part.to_s - part.from_s);
    return moved(part.start, {part.offset + t * part.step, part.turns + t * part.turns_step});
}

void ObjectWays::prefetch(ObjectId object) const {
    if (index_of(object) < parts_.size()) rhview::prefetch(&parts_[index_of(object)]);
}

void place_objects(const Scene& scene, double time_s, ObjectPlacements& placements) {
    if (placements.boxes.size() != scene.object_count()) {
        placements.boxes = scene.object_boxes();
        placements.scene_from_mesh.clear();
        for (std::uint32_t i = 0; i < scene.object_count(); ++i)
            placements.scene_from_mesh.push_back(scene.object_placement(ObjectId{i}));
    }
    for (std::size_t i = 0; i < scene.dynamic_objects.size(); ++i) {
        const DynamicObject& object = scene.dynamic_objects[i];
        if (object.motion == DynamicObject::kStill) continue;
        const glm::dmat4 placement =
            moved(glm::dmat4x3(object.scene_from_mesh), pose_at(scene.motions[object.motion], time_s));
        placements.scene_from_mesh[i] = placement;
        placements.boxes[i] = transform_box(placement, scene.meshes[index_of(object.mesh)].bounds);
    }
}

std::vector<std::uint32_t> object_groups(const Scene& scene) {
    std::vector<std::uint32_t> groups;
    groups.reserve(scene.object_count());
    for (std::uint32_t i = 0; i < scene.object_count(); ++i) {
        const bool mirrored = glm::determinant(glm::dmat3(scene.object_placement(ObjectId{i}))) < 0.0;
        groups.push_back(static_cast<std::uint32_t>(2 * index_of(scene.object_mesh(ObjectId{i}))) +
                         (mirrored ? 1u : 0u));
    }
    return groups;
}

const char* problem_of(const ObjectMotion& motion) {
    const std::vector<MotionKey>& keys = motion.keys;
    if (keys.size() < 2) return "it has fewer than two keys";
    const auto is_start = [](const MotionKey& key) {
        return key.offset == glm::dvec3(0.0) && key.turns == std::floor(key.turns);
    };
    if (keys.front().time_s != 0.0 || keys.front().turns != 0.0 || !is_start(keys.front()))
        return "its first key is not the start";
    if (!is_start(keys.back())) return "its last key does not close it";
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const glm::dvec3& offset = keys[i].offset;
        if (!std::isfinite(keys[i].time_s) || !std::isfinite(keys[i].turns) || !std::isfinite(offset.x) ||
            !std::isfinite(offset.y) || !std::isfinite(offset.z))
            return "a key is not finite";
        if (i > 0 && !(keys[i].time_s > keys[i - 1].time_s)) return "its times don't rise";
    }
    return nullptr;
}

}  // namespace rhview
