// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "box_drawer.h"
#include "box_pass.h"
#include "object_drawer.h"
#include "rhview/gl/executor.h"
#include "rhview/gl/query_pool.h"
#include "rhview/gl/scene_buffers.h"

namespace rhview::gl {

/// The queries of a plan on the device: asks them, knows what decides about each conditional draw, collects
/// the answers.
class OcclusionTests {
  public:
    static Result<OcclusionTests> create(std::uint32_t lost_after_frames);

    [[nodiscard]] bool has_box_pass() const { return box_pass_.has_value(); }

    void begin_frame();
    /// Asks all queries of `plan` against the depth in the bound framebuffer, whose depth test is set up.
    /// Changes what `BoxDrawer::begin` sets, and buffer bindings.
    /// `growth`: no conditional object has a greater `rounding_growth`.
    void ask(const FramePlan& plan, const SceneBuffers& scene, const View& view, const ObjectDrawer& objects,
             double growth, FrameCounters& counters);

    /// Takes the answers to the queries of `plan` that are there already, and does not wait for the others;
    /// `poll` gives them to who asked.
    void look(const FramePlan& plan);
    /// Whether `look` found that nothing of it is seen.
    [[nodiscard]] bool is_found_hidden(std::uint32_t query) const { return fates_[query].hidden; }
    /// Makes the commands of the conditional runs anew; there are no others then.
    void command_late(const ObjectDrawer& objects);

    /// The OpenGL name of the query of this plan if conditional rendering decides; else 0.
    [[nodiscard]] std::uint32_t condition(std::uint32_t query) const { return fates_[query].name; }
    /// Whether an indirect command decides.
    [[nodiscard]] bool is_indirect(std::uint32_t query) const { return fates_[query].slot != kNoSlot; }
    /// There is a command for each indirect one of the conditional ranges, then of the conditional runs of
    /// objects, in the order of the plan.
    void bind_commands() const;

    void poll(std::vector<QueryAnswer>& answers);
    void wait(std::vector<QueryAnswer>& answers);
    [[nodiscard]] AnswerCounters counters() const;

  private:
    static constexpr std::uint32_t kNoSlot = 0xffffffffu;

    /// What decides about draws that hang on a query; nothing: they are drawn.
    struct Fate {
        std::uint32_t name = 0;
        std::uint32_t slot = kNoSlot;
        std::uint32_t first_box = 0;  ///< into `boxes_`
        bool hidden = false;          ///< as is known already
    };

    OcclusionTests(BoxDrawer drawer, QueryPool pool);
    void place_boxes(const FramePlan& plan, const BoxWidener& widener);
    void place_query(const PlannedQuery& query, const FramePlan& plan, const BoxWidener& widener, Fate& fate);
    void ask_hardware(const FramePlan& plan, const BoxWidener& widener, FrameCounters& counters);
    void ask_box_pass(const BoxWidener& widener, FrameCounters& counters);
    void collect_draws(const ObjectDrawer& objects);

    BoxDrawer drawer_;
    QueryPool pool_;
    std::optional<BoxPass> box_pass_;
    int subpixel_bits_ = 8;

    std::vector<Fate> fates_;           ///< by query of the plan
    std::vector<BoxInstance> boxes_;    ///< of hardware queries, then those of the box pass
    std::uint32_t first_marking_ = 0;   ///< where the latter begin
    std::vector<std::uint64_t> slots_;  ///< tickets
    std::vector<SlotDraw> draws_;
    std::vector<QueryAnswer> early_;  ///< answers for the next `poll`: without the device, or seen by `look`
    std::vector<std::uint32_t> by_ticket_;  ///< scratch: queries of the plan
};

}  // namespace rhview::gl
