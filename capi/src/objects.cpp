// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <cmath>

#include "border.h"
#include "scene.h"
#include "view.h"

namespace rhview::capi {
namespace {

bool is_box(const rhview_box& box) {
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(box.min[axis]) || !std::isfinite(box.max[axis]) ||
            !(box.min[axis] <= box.max[axis]))
            return false;
    return true;
}

Aabb aabb_of(const rhview_box& box) {
    return {{box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2]}};
}

rhview_status fail_box() {
    return fail(RHVIEW_INVALID_ARGUMENT, "rhview_box: a corner is not finite, or min is above max");
}

rhview_status fail_null() {
    return fail(RHVIEW_INVALID_ARGUMENT, "an argument is null");
}

/// Whether there is such an object.
rhview_status find_object(const rhview_scene* scene, std::uint32_t number) {
    if (scene == nullptr) return fail_null();
    if (number >= scene->state->max_objects() || !scene->state->has_object[number])
        return fail(RHVIEW_INVALID_ARGUMENT, "no object has this number");
    return RHVIEW_OK;
}

rhview_status place_object(rhview_scene* scene, std::uint32_t number, const rhview_box* box, bool jumps) {
    return guarded([&] {
        if (const rhview_status status = find_object(scene, number); status != RHVIEW_OK) return status;
        if (box == nullptr) return fail_null();
        if (!is_box(*box)) return fail_box();
        MovingObjects& objects = scene->state->objects;
        if (jumps) {
            objects.teleport(ObjectId{number}, aabb_of(*box));
        } else {
            objects.move(ObjectId{number}, aabb_of(*box));
        }
        return rhview_status{RHVIEW_OK};
    });
}

MotionPromise promise_of(const rhview_object& object) {
    MotionPromise promise;
    if (object.top_speed > 0.0) promise.top_speed = object.top_speed;
    if (object.has_range != 0) promise.range = aabb_of(object.range);
    return promise;
}

LevelledObject levelled_of(const rhview_object& object) {
    if (object.has_chain == 0) return {};
    return {object.chain, object.scale == 0.0 ? 1.0f : static_cast<float>(object.scale)};
}

rhview_status add_object(Scene& scene, const rhview_object& object, std::uint32_t& number) {
    if (!is_box(object.box) || (object.has_range != 0 && !is_box(object.range))) return fail_box();
    if (!(object.top_speed >= 0.0))
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_object: top_speed is negative or no number");
    if (!(object.scale >= 0.0 && std::isfinite(object.scale)))
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_object: scale is negative or no number");
    if (object.has_chain != 0 && (!scene.chains || object.chain >= scene.chains->size()))
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_object: the scene has no such chain");
    if (scene.object_count == scene.max_objects())
        return fail(RHVIEW_WRONG_STATE,
                    "there are as many objects as rhview_scene_options::max_objects allows");
    number =
        static_cast<std::uint32_t>(scene.objects.add(aabb_of(object.box), object.group, promise_of(object)));
    scene.object_indices[number] = object.index_count;
    scene.levelled[number] = levelled_of(object);
    for (View* view : scene.views) view->set_levelled(ObjectId{number}, scene.levelled[number]);
    scene.has_object[number] = true;
    ++scene.object_count;
    return RHVIEW_OK;
}

}  // namespace
}  // namespace rhview::capi

using namespace rhview::capi;

rhview_status rhview_scene_add_object(rhview_scene* scene, const rhview_object* object, uint32_t* number) {
    return guarded([&] {
        if (scene == nullptr || object == nullptr || number == nullptr) return fail_null();
        rhview_object taken;
        if (const rhview_status status = take(object, "rhview_object", taken); status != RHVIEW_OK)
            return status;
        return add_object(*scene->state, taken, *number);
    });
}

rhview_status rhview_scene_remove_object(rhview_scene* scene, uint32_t number) {
    return guarded([&] {
        if (const rhview_status status = find_object(scene, number); status != RHVIEW_OK) return status;
        scene->state->objects.remove(rhview::ObjectId{number});
        scene->state->has_object[number] = false;
        --scene->state->object_count;
        return rhview_status{RHVIEW_OK};
    });
}

rhview_status rhview_scene_begin_frame(rhview_scene* scene, double time_s) {
    return guarded([&] {
        if (scene == nullptr) return fail_null();
        if (!std::isfinite(time_s) || time_s < scene->state->time_s)
            return fail(RHVIEW_INVALID_ARGUMENT, "time_s is no number, or before the last frame's");
        scene->state->time_s = time_s;
        scene->state->objects.begin_frame(time_s);
        return rhview_status{RHVIEW_OK};
    });
}

rhview_status rhview_scene_due_objects(rhview_scene* scene, const uint32_t** numbers, size_t* count) {
    return guarded([&] {
        if (scene == nullptr || numbers == nullptr || count == nullptr) return fail_null();
        scene->state->due.clear();
        // What was removed in this frame stays on the planner's list until the next one.
        for (const rhview::ObjectId object : scene->state->objects.due())
            if (scene->state->has_object[rhview::index_of(object)])
                scene->state->due.push_back(static_cast<std::uint32_t>(object));
        *numbers = scene->state->due.data();
        *count = scene->state->due.size();
        return rhview_status{RHVIEW_OK};
    });
}

rhview_status rhview_scene_move_object(rhview_scene* scene, uint32_t number, const rhview_box* box) {
    return place_object(scene, number, box, false);
}

rhview_status rhview_scene_jump_object(rhview_scene* scene, uint32_t number, const rhview_box* box) {
    return place_object(scene, number, box, true);
}

rhview_status rhview_scene_end_frame(rhview_scene* scene) {
    return guarded([&] {
        if (scene == nullptr) return fail_null();
        Scene& state = *scene->state;
        rhview::FrameInput input;
        state.objects.describe(input);
        std::vector<const rhview::FramePlan*>& plans = state.plans;
        plans.clear();
        for (View* view : state.views) {
            if (const rhview::FramePlan* plan = view->end_frame(input.new_objects)) plans.push_back(plan);
        }
        state.objects.end_frame_of_views(plans);
        return rhview_status{RHVIEW_OK};
    });
}
