// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Calls about scenes and what is in them; chains and costs.

#include <cmath>

#include "c_api_calls.h"

namespace rhview {

/// Triangles in a row before the camera, one corner or index of them changed.
Arrays& Session::arrays(RecordBytes& bytes) {
    Arrays& made = *arrays_.emplace_back(std::make_unique<Arrays>());
    for (std::size_t i = 0; i < kVertices; ++i) {
        const auto x = static_cast<float>(i / 3);
        const std::array corner{x + (i % 3 == 1 ? 1.0f : 0.0f), i % 3 == 2 ? 1.0f : 0.0f, -5.0f - x, 0.0f,
                                0.0f};
        made.positions.insert(made.positions.end(), corner.begin(), corner.end());
        made.indices.push_back(static_cast<std::uint32_t>(i));
    }
    made.positions[bytes.below(5 * kVertices)] = bytes.real(0.0f);
    const std::uint32_t changed = bytes.below(kVertices);
    const std::uint8_t value = bytes.next();
    if (value != 0) made.indices[changed] = value < 250 ? value % (kVertices + 1) : 0xffffffffu;
    return made;
}

rhview_costs Session::costs(RecordBytes& bytes) {
    rhview_costs made{};
    made.index_ns = bytes.number(1.0);
    made.draw_ns = bytes.number(60.0);
    made.has_hardware_queries = 1;
    made.hardware_queries = {0.0, bytes.number(0.001), 0.0, 0.0, 0.0};
    made.has_box_pass = bytes.below(2);
    return made;
}

rhview_box Session::box(RecordBytes& bytes) {
    const float x = bytes.real(0.0f);
    return {{x, 0.0f, -20.0f}, {x + 1.0f, bytes.real(1.0f), -19.0f}};
}

rhview_box Session::hull(const rhview_box& a, const rhview_box& b) {
    rhview_box made = a;
    for (int axis = 0; axis < 3; ++axis) {
        if (b.min[axis] < made.min[axis]) made.min[axis] = b.min[axis];
        if (b.max[axis] > made.max[axis]) made.max[axis] = b.max[axis];
    }
    return made;
}

/// `wished`, unless the object stays where it is.
rhview_box Session::place_of(const SceneSlot& slot, std::uint32_t number, const rhview_box& wished) {
    if (slot.handle == nullptr || number >= slot.model->stays.size()) return wished;
    return slot.model->stays[number].value_or(wished);
}

/// A job system of one thread.
rhview_workers Session::workers(RecordBytes& bytes) {
    rhview_workers made{};
    made.thread_count = bytes.next();
    made.run = [](void*, std::uint32_t count, void (*share)(void*, std::uint32_t), void* job) {
        for (std::uint32_t i = count; i-- > 0;) share(job, i);
    };
    return made;
}

void Session::create_scene(RecordBytes& bytes) {
    SceneSlot& slot = scene(bytes);
    if (slot.handle != nullptr) return;
    rhview_scene_options options{};
    const std::uint32_t objects = bytes.next();
    options.max_objects = objects < 250 ? 8 + objects : 0xffffffffu >> (objects - 250);
    options.origin[1] = bytes.number(0.0);
    options.chains = chain(bytes);
    const Given given(options, bytes);
    rhview_scene* made = nullptr;
    if (!is_ok(rhview_scene_create(given.get(), bytes.next() == 1 ? nullptr : &made))) {
        demand(made == nullptr);
        return;
    }
    slot = {made, std::make_shared<SceneModel>()};
}

void Session::add_batch(RecordBytes& bytes) {
    const SceneSlot& slot = scene(bytes);
    const Arrays& source = arrays(bytes);
    const std::array<std::size_t, 4> strides{20, 0, 16, 11};
    rhview_batch batch{};
    batch.positions = bytes.next() == 1 ? nullptr : source.positions.data();
    batch.position_stride = strides[bytes.below(strides.size())];
    batch.vertex_count = kVertices - bytes.below(kVertices + 1);
    batch.indices = bytes.next() == 1 ? nullptr : source.indices.data();
    batch.index_count = kVertices - bytes.below(kVertices + 1);
    batch.index_bytes = bytes.below(6);
    const Given given(batch, bytes);
    std::uint32_t number = 77;
    if (is_ok(rhview_scene_add_batch(slot.handle, given.get(), bytes.next() == 1 ? nullptr : &number))) {
        demand(number == 77 || number == slot.model->batch_count);
        ++slot.model->batch_count;
    } else {
        demand(number == 77);
    }
}

void Session::build_scene(RecordBytes& bytes) {
    const SceneSlot& slot = scene(bytes);
    rhview_build_options options{};
    const std::uint32_t leaf = bytes.next();
    options.max_leaf_triangles = leaf;
    options.has_no_replicas = bytes.below(2);
    std::uint32_t patience = bytes.next() == 1 ? 0 : 1000;
    options.progress = [](void* user, double share) {
        demand(share >= 0.0 && share <= 1.0);
        if (user == nullptr) return 1;  // of a structure that ends before it
        auto& left = *static_cast<std::uint32_t*>(user);
        return left == 0 ? 0 : static_cast<std::int32_t>(left--);
    };
    options.progress_user = &patience;
    const Given build_costs(costs(bytes), bytes);
    const Given threads(workers(bytes), bytes);
    options.costs = build_costs.get();
    options.workers = threads.get();
    const Given given(options, bytes);
    if (!is_ok(rhview_scene_build(slot.handle, given.get()))) return;
    const std::uint32_t* indices = nullptr;
    demand(rhview_scene_indices(slot.handle, &indices, &slot.model->index_count) == RHVIEW_OK);
    for (std::size_t i = 0; i < slot.model->index_count; ++i) demand(indices[i] < kVertices);
}

void Session::scene_indices(RecordBytes& bytes) {
    const SceneSlot& slot = scene(bytes);
    const std::uint32_t* indices = nullptr;
    std::size_t count = 77;
    if (!is_ok(rhview_scene_indices(slot.handle, bytes.next() == 1 ? nullptr : &indices,
                                    bytes.next() == 1 ? nullptr : &count)))
        demand(indices == nullptr && count == 77);
    else
        demand(count == slot.model->index_count);
}

void Session::destroy_scene(RecordBytes& bytes) {
    SceneSlot& slot = scene(bytes);
    rhview_scene_destroy(slot.handle);
    slot = {};
}

void Session::add_object(RecordBytes& bytes) {
    const SceneSlot& slot = scene(bytes);
    rhview_object object{};
    object.box = box(bytes);
    object.index_count = 300;
    object.top_speed = bytes.number(0.0);
    object.has_chain = bytes.below(2);
    object.chain = bytes.below(3);
    object.scale = bytes.number(0.0);
    object.has_range = bytes.below(2);
    if (object.has_range != 0) object.range = hull(object.box, box(bytes));
    object.group = bytes.below(3);
    const Given given(object, bytes);
    std::uint32_t number = 0xffffffffu;
    if (!is_ok(rhview_scene_add_object(slot.handle, given.get(), bytes.next() == 1 ? nullptr : &number))) {
        demand(number == 0xffffffffu);
        return;
    }
    std::vector<bool>& has = slot.model->has_object;
    const auto lowest = static_cast<std::size_t>(std::ranges::find(has, false) - has.begin());
    demand(number == lowest);
    has.resize(std::max<std::size_t>(has.size(), number + 1u));
    has[number] = true;
    slot.model->stays.resize(has.size());
    slot.model->stays[number].reset();
    // Of a shorter structure the promises may be missing: then it stays for nothing.
    if (object.has_range != 0 || (object.top_speed > 0.0 && std::isfinite(object.top_speed)))
        slot.model->stays[number] = object.box;
}

void Session::remove_object(RecordBytes& bytes) {
    const SceneSlot& slot = scene(bytes);
    const std::uint32_t number = bytes.next() == 255 ? 0xffffffffu : bytes.next();
    const bool is_there =
        slot.handle != nullptr && number < slot.model->has_object.size() && slot.model->has_object[number];
    demand(is_ok(rhview_scene_remove_object(slot.handle, number)) == is_there);
    if (is_there) slot.model->has_object[number] = false;
}

void Session::begin_frame(RecordBytes& bytes) {
    const SceneSlot& slot = scene(bytes);
    is_ok(rhview_scene_begin_frame(slot.handle, bytes.number(0.0)));
}

void Session::due_objects(RecordBytes& bytes) {
    const SceneSlot& slot = scene(bytes);
    const std::uint32_t* numbers = nullptr;
    std::size_t count = 0;
    if (!is_ok(rhview_scene_due_objects(slot.handle, bytes.next() == 1 ? nullptr : &numbers, &count))) {
        demand(numbers == nullptr && count == 0);
        return;
    }
    for (std::size_t i = 0; i < count; ++i)
        demand(numbers[i] < slot.model->has_object.size() && slot.model->has_object[numbers[i]]);
}

void Session::move_object(RecordBytes& bytes) {
    const SceneSlot& slot = scene(bytes);
    const std::uint32_t number = bytes.next();
    const rhview_box place = place_of(slot, number, box(bytes));
    is_ok(rhview_scene_move_object(slot.handle, number, bytes.next() == 1 ? nullptr : &place));
}

void Session::jump_object(RecordBytes& bytes) {
    const SceneSlot& slot = scene(bytes);
    const std::uint32_t number = bytes.next();
    const rhview_box place = place_of(slot, number, box(bytes));
    is_ok(rhview_scene_jump_object(slot.handle, number, bytes.next() == 1 ? nullptr : &place));
}

void Session::end_frame(RecordBytes& bytes) {
    is_ok(rhview_scene_end_frame(scene(bytes).handle));
}

void Session::fit_costs(RecordBytes& bytes) {
    std::array<rhview_frame_sample, 12> samples{};
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto n = static_cast<double>(i + 1);
        samples[i] = {1000.0 * n, n * n, 500.0 * n + 30.0 * n * n};
    }
    samples[bytes.below(12)].time_ns += bytes.number(0.0);
    samples[bytes.below(12)].indices += bytes.number(0.0);
    const std::size_t count = samples.size() - bytes.below(13);
    const Given fitted(costs(bytes), bytes);
    fills(rhview_costs_fit(bytes.next() == 1 ? nullptr : samples.data(), count, fitted.get()), fitted);
    const Given loaded(to_fill<rhview_costs>(), bytes);
    fills(rhview_costs_load(bytes.next() == 1 ? nullptr : "no/such/profile.json", 0, loaded.get()), loaded);
}

void Session::build_chains(RecordBytes& bytes) {
    rhview_chains*& slot = chain(bytes);
    if (slot != nullptr) return;
    const Arrays& source = arrays(bytes);
    rhview_mesh mesh{};
    mesh.positions = bytes.next() == 1 ? nullptr : source.positions.data();
    mesh.position_stride = 20;
    mesh.vertex_count = kVertices - bytes.below(kVertices + 1);
    mesh.indices = source.indices.data();
    mesh.index_count = kVertices - bytes.below(kVertices + 1);
    rhview_chain_options options{};
    options.ratio = bytes.number(0.5);
    options.min_triangles = bytes.next();
    options.forbids_sloppy = bytes.below(2);
    const Given given(options, bytes);
    rhview_chains* made = nullptr;
    if (is_ok(rhview_chains_build(&mesh, bytes.below(2) == 0 ? 1 : 0, given.get(), &made)))
        slot = made;
    else
        demand(made == nullptr);
}

void Session::get_chain(RecordBytes& bytes) {
    const rhview_chains* of = chain(bytes);
    const std::uint32_t number = bytes.below(3);
    const Given given(to_fill<rhview_chain>(), bytes);
    fills(rhview_chains_get(of, number, given.get()), given);
    rhview_chain whole{};
    whole.size = sizeof whole;
    if (of == nullptr || rhview_chains_get(of, number, &whole) != RHVIEW_OK) return;
    demand(whole.level_count >= 1 && whole.end != nullptr);
    for (std::size_t i = 1; i < whole.level_count; ++i)
        demand(std::uint64_t{whole.levels[i].first_index} + whole.levels[i].index_count <= whole.index_count);
}

void Session::destroy_chains(RecordBytes& bytes) {
    rhview_chains*& slot = chain(bytes);
    rhview_chains_destroy(slot);
    slot = nullptr;
}

}  // namespace rhview
