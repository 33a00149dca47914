// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Calls about views and their plans.

#include "c_api_calls.h"
#include "rhview/base/view.h"

namespace rhview {

void Session::create_view(RecordBytes& bytes) {
    ViewSlot& slot = view(bytes);
    if (slot.handle != nullptr) return;
    const SceneSlot& of = scene(bytes);
    rhview_view_options options{};
    options.occlusion = bytes.below(4);
    const std::array band_ends{bytes.number(1.0), bytes.number(300.0)};
    const std::uint32_t bands = bytes.below(5);
    options.band_count = bands < 3 ? bands : 65'535u * (bands - 2);
    options.band_ends = bytes.next() == 1 ? nullptr : band_ends.data();
    options.band_hysteresis = bytes.number(0.0);
    const Given view_costs(costs(bytes), bytes);
    options.costs = view_costs.get();
    const Given given(options, bytes);
    rhview_view* made = nullptr;
    if (is_ok(rhview_view_create(of.handle, given.get(), bytes.next() == 1 ? nullptr : &made)))
        slot = {made, of.model};
    else
        demand(made == nullptr);
}

void Session::destroy_view(RecordBytes& bytes) {
    ViewSlot& slot = view(bytes);
    rhview_view_destroy(slot.handle);
    slot = {};
}

void Session::set_levels(RecordBytes& bytes) {
    const ViewSlot& slot = view(bytes);
    rhview_level_bounds bounds{};
    bounds.max_error_px = bytes.number(1.0);
    bounds.budget_ns = bytes.number(0.0);
    bounds.object_ns = bytes.number(0.0);
    const Given given(bounds, bytes);
    is_ok(rhview_view_set_levels(slot.handle, given.get()));
}

void Session::set_camera(RecordBytes& bytes) {
    const ViewSlot& slot = view(bytes);
    rhview_camera camera{};
    camera.clip_depth = bytes.below(4);
    const auto depth = static_cast<ClipDepth>(std::min(camera.clip_depth, 2u));
    const glm::dmat4 clip = perspective(1.0, 1.5, 0.1, 500.0, depth);
    for (int i = 0; i < 16; ++i) {
        camera.camera_from_world[i] = i % 5 == 0 ? 1.0 : 0.0;
        camera.clip_from_camera[i] = clip[i / 4][i % 4];
    }
    const std::uint32_t changed = bytes.next();
    const double value = bytes.number(0.0);
    if (changed >= 1 && changed <= 16) camera.camera_from_world[changed - 1] = value;
    if (changed > 16 && changed <= 32) camera.clip_from_camera[changed - 17] = value;
    camera.viewport_width = 64u << bytes.below(27);
    camera.viewport_height = bytes.next() == 1 ? 0 : 64;
    const Given given(camera, bytes);
    is_ok(rhview_view_set_camera(slot.handle, given.get()));
}

void Session::check_objects(const SceneModel& model, const rhview_plan& plan) {
    const auto is_there = [&](std::uint32_t object) {
        return object < model.has_object.size() && model.has_object[object];
    };
    for (std::size_t i = 0; i < plan.object_count; ++i) demand(is_there(plan.objects[i].object));
    for (std::size_t i = 0; i < plan.conditional_object_count; ++i)
        demand(is_there(plan.conditional_objects[i].object) &&
               plan.conditional_objects[i].query < plan.query_count);
}

void Session::check_plan(const ViewSlot& slot) {
    rhview_plan plan{};
    plan.size = sizeof plan;
    demand(rhview_view_plan(slot.handle, &plan) == RHVIEW_OK);
    const auto is_within = [&](const rhview_draw& draw) {
        return draw.batch < slot.model->batch_count && draw.index_count % 3 == 0 &&
               std::uint64_t{draw.first_index} + draw.index_count <= slot.model->index_count;
    };
    for (std::size_t i = 0; i < plan.draw_count; ++i) demand(is_within(plan.draws[i]));
    for (std::size_t i = 0; i < plan.conditional_draw_count; ++i)
        demand(is_within(plan.conditional_draws[i].draw) &&
               plan.conditional_draws[i].query < plan.query_count);
    for (std::size_t i = 0; i < plan.query_count; ++i) {
        const rhview_query& query = plan.queries[i];
        demand(std::uint64_t{query.first_box} + query.box_count <= plan.box_count && query.way <= 1);
        if (tickets_.size() < 64) tickets_.push_back(query.ticket);
    }
    check_objects(*slot.model, plan);
}

void Session::plan_views(RecordBytes& bytes) {
    const std::uint32_t count = (bytes.next() + 1u) % 5;
    std::array<rhview_view*, 4> handles{};
    std::array<std::size_t, 4> slots{};
    for (std::uint32_t i = 0; i < count; ++i) {
        slots[i] = bytes.below(views_.size());
        handles[i] = views_[slots[i]].handle;
    }
    const Given threads(workers(bytes), bytes);
    if (!is_ok(rhview_plan_views(bytes.next() == 1 ? nullptr : handles.data(), count, threads.get()))) return;
    for (std::uint32_t i = 0; i < count; ++i) check_plan(views_[slots[i]]);
}

void Session::get_plan(RecordBytes& bytes) {
    const ViewSlot& slot = view(bytes);
    const Given given(to_fill<rhview_plan>(), bytes);
    fills(rhview_view_plan(slot.handle, given.get()), given);
}

void Session::widen_boxes(RecordBytes& bytes) {
    const ViewSlot& slot = view(bytes);
    rhview_raster raster{};
    raster.subpixel_bits = bytes.below(20);
    raster.depth_step = bytes.number(0.0);
    raster.rounding_growth = bytes.number(0.0);
    const Given given(raster, bytes);
    const Given lens(to_fill<rhview_box_lens>(), bytes);
    const rhview_wide_box* boxes = nullptr;
    std::size_t count = 0;
    const rhview_status status = rhview_view_widen_boxes(slot.handle, given.get(), lens.get(),
                                                         bytes.next() == 1 ? nullptr : &boxes, &count);
    fills(status, lens);
    rhview_plan plan{};
    plan.size = sizeof plan;
    if (status != RHVIEW_OK) return demand(boxes == nullptr && count == 0);
    demand(rhview_view_plan(slot.handle, &plan) == RHVIEW_OK && count == plan.box_count);
    for (std::size_t i = 0; i < count; ++i)
        demand(boxes[i].faces >> 8 < std::max<std::size_t>(plan.query_count, 1));
}

void Session::absorb(RecordBytes& bytes) {
    const ViewSlot& slot = view(bytes);
    const std::uint32_t count = bytes.below(5);
    std::array<rhview_answer, 4> answers{};
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint8_t choice = bytes.next();
        const bool is_known = choice < 200 && !tickets_.empty();
        answers[i] = {is_known ? tickets_[choice % tickets_.size()] : bytes.next(), bytes.below(2), 0};
    }
    is_ok(rhview_view_absorb(slot.handle, bytes.next() == 1 ? nullptr : answers.data(), count));
}

void Session::ask_what_was_seen(RecordBytes& bytes) {
    const ViewSlot& slot = view(bytes);
    const Given changes(to_fill<rhview_changes>(), bytes);
    fills(rhview_view_changes(slot.handle, changes.get()), changes);
    const std::uint32_t number = bytes.next() == 255 ? 0xffffffffu : bytes.next();
    const Given state(to_fill<rhview_object_state>(), bytes);
    fills(rhview_view_object_state(slot.handle, number, state.get()), state);
}

}  // namespace rhview
