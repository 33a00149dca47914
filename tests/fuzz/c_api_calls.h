// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The calls of a session: one function each, which draws the arguments from a record's bytes, makes the call
/// and aborts if it broke a promise.
#pragma once

#include <optional>

#include "c_api_arguments.h"

namespace rhview {

inline constexpr std::size_t kVertices = 24;

/// What stands behind the pointers of a batch or mesh; alive until the session ends.
struct Arrays {
    std::vector<float> positions;
    std::vector<std::uint32_t> indices;
};

/// What the session knows of a scene; views keep it too.
struct SceneModel {
    std::size_t index_count = 0;
    std::uint32_t batch_count = 0;
    std::vector<bool> has_object;
    /// By object: one that promised where or how fast it moves stays here, for a build with asserts ends at
    /// a promise that is broken, which the header allows.
    std::vector<std::optional<rhview_box>> stays;
};
struct SceneSlot {
    rhview_scene* handle = nullptr;
    std::shared_ptr<SceneModel> model;
};
struct ViewSlot {
    rhview_view* handle = nullptr;
    std::shared_ptr<SceneModel> model;
};

class Session {
  public:
    Session() {
        const rhview_allocator hooks = memory_.hooks();
        demand(rhview_set_allocator(&hooks) == RHVIEW_OK);
    }
    ~Session() {
        for (const ViewSlot& view : views_) rhview_view_destroy(view.handle);
        for (const SceneSlot& scene : scenes_) rhview_scene_destroy(scene.handle);
        for (rhview_chains* chains : chains_) rhview_chains_destroy(chains);
        demand(memory_.block_count() == 0);
        demand(rhview_set_allocator(nullptr) == RHVIEW_OK);
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    void call(std::span<const std::uint8_t> record);
    [[nodiscard]] const StatusCounts& counts() const { return counts_; }

  private:
    using Call = void (Session::*)(RecordBytes&);
    static const std::array<Call, 26> kCalls;

    /// Counts the status; whether the call did what it was asked.
    bool is_ok(rhview_status status) {
        demand(status >= RHVIEW_OK && status < RHVIEW_INTERNAL_ERROR);
        ++counts_[static_cast<std::size_t>(status)];
        if (status != RHVIEW_OK) demand(std::strlen(rhview_last_error()) > 10);
        return status == RHVIEW_OK;
    }
    template <class Struct>
    void fills(rhview_status status, const Given<Struct>& given) {
        if (!is_ok(status)) demand(given.get() == nullptr || given.is_unchanged());
    }

    SceneSlot& scene(RecordBytes& bytes) { return scenes_[bytes.below(scenes_.size())]; }
    ViewSlot& view(RecordBytes& bytes) { return views_[bytes.below(views_.size())]; }
    rhview_chains*& chain(RecordBytes& bytes) { return chains_[bytes.below(chains_.size())]; }
    Arrays& arrays(RecordBytes& bytes);
    static rhview_costs costs(RecordBytes& bytes);
    static rhview_box box(RecordBytes& bytes);
    static rhview_box hull(const rhview_box& a, const rhview_box& b);
    static rhview_box place_of(const SceneSlot& slot, std::uint32_t number, const rhview_box& wished);
    static rhview_workers workers(RecordBytes& bytes);
    void check_plan(const ViewSlot& view);
    static void check_objects(const SceneModel& model, const rhview_plan& plan);

    void create_scene(RecordBytes& bytes);
    void add_batch(RecordBytes& bytes);
    void build_scene(RecordBytes& bytes);
    void scene_indices(RecordBytes& bytes);
    void destroy_scene(RecordBytes& bytes);
    void add_object(RecordBytes& bytes);
    void remove_object(RecordBytes& bytes);
    void begin_frame(RecordBytes& bytes);
    void due_objects(RecordBytes& bytes);
    void move_object(RecordBytes& bytes);
    void jump_object(RecordBytes& bytes);
    void end_frame(RecordBytes& bytes);
    void create_view(RecordBytes& bytes);
    void destroy_view(RecordBytes& bytes);
    void set_levels(RecordBytes& bytes);
    void set_camera(RecordBytes& bytes);
    void plan_views(RecordBytes& bytes);
    void get_plan(RecordBytes& bytes);
    void widen_boxes(RecordBytes& bytes);
    void absorb(RecordBytes& bytes);
    void ask_what_was_seen(RecordBytes& bytes);
    void fit_costs(RecordBytes& bytes);
    void build_chains(RecordBytes& bytes);
    void get_chain(RecordBytes& bytes);
    void destroy_chains(RecordBytes& bytes);
    void run_out_of_memory(RecordBytes& bytes);

    LimitedMemory memory_;
    std::vector<std::unique_ptr<Arrays>> arrays_;
    std::array<SceneSlot, 2> scenes_{};
    std::array<ViewSlot, 4> views_{};
    std::array<rhview_chains*, 2> chains_{};
    std::vector<std::uint64_t> tickets_;
    StatusCounts counts_{};
};

}  // namespace rhview
