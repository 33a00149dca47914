// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "c_api_session.h"

#include "c_api_calls.h"

namespace rhview {
namespace {

constexpr std::size_t kMostCalls = 64;

}  // namespace

const std::array<Session::Call, 26> Session::kCalls{
    &Session::create_scene,      &Session::add_batch,        &Session::build_scene,   &Session::scene_indices,
    &Session::destroy_scene,     &Session::add_object,       &Session::remove_object, &Session::begin_frame,
    &Session::due_objects,       &Session::move_object,      &Session::jump_object,   &Session::end_frame,
    &Session::create_view,       &Session::destroy_view,     &Session::set_levels,    &Session::set_camera,
    &Session::plan_views,        &Session::get_plan,         &Session::widen_boxes,   &Session::absorb,
    &Session::ask_what_was_seen, &Session::fit_costs,        &Session::build_chains,  &Session::get_chain,
    &Session::destroy_chains,    &Session::run_out_of_memory};

void Session::call(std::span<const std::uint8_t> record) {
    RecordBytes bytes(record);
    (this->*kCalls[bytes.below(kCalls.size())])(bytes);
}

/// Until the next of these: 255 and zero give all again.
void Session::run_out_of_memory(RecordBytes& bytes) {
    const std::uint8_t from = bytes.next();
    if (from == 0 || from == 255) return memory_.give_all();
    memory_.fail_from(from - 1u);
}

StatusCounts run_c_api_session(std::span<const std::uint8_t> bytes) {
    Session session;
    const std::size_t calls = std::min(bytes.size() / kRecordBytes, kMostCalls);
    for (std::size_t i = 0; i < calls; ++i) session.call(bytes.subspan(i * kRecordBytes, kRecordBytes));
    return session.counts();
}

std::vector<std::vector<std::uint8_t>> c_api_seeds() {
    // The numbers of kCalls: each with zeros is a right call.
    const std::vector<std::vector<std::uint8_t>> orders{
        {0, 1, 1, 2, 3, 12, 15, 16, 17, 18, 19, 16, 20, 13, 4},
        {22, 23, 0, 24, 1, 2, 5, 5, 12, 14, 15, 7, 8, 9, 16, 11, 20, 7, 10, 16, 11, 6, 19, 16, 4, 16},
        {0, 25, 1, 2, 12, 21, 4},
    };
    std::vector<std::vector<std::uint8_t>> seeds;
    for (const std::vector<std::uint8_t>& order : orders) {
        std::vector<std::uint8_t>& seed = seeds.emplace_back(order.size() * kRecordBytes);
        for (std::size_t i = 0; i < order.size(); ++i) seed[i * kRecordBytes] = order[i];
    }
    // Occlusion that is exact, in the first two; of a batch, the corner that is at zero anyway.
    for (std::size_t seed = 0; seed < 2; ++seed)
        for (std::size_t i = 0; i < orders[seed].size(); ++i)
            if (orders[seed][i] == 12) seeds[seed][i * kRecordBytes + 3] = 1;
    return seeds;
}

}  // namespace rhview
